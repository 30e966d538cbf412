# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The wrench sensor's node: wrenches in, readings out."""

import math

import pytest
from geometry_msgs.msg import WrenchStamped
from rclpy.lifecycle import TransitionCallbackReturn
from rclpy.time import Time
from sensor_msgs.msg import JointState
from std_srvs.srv import Trigger

from support.node_bench import declared_topics
from support.touches import unit, wrench
from tactile_push.interface import TACTILE, TARE, TOPICS, WRENCH, WRENCH_SENSOR
from tactile_push.nodes.ros.diagnostics import ERROR, OK, WARN
from tactile_push.nodes.ros.parameters import ConfigurationError
from tactile_push.nodes.wrench_sensor import WrenchSensor

CENTRE = (0.0, 0.0, 0.02)
OFFSET = (0.5, -0.4, 3.0)
PERIOD = 10_000_000  # [ns]
NOTHING = (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)
PRESS = wrench(unit(0.5, 0.9), 1.5, (0.0, 0.0), 0.0, CENTRE)


class Sensor:
    """A sensor with an offset and the node that hears it."""

    def __init__(self, bench, **parameters):
        self.bench = bench
        self.node = bench.start(WrenchSensor, filter_time_constant=0.0, **parameters)
        bench.hear(JointState, TACTILE)
        self.publisher = bench.publisher(WrenchStamped, WRENCH)
        self.client = bench.peer.create_client(Trigger, TARE)
        self.now = 1000 * 10**9

    def send(self, force, moment, frame='sensor', after=PERIOD):
        self.now += after
        message = WrenchStamped()
        message.header.frame_id = frame
        message.header.stamp = Time(nanoseconds=self.now).to_msg()
        for place, value, offset in zip('xyz', force, OFFSET, strict=True):
            setattr(message.wrench.force, place, value + offset)
        for place, value in zip('xyz', moment, strict=True):
            setattr(message.wrench.torque, place, value)
        self.publisher.publish(message)

    def tare(self, *contact):
        """Send wrenches and ask for a tare; return the answer."""
        before = self.node._counted['wrenches']
        self.bench.until(
            lambda: self.node._counted['wrenches'] >= before + 60,
            lambda: self.send(*(contact or NOTHING)),
        )
        self.bench.until(self.client.service_is_ready)
        answer = self.client.call_async(Trigger.Request())
        self.bench.until(answer.done, lambda: self.send(*(contact or NOTHING)))
        return answer.result()

    def until(self, health, *contact, **how):
        self.bench.until(
            lambda: self.bench.health == health, lambda: self.send(*(contact or NOTHING), **how)
        )


def test_topics_are_those_of_the_interface(bench):
    bench.start(WrenchSensor)
    assert bench.topics() == declared_topics(WRENCH_SENSOR)


def test_tared_wrenches_become_readings(bench):
    sensor = Sensor(bench)
    sensor.until((ERROR, 'not tared: lift the finger and call wrench_sensor/tare'))
    assert bench.heard[TACTILE] == []
    answer = sensor.tare()
    assert (answer.success, answer.message) == (True, '')
    sensor.until((OK, 'no contact'))
    sensor.until((OK, 'contact'), *PRESS)
    heard = bench.heard[TACTILE]
    bench.until(lambda: heard and math.isfinite(heard[-1].position[0]))
    message = bench.heard[TACTILE][-1]
    assert tuple(message.name) == TOPICS[TACTILE].field_names
    assert list(message.position[:2]) == pytest.approx([0.5, 0.9])
    assert message.effort[2] == pytest.approx(1.5)
    assert math.isnan(bench.heard[TACTILE][0].position[0])


def test_tare_in_contact_is_refused_with_the_reason(bench):
    sensor = Sensor(bench)
    assert sensor.tare().success
    answer = sensor.tare(*PRESS)
    assert not answer.success
    assert answer.message.startswith('in contact with 1.50 N')


