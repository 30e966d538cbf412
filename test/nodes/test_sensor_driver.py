# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The sensor driver's node: sentences of a device in, readings out."""

import math
import socket

import pytest
from rclpy.lifecycle import TransitionCallbackReturn
from sensor_msgs.msg import JointState

from support.node_bench import declared_topics
from tactile_push.devices import Sentence, encode
from tactile_push.interface import SENSOR_DRIVER, TACTILE
from tactile_push.nodes.ros.diagnostics import ERROR, OK, WARN
from tactile_push.nodes.ros.parameters import ConfigurationError
from tactile_push.nodes.sensor_driver import SensorDriver
from tactile_push.pipeline.stamps import stamp_of
from tactile_push.simulation import serve
from tactile_push.tactile import Reading

ROUNDING = math.radians(0.5e-4)  # of angles on the wire


@pytest.fixture
def device(tmp_path):
    """Return the path of a device, and what sends sentences from it."""
    path = str(tmp_path / 'sensor')
    server = serve(path)
    yield path, server
    server.close()


def test_topics_are_those_of_the_interface(bench, device):
    bench.start(SensorDriver, device=device[0])
    assert bench.topics() == declared_topics(SENSOR_DRIVER)


def test_sentences_become_readings(bench, device):
    path, server = device
    node = bench.start(SensorDriver, device=path)
    bench.hear(JointState, TACTILE)
    reading = Reading(0.125, 1.25, 0.5)
    sequence = iter(range(65536))
    before = node.get_clock().now().nanoseconds
    bench.until(
        lambda: len(bench.heard[TACTILE]) > 3,
        lambda: server.send(encode(Sentence(next(sequence), reading))),
    )
    stamps = []
    for message in bench.heard[TACTILE]:
        assert list(message.name) == ['azimuth', 'elevation', 'normal_force']
        assert list(message.position[:2]) == pytest.approx([0.125, 1.25], abs=ROUNDING)
        assert message.effort[2] == pytest.approx(0.5)
        assert math.isnan(message.position[2])
        sec, nanosec = stamp_of(message)
        stamps.append(sec * 10**9 + nanosec)
    assert before < stamps[0]
    assert stamps == sorted(set(stamps))
    assert bench.health == (OK, 'reading')


def test_readings_of_one_look_have_stamps_a_nanosecond_apart(bench, device):
    node = bench.start(SensorDriver, device=device[0])
    bench.hear(JointState, TACTILE)
    node._publish([Reading(0.1 * i, 1.0) for i in range(3)], 5_000_000_001)
    bench.until(lambda: len(bench.heard[TACTILE]) == 3)
    assert [stamp_of(message) for message in bench.heard[TACTILE]] == [
        *((4, 999_999_999), (5, 0), (5, 1))
    ]
    assert [message.position[0] for message in bench.heard[TACTILE]] == [0.0, 0.1, 0.2]


def test_readings_before_simulated_time_begins_are_counted_only(bench, device):
    node = bench.start(SensorDriver, device=device[0])
    bench.hear(JointState, TACTILE)
    node._publish([Reading(0.0, 1.0)], 0)
    node._publish([Reading(0.2, 1.0)], 1)
    bench.until(lambda: bench.heard[TACTILE])
    assert [message.position[0] for message in bench.heard[TACTILE]] == [0.2]
    assert (node._counts()['unstamped'], node._counts()['readings']) == (1, 1)


def test_a_device_that_is_not_there_is_an_error_until_it_comes(bench, tmp_path):
    path = str(tmp_path / 'sensor')
    node = bench.start(SensorDriver, device=path)
    bench.until(lambda: bench.health == (ERROR, 'device not there'))
    server = serve(path)
    sequence = iter(range(65536))
    bench.until(
        lambda: bench.health[0] != ERROR,
        lambda: server.send(encode(Sentence(next(sequence), Reading(0.0, 1.0)))),
    )
    assert node._counts()['connections'] == 1
    server.close()


def test_a_simulated_sensor_that_is_silent_may_be_compiling_and_that_is_said(bench):
    with socket.create_server(('127.0.0.1', 0)) as listener:
        url = f'socket://127.0.0.1:{listener.getsockname()[1]}'
        bench.start(SensorDriver, device=url, silence_timeout=0.1)
        words = 'no bytes; sim_plant sends none while it compiles'
        bench.until(lambda: bench.health == (ERROR, words))


def test_a_silent_line_is_no_simulation(bench, device):
    bench.start(SensorDriver, device=device[0], silence_timeout=0.1)
    bench.until(lambda: bench.health == (ERROR, 'no bytes'))


def test_what_goes_wrong_between_readings_is_counted_and_a_warning(bench, device):
    path, server = device
    node = bench.start(SensorDriver, device=path, silence_timeout=60.0)
    sequence = iter(range(65536))

    def send():
        line = encode(Sentence(next(sequence), Reading(0.0, 1.0)))
        server.send(line)
        server.send(line[:-5] + b'*00\r\n')  # which is no checksum of it

    bench.until(
        lambda: node._counts()['readings'] and any('dropped' in n for n in node._counts()), send
    )
    (dropped,) = (name for name in node._counts() if name.startswith('dropped: '))
    rates = node._diagnostics.rates
    for name, words in (
        ('unstamped', 'no simulated time yet'),
        ('late', 'readings late'),
        ('lost', 'readings lost'),
        ('repeated', 'sentences repeated'),
        (dropped, 'sentences dropped'),
    ):
        assert name in node._counts()
        rates.clear()
        rates[name] = 1.0
        assert bench.health == (WARN, words)


def test_without_autostart_it_reads_once_its_manager_says_so(bench, device):
    node = bench.start(SensorDriver, device=device[0], autostart=False)
    assert bench.topics() == (set(), set())
    assert bench.health == (OK, 'inactive')
    assert node.trigger_configure() == TransitionCallbackReturn.SUCCESS
    assert node.trigger_activate() == TransitionCallbackReturn.SUCCESS
    bench.until(lambda: node._counts()['connections'] == 1)
    assert node.trigger_deactivate() == TransitionCallbackReturn.SUCCESS
    assert bench.health == (OK, 'inactive')


@pytest.mark.parametrize(
    ('parameters', 'refusal'),
    [
        ({'device': 'socket://here'}, 'parameter device: '),
        ({'baud_rate': 10}, 'parameter baud_rate: expected'),
        ({'silence_timeout': 0.0}, 'parameter silence_timeout: expected'),
    ],
)
def test_a_bad_parameter_is_refused(bench, parameters, refusal):
    with pytest.raises(ConfigurationError) as refused:
        bench.start(SensorDriver, **parameters)
    assert str(refused.value).startswith(refusal)
