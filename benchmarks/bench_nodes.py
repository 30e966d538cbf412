# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""How fast the nodes are, as processes, beside bare rclpy nodes with the same topics: `make bench`.

Both chains run at the same time and are fed by turns, so what else the machine does meets both.
One process writes the numbered bytes and hears the last hop, on one steady clock.
"""

import os
import socket
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import PoseStamped, TwistStamped
from nodes_report import Report, delays, gaps, spread
from probe import Chain, Heard, chains, feed
from rclpy.serialization import deserialize_message
from sensor_msgs.msg import JointState

LATENCY_RATE, LATENCY_READINGS = 100.0, 5000
# The tick waits for no reading. At a rate that is no multiple of the readings' it meets them at
# every phase, and at this one hardly a reading goes without a command of its own.
LATENCY_CONTROL_RATE = 110.0
FLOOD_RATE, FLOOD_READINGS = 500.0, 15_000
LOOP_TIME = 60.0  # [s]
WARM_UP = 3.0  # [s]; caches fill, discovery ends
CONTROL_PERIOD = 0.1  # push_controller's default [s]
pytestmark = pytest.mark.benchmark(group='nodes')
NODES = ('sim_plant', 'sensor_driver', 'contact_geometry', 'push_controller')


@pytest.fixture(scope='module')
def report():
    """Collect what is measured and print it in the end, each figure beside its goal."""
    load = os.getloadavg()[0]
    collected = Report()
    yield collected
    print(f'\n\n{collected.table()}\nload of the machine before: {load:.1f}')


def test_latency(benchmark, report, tmp_path):
    """Time the way from the device's bytes to `contact` and to the command."""
    ours, bare = benchmark.pedantic(latencies, args=(tmp_path,), rounds=1)
    for what in ours:
        assert len(ours[what]) >= 3000 and len(bare[what]) >= 3000, what
        for percent, goal in ((50, 1.25), (99, 1.5)):
            mine, its = (1e3 * np.percentile(d[what], percent) for d in (ours, bare))
            report.add(
                f'{what}, p{percent}', f'{mine:.2f} ms, bare {its:.2f} ms', mine / its, goal, 'x'
            )
    report.save(benchmark)


def test_no_reading_is_lost(benchmark, report, tmp_path):
    """Send 500 readings a second and find each of them on `tactile` and on `contact`."""
    heard, first, last, said = benchmark.pedantic(flood, args=(tmp_path,), rounds=1)
    for topic, numbers in heard.items():
        lost, disordered = gaps(numbers, first, last)
        report.add(
            f'device bytes to {topic} at {FLOOD_RATE:.0f} Hz',
            f'{last - first + 1 - lost} of {last - first + 1}, {disordered} out of order',
            lost + disordered,
            0,
            'lost',
        )
    report.save(benchmark)
    for topic, numbers in heard.items():
        assert gaps(numbers, first, last) == (0, 0), f'{topic}; the nodes say: {said}'


def test_loop(benchmark, report, tmp_path):
    """Watch the ticks and the processor time of the whole loop at its default rates."""
    ticks, seconds, interfaces = benchmark.pedantic(loop, args=(tmp_path,), rounds=1)
    for whose, (sent, arrived) in ticks.items():
        for end, times in (('stamps', sent), ('arrivals', arrived)):
            deviation, lost = spread(times, CONTROL_PERIOD)
            goal = 2.0 if whose == 'ours' else None
            report.add(
                f'10 Hz tick by its {end}, {whose}',
                f'std {1e3 * deviation:.2f} ms of {len(times)}, {lost} lost',
                100.0 * deviation / CONTROL_PERIOD,
                goal,
                '%',
            )
            assert whose == 'bare' or lost == 0
    for node, (mine, its) in seconds.items():
        share = f'{100.0 * mine / LOOP_TIME:.2f} %, bare {100.0 * its / LOOP_TIME:.2f} %'
        report.add(f'processor time of {node}', share, mine / its, 1.3, 'x')
    report.save(benchmark)
    ours, bare = interfaces
    assert ours == bare, f'the bare nodes are not like ours: {sorted(ours ^ bare)}'


def latencies(folder: Path) -> tuple[dict[str, np.ndarray], dict[str, np.ndarray]]:
    """Give the delays [s] of our chain and of the bare one, by what was measured."""
    with chains(folder) as (probe, *both):
        heard = {}
        for chain in both:
            heard[chain] = (
                chain.hear(PoseStamped, 'contact'),
                chain.hear(TwistStamped, 'finger/cmd_vel'),
                chain.hear(JointState, 'push_controller/state'),
            )
            chain.start_on_device(control_rate=LATENCY_CONTROL_RATE)
        with feed([chain.send for chain in both], LATENCY_RATE, jitter=0.5):
            probe.wait_for(lambda: all(map(all, heard.values())), 'both chains to work')
            probe.spin(WARM_UP)
            first = len(both[0].device.sent)
            probe.spin(LATENCY_READINGS / LATENCY_RATE)
    ours, bare = (delays_of(chain, first, *heard[chain]) for chain in both)
    return ours, bare