def test_tare_without_wrenches_or_without_being_active_is_refused(bench):
    sensor = Sensor(bench, silence_timeout=0.1)
    bench.until(lambda: bench.health == (ERROR, 'no wrenches on wrench'))
    request, response = Trigger.Request(), Trigger.Response()
    assert sensor.node._on_untouched(request, response).message == 'no wrenches on wrench'
    assert sensor.node.trigger_deactivate() == TransitionCallbackReturn.SUCCESS
    assert bench.health == (OK, 'inactive')
    assert sensor.node._on_untouched(request, response).message == 'the node is not active'


def test_tare_that_drifts_is_a_warning(bench):
    sensor = Sensor(bench)
    sensor.tare()
    drift = (0.06, 0.0, 0.0), (0.0, 0.0, 0.0)
    sensor.until((WARN, 'tare drifts: 0.06 N in the air; call wrench_sensor/tare'), *drift)


@pytest.mark.parametrize(
    ('contact', 'how', 'words'),
    [
        (([math.nan, 0.0, 0.0], [0.0] * 3), {}, 'not finite'),
        (PRESS, {'frame': 'wrist'}, 'another frame than that of the tare'),
        (
            *(PRESS, {'after': 10 * PERIOD}),
            'too long after the one before by 0.100 s, more than max_gap',
        ),
        (
            *(([0.0, 0.0, -1.0], [0.0, 0.1, 0.0]), {}),
            'torsion; a contact beside the tip, two contacts, or a wrong tip_xyz or tip_radius',
        ),
        (
            *(([0.0, 0.0, 1.0], [0.0, 0.0, 0.0]), {}),
            'contact behind the tip; check the sign of the wrench (reaction) and tip_rpy',
        ),
        (([0.0, 0.0, -50.0], [0.0, 0.0, 0.0]), {}, 'saturated'),
    ],
)
def test_wrenches_that_tell_nothing_are_an_error_that_says_why(bench, contact, how, words):
    sensor = Sensor(bench, force_range=40.0)
    sensor.tare()
    sensor.until((ERROR, f'wrenches refused: {words}'), *contact, **how)
    readings = sensor.node._counted['readings']
    sensor.until((ERROR, f'wrenches refused: {words}'), *contact, **how)
    assert sensor.node._counted['readings'] == readings


def test_sensor_other_than_the_calibrated_one_is_an_error_that_names_it(bench):
    sensor = Sensor(bench, calibrated_frame='left_ft')
    sensor.until((ERROR, 'wrenches refused: another frame than left_ft'), *PRESS)


def test_some_refused_wrenches_are_a_warning(bench):
    sensor = Sensor(bench, silence_timeout=60.0)
    sensor.tare()
    sensor.until((OK, 'no contact'))
    sensor.node._diagnostics.rates['refused: torsion'] = 1.0
    assert bench.health == (WARN, 'no contact, some wrenches refused')


def test_new_configuration_forgets_the_tare_and_a_new_activation_does_not(bench):
    sensor = Sensor(bench)
    sensor.tare()
    node = sensor.node
    for transition in (node.trigger_deactivate, node.trigger_activate):
        assert transition() == TransitionCallbackReturn.SUCCESS
    sensor.until((OK, 'no contact'))
    for transition in (
        *(node.trigger_deactivate, node.trigger_cleanup),
        *(node.trigger_configure, node.trigger_activate),
    ):
        assert transition() == TransitionCallbackReturn.SUCCESS
    sensor.until((ERROR, 'not tared: lift the finger and call wrench_sensor/tare'))


def test_sensor_that_tares_itself_needs_no_tare(bench):
    sensor = Sensor(bench, needs_tare=False, contact_force=10.0, release_force=9.0)
    sensor.until((OK, 'no contact'))


@pytest.mark.parametrize(
    ('parameters', 'refusal'),
    [
        ({'tip_xyz': [0.0, 0.0]}, 'parameter tip_xyz: expected three finite numbers'),
        ({'release_force': 0.5}, 'parameter release_force: expected a positive force up to'),
        ({'tip_radius': 0.0}, 'parameter tip_radius: expected'),
        ({'max_torque': 1.0}, 'parameter max_torque: unknown, did you mean max_torsion?'),
    ],
)
def test_a_bad_parameter_is_refused(bench, parameters, refusal):
    with pytest.raises(ConfigurationError) as refused:
        bench.start(WrenchSensor, **parameters)
    assert str(refused.value).startswith(refusal)
