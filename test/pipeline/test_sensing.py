# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What is said of the object after a control period, and at which moment."""

import math
from dataclasses import replace
from itertools import islice
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from support.clock_apart import PERIOD, START, periods, seconds
from tactile_push.control import NO_REASON, PUSHING, PushLaw, Tick, tick_values
from tactile_push.estimation.contradictions import BLIND
from tactile_push.interface import OBJECT_POSE, POINTS, SENSING_STATE
from tactile_push.mechanics import POLE
from tactile_push.parameters.active_sensing import ActiveSensingParameters, make_sensing
from tactile_push.parameters.push_controller import PushControllerParameters, make_control
from tactile_push.pipeline import Sensing
from tactile_push.pipeline.sensing import Sensed
from tactile_push.simulation import Faults, Rig, Sensor, control_periods, paper_block

RADIUS = 0.0285  # [m]


def tick(number, theta, silence=0.02):
    return Tick(
        state=PUSHING,
        stop_reason=NO_REASON,
        theta=theta,
        phi=math.pi / 2.0,
        v_x=0.0,
        silence=silence,
        saturated=False,
        limited=False,
        finger_x=0.0,
        ticks=number,
        ticks_lost=0,
        elapsed=0.1,
        finger_age=0.02,
        psi=math.pi / 2.0,
    )


@pytest.fixture
def sensing():
    """Return the step for a disk, whose d is 0 by its roundness."""
    values = ActiveSensingParameters.of({'disk_radius': RADIUS})
    return Sensing(make_sensing(values), lambda sec, nanosec: sec + nanosec * 1e-9)


def sensed(**changed):
    """Return what is known after a control period at 10 s whose reading is 0.25 s old."""
    values = {'readings': 3.0, 'age': 0.25} | changed.pop('values', {})
    estimate = SimpleNamespace(
        contradiction='', pose=np.array([0.1, 0.2, 0.0]), covariance=np.eye(3)
    )
    vars(estimate).update(changed.pop('estimate', {}))
    has_pose = changed.pop('has_pose', True)
    return Sensed((10, 0), values, estimate, took=True, forgot='', has_pose=has_pose, blind=False)


def test_message_and_control_period_tell_the_same(sensing):
    values = tick_values(tick(1, 0.1), PushLaw(0.05, 5.0, 0.0))
    by_message = sensing.state((1, 0), list(values), list(values.values()))
    again = Sensing(
        make_sensing(ActiveSensingParameters.of({'disk_radius': RADIUS})), lambda sec, nanosec: sec
    )
    by_tick = again.tick((1, 0), tick(1, 0.1))
    assert repr(by_message.values) == repr(by_tick.values)
    assert by_message.took is by_tick.took is True


def test_message_without_a_number_that_is_needed_is_refused(sensing):
    values = tick_values(tick(1, 0.1), PushLaw(0.05, 5.0, 0.0))
    del values['silence']
    with pytest.raises(ValueError, match='no control period: .*silence'):
        sensing.state((1, 0), list(values), list(values.values()))


def test_nothing_is_known_before_the_first_reading(sensing):
    before = sensing.tick((1, 0), tick(1, math.nan, math.nan))
    assert not (before.known or before.took or before.has_pose)
    assert [topic for topic, _ in before.outputs()] == [SENSING_STATE]
    after = sensing.tick((1, 100_000_000), tick(2, 0.1))
    assert after.known and after.took and after.has_pose
    assert (after.values['d_least'], after.values['d_most']) == (0.0, 0.0)
    assert [topic for topic, _ in after.outputs()] == [SENSING_STATE, OBJECT_POSE]


def test_state_has_the_stamp_of_the_control_period_and_the_pose_that_of_its_reading():
    (_, state), (_, pose) = sensed().outputs()
    assert state['header']['stamp'] == {'sec': 10, 'nanosec': 0}
    assert pose['header']['stamp'] == {'sec': 9, 'nanosec': 750_000_000}
    assert pose['pose']['pose']['position'] == {'x': 0.1, 'y': 0.2}


def test_pose_that_is_not_new_is_not_told():
    assert [topic for topic, _ in sensed(has_pose=False).outputs()] == [SENSING_STATE]


def test_object_that_readings_contradict_is_not_known():
    assert sensed().known
    assert not sensed(estimate={'contradiction': 'it moves by itself'}).known
    assert not sensed(values={'readings': 0.0}).known


