# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Faults of processes: killed, standing still, told to end, short of a processor."""

import signal
import time

from lifecycle_msgs.msg import Transition

from .bench import Bench, expect
from .busy import busy_cores, give_way
from .checks import OLDEST
from .promise import COMMAND_LOST, SIGNAL, SILENT, fault

STANDSTILL = 1.5  # of a stopped process [s]
STARVED = 4.0  # of nodes without a processor [s]


@fault('driver killed', SILENT)
def driver_killed(bench: Bench) -> None:
    """Contact silent; pushes on with a new driver."""
    finger = bench.finger
    bench.stopped(finger.kill('sensor_driver'))
    finger.expect_reason('contact silent')
    finger.begin('sensor_driver')
    finger.wait_until_moving(10.0)


@fault('driver stopped, continued', SILENT)
def driver_stopped(bench: Bench) -> None:
    """Contact silent; drops what piled up meanwhile; pushes on."""
    finger = bench.finger
    at = finger.signal('sensor_driver', signal.SIGSTOP)
    bench.stopped(at)
    bench.observer.spin(max(0.0, at + STANDSTILL - time.monotonic()))
    continued = finger.signal('sensor_driver', signal.SIGCONT)
    finger.wait_until_moving()
    old = {
        number for number, sent in finger.proxy.sent.items() if at < sent.at < continued - OLDEST
    }
    published = {int(m.effort[2]) for m in finger.tactile.since(continued)}
    expect(not old & published, f'{len(old & published)} old readings published as new')


@fault('geometry killed', SILENT)
def geometry_killed(bench: Bench) -> None:
    """Contact silent; pushes on with a new one."""
    finger = bench.finger
    bench.stopped(finger.kill('contact_geometry'))
    finger.expect_reason('contact silent')
    finger.begin('contact_geometry')
    finger.wait_until_moving(10.0)


@fault('geometry stopped, continued', SILENT)
def geometry_stopped(bench: Bench) -> None:
    """Contact silent; old contacts do not count; pushes on."""
    finger = bench.finger
    at = finger.signal('contact_geometry', signal.SIGSTOP)
    bench.stopped(at)
    finger.expect_reason('contact silent')
    bench.observer.spin(max(0.0, at + STANDSTILL - time.monotonic()))
    finger.signal('contact_geometry', signal.SIGCONT)
    finger.wait_until_moving()


@fault('controller stopped, continued', COMMAND_LOST)
def controller_stopped(bench: Bench) -> None:
    """Makes the plant stop; ticks lost; resumes by service."""
    finger = bench.finger
    at = finger.signal('push_controller', signal.SIGSTOP)
    bench.stopped(at)
    bench.observer.spin(max(0.0, at + STANDSTILL - time.monotonic()))
    finger.signal('push_controller', signal.SIGCONT)
    finger.expect_reason('ticks lost')
    finger.expect_rest('ticks lost')
    finger.resume()


@fault('controller killed', COMMAND_LOST)
def controller_killed(bench: Bench) -> None:
    """Makes the plant stop; a new controller begins with v_x = 0."""
    finger = bench.finger
    bench.stopped(finger.kill('push_controller'))
    said = len(finger.commands)
    finger.begin('push_controller')
    finger.activate()
    finger.wait_until_moving(10.0)
    expect(finger.commands[said].twist.linear.x == 0.0, 'the first command is not 0')


@fault('controller deactivated', SIGNAL)
def controller_deactivated(bench: Bench) -> None:
    """Sends a last 0; active again it begins with v_x = 0."""
    finger, node = bench.finger, bench.finger.name('push_controller')
    at = time.monotonic()
    expect(
        bench.observer.change_state(node, Transition.TRANSITION_DEACTIVATE), 'deactivation refused'
    )
    bench.stopped(at)
    said = len(finger.commands)
    bench.observer.spin(0.3)
    expect(len(finger.commands) == said, 'an inactive controller commands')
    expect(bench.observer.change_state(node, Transition.TRANSITION_ACTIVATE), 'activation refused')
    finger.wait_until_moving()
    expect(finger.commands[said].twist.linear.x == 0.0, 'the first command is not 0')


def _told_to_end(bench: Bench, number: signal.Signals) -> None:
    finger = bench.finger
    bench.stopped(finger.signal('push_controller', number))
    status = finger.ended('push_controller')
    expect(status == 0, f'exit status {status}')
    expect(finger.commands[-1].twist.linear.x == 0.0, 'the last command is not 0')
    finger.begin('push_controller')
    finger.activate()
    finger.wait_until_moving(10.0)


@fault('controller gets SIGINT', SIGNAL)
def controller_interrupted(bench: Bench) -> None:
    """Sends a last 0; exit status 0."""
    _told_to_end(bench, signal.SIGINT)


@fault('controller gets SIGTERM', SIGNAL)
def controller_terminated(bench: Bench) -> None:
    """Sends a last 0; exit status 0."""
    _told_to_end(bench, signal.SIGTERM)


@fault('plant stopped, continued', SILENT)
def plant_stopped(bench: Bench) -> None:
    """Contact silent, in the commands; pushes on."""
    finger = bench.finger
    at = finger.signal('sim_plant', signal.SIGSTOP)
    bench.stopped(at, command=True)
    bench.observer.spin(max(0.0, at + STANDSTILL - time.monotonic()))
    finger.signal('sim_plant', signal.SIGCONT)
    finger.wait_until_moving()


@fault('plant killed', SILENT)
def plant_killed(bench: Bench) -> None:
    """Contact silent, in the commands; pushes on with a new plant."""
    finger = bench.finger
    bench.stopped(finger.kill('sim_plant'), command=True)
    finger.begin('sim_plant')
    finger.wait_until_moving(15.0)


@fault('processors busy', last=True)
def processors_busy(bench: Bench) -> None:
    """Goes on, or stops and says why; nothing old as new; pushes again."""
    finger = bench.finger
    for node in ('sensor_driver', 'contact_geometry', 'push_controller'):
        give_way(finger.nodes.running[finger.process(node)].pid)
    with busy_cores(STARVED):
        bench.observer.spin(STARVED)
    finger.rest_or_push()
    if finger.reason in ('ticks lost', 'clock jumped'):
        finger.resume()
    finger.wait_until_moving()