def delays_of(
    chain: Chain, first: int, contacts: list[Heard], commands: list[Heard], states: list[Heard]
) -> dict[str, np.ndarray]:
    """Give a chain's delays [s] from reading number `first` on.

    When a tick comes has nothing to do with when a reading comes, so the way to the command is
    given without the wait between: the way to `contact`, which the controller hears as the probe
    does, plus the way from the tick, whose time is the command's stamp, to the command heard.
    """
    sent = chain.device.sent
    of_contact = [
        (chain.number(deserialize_message(contact.data, PoseStamped)), contact.at)
        for contact in contacts
    ]
    to_contact = delays(sent, of_contact, first)
    used = {}
    for heard in states:
        state = deserialize_message(heard.data, JointState)
        used[nanoseconds(state)] = chain.number(state)
    of_command, to_command = [], {}
    for heard in commands:
        stamp = nanoseconds(deserialize_message(heard.data, TwistStamped))
        number = used.get(stamp)
        of_command.append((number, heard.at))
        if number in to_contact and number not in to_command:
            to_command[number] = to_contact[number] + heard.wall - 1e-9 * stamp
    to_first_command = delays(sent, of_command, first)
    return {
        what: np.array(list(values.values()))
        for what, values in {
            'device bytes to contact': to_contact,
            'device bytes to command, without the wait for the tick': to_command,
            f'with the wait for the tick at {LATENCY_CONTROL_RATE:.0f} Hz': to_first_command,
        }.items()
    }


def flood(folder: Path) -> tuple[dict[str, list[int | None]], int, int, dict[str, str]]:
    """Give the numbers heard by topic, the first and last number sent, and the nodes' counts."""
    types = {'tactile': JointState, 'contact': PoseStamped}
    with chains(folder) as (probe, chain, _):
        heard = {topic: chain.hear(type_, topic) for topic, type_ in types.items()}
        said = probe.hear(DiagnosticArray, '/diagnostics')
        chain.start_on_device()
        device = chain.device
        with feed([chain.send], FLOOD_RATE):
            probe.wait_for(lambda: all(heard.values()), 'the chain to work')
            probe.spin(WARM_UP)
            first = len(device.sent)
            probe.wait_for(
                lambda: len(device.sent) > first + FLOOD_READINGS, 'all to be sent', 300.0
            )
        last = len(device.sent) - 1
        probe.spin(2.0)
    numbers = {
        topic: [chain.number(deserialize_message(h.data, types[topic])) for h in messages]
        for topic, messages in heard.items()
    }
    counts = {}
    for message in said:
        for status in deserialize_message(message.data, DiagnosticArray).status:
            counts |= {f'{status.name} {value.key}': value.value for value in status.values}
    return numbers, first, last, counts


def loop(folder: Path) -> tuple[dict, dict[str, tuple[float, float]], tuple[set, set]]:
    """Run both loops; give ticks [s], processor time [s] by node, and what the nodes offer."""
    with chains(folder) as (probe, *both):
        commands = {chain: chain.hear(TwistStamped, 'finger/cmd_vel') for chain in both}
        for chain in both:
            device = f'127.0.0.1:{free_port()}'
            chain.start('sim_plant', device=device)
            chain.start('sensor_driver', device=device)
            chain.start('contact_geometry')
            # Straight on, so that the finger stays within its reach for as long as it takes.
            chain.start('push_controller', **({} if chain.bare else {'theta_desired': 0.0}))
        probe.wait_for(lambda: all(commands.values()), 'both loops to work')
        probe.spin(WARM_UP)
        begun = [len(heard) for heard in commands.values()]
        before = {
            (chain, node): processor_time(chain.pid(node)) for chain in both for node in NODES
        }
        probe.spin(LOOP_TIME)
        used = {key: processor_time(key[0].pid(key[1])) - then for key, then in before.items()}
        interfaces = tuple(chain.interfaces() for chain in both)
    ticks = {}
    for start, (chain, heard) in zip(begun, commands.items(), strict=True):
        stamps = [nanoseconds(deserialize_message(h.data, TwistStamped)) for h in heard[start:]]
        arrivals = [h.at for h in heard[start:]]
        ticks[chain.namespace] = np.array(stamps) * 1e-9, np.array(arrivals)
    seconds = {node: tuple(used[chain, node] for chain in both) for node in NODES}
    return ticks, seconds, interfaces


def nanoseconds(message: Any) -> int:
    """Give a message's stamp."""
    return message.header.stamp.sec * 10**9 + message.header.stamp.nanosec


def processor_time(pid: int) -> float:
    """Give what a process has used of the processor so far [s]."""
    fields = Path(f'/proc/{pid}/stat').read_text().rpartition(')')[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf('SC_CLK_TCK')


def free_port() -> int:
    """Find a port that nobody listens on."""
    with socket.create_server(('127.0.0.1', 0)) as server:
        return server.getsockname()[1]