@pytest.mark.parametrize('ahead', [-280, -150, -20, 0, 20, 150, 280])
def test_object_is_known_whenever_the_controller_pushes_whatever_the_sensors_clock_says(ahead):
    sensing = Sensing(make_sensing(ActiveSensingParameters()), seconds)
    pushed, known, right = 0, 0, 0
    for period in periods(ahead * 1_000_000, 67):
        sensed = sensing.tick(period.stamp, period.tick)
        values = sensed.values
        pushes = period.tick.state == PUSHING
        assert sensed.known == math.isfinite(values['d']) == pushes
        if pushes:
            assert values['d_least'] <= period.true_d <= values['d_most']
            assert values['age'] == pytest.approx(-1e-3 * ahead, abs=1e-6)
        pushed += pushes
        known += sensed.known
        right += values['d_lower'] <= period.true_d <= values['d_upper']
    assert pushed == known >= 63
    if abs(ahead) <= 20:
        assert right >= 63


def test_direction_of_the_tip_is_that_at_the_moment_of_the_reading():
    # The joints are heard 30 ms before a tick, the sensor 70 ms; the tip turns by 0.2 rad/s.
    told = []

    class Listener:
        timeout = 0.3

        def tick(self, stamp, theta, silence, v_x, psi, x, apart):
            told.append(psi)
            raise StopIteration

    sensing = Sensing(Listener(), seconds)
    for k in range(4):
        psi = 1.5 + 0.2 * (0.1 * k - 0.03)
        with pytest.raises(StopIteration):
            sensing.tick(
                divmod(START * 10**9 + k * PERIOD, 10**9),
                replace(tick(k, 0.1, 0.07), psi=psi, finger_age=0.03),
            )
    assert told == pytest.approx([1.494, *(1.5 + 0.2 * (0.1 * k - 0.07) for k in range(1, 4))])


def test_without_joint_states_the_direction_of_the_tip_is_unknown():
    sensing = Sensing(make_sensing(ActiveSensingParameters()), seconds)
    for k in range(5):
        at = divmod(START * 10**9 + k * PERIOD, 10**9)
        sensed = sensing.tick(at, replace(tick(k, 0.1), psi=math.nan))
        assert sensed.estimate.contradiction == BLIND
        assert not sensed.known
        assert list(sensed.outputs())[1:] == []


def share_inside(sense):
    """Return in which share of 20 s the 95 % interval has d, if the pole follows the commands.

    Active sensing was told that the centre does.
    """
    start = paper_block(-0.12, -0.014, mu_c=0.5)
    config = replace(start, tip_turns=True, commanded_point=POINTS[POLE])
    rig = Rig(config, Faults(sensor=Sensor(noise=math.radians(0.2))))
    push = make_control(PushControllerParameters())
    sensing = Sensing(make_sensing(ActiveSensingParameters()), lambda k, _: 0.1 * k)
    inside = []
    for k, done in enumerate(islice(control_periods(rig, push, 5, 1), 200)):
        d = sense(sensing, (k, 0), done).estimate.d
        inside.append(d.lower <= rig.d <= d.upper)
    return sum(inside) / len(inside)


@pytest.mark.slow
def test_finger_that_follows_with_another_point_is_followed_by_its_joints():
    def without_x(sensing, stamp, done):
        return sensing.tick(stamp, replace(done, finger_x=math.nan))

    assert share_inside(Sensing.tick) > 0.93
    assert share_inside(without_x) < 0.7


# How long after the last one a tick comes, and how far ahead of it its reading is stamped [ms].
TICKS = st.tuples(st.integers(80, 120), st.none() | st.integers(-450, 450))


@given(st.lists(TICKS, min_size=5, max_size=60))
def test_readings_count_exactly_as_long_as_the_controller_believes_them(ticks):
    push = make_control(PushControllerParameters())
    push.activate(0.0)
    disk = ActiveSensingParameters.of({'disk_radius': RADIUS})
    sensing = Sensing(make_sensing(disk), lambda sec, millisec: sec + millisec * 1e-3)
    now = 10_000  # [ms]
    for later, ahead in ticks:
        now += later
        stamp = divmod(now, 1000)
        if ahead is not None:
            push.feel(0.1, (now + ahead) * 1e-3)
        done = replace(push.tick(stamp[0] + stamp[1] * 1e-3), psi=1.5)
        sensed = sensing.tick(stamp, done)
        assert (sensed.values['readings'] > 0.0) == (done.state == PUSHING)
