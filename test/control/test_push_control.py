# Copyright 2026 The tactile_push authors
#
# Licensed under the Apache License, Version 2.0 (the "License");
# you may not use this file except in compliance with the License.
# You may obtain a copy of the License at
#
#     http://www.apache.org/licenses/LICENSE-2.0
#
# Unless required by applicable law or agreed to in writing, software
# distributed under the License is distributed on an "AS IS" BASIS,
# WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
# See the License for the specific language governing permissions and
# limitations under the License.

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tactile_push.control import (
    AHEAD,
    CONTACT_LOST,
    PUSHING,
    STATES,
    WAITING,
    PushControl,
    PushLaw,
)

checked = settings(derandomize=True, deadline=None, max_examples=60)
PERIOD, TIMEOUT = 0.125, 0.25  # sums of them are exact


def control(kp=0.5, kd=2.0, theta_desired=0.0):
    return PushControl(PushLaw(kp, kd, theta_desired), 0.005, PERIOD, TIMEOUT)


def pushing(at=10.0, theta=0.1):
    # Two readings; the second one gives phi = 90 degrees + 0.5 * 0.1.
    running = control()
    running.activate(at - PERIOD)
    running.feel(theta, at - PERIOD)
    running.tick(at - PERIOD)
    running.feel(theta, at)
    assert running.tick(at).phi == pytest.approx(AHEAD + 0.05, rel=1e-14)
    return running


def across(phi_less_90):
    return pytest.approx(-0.005 * math.tan(phi_less_90), rel=1e-12)


def test_the_states_are_named_for_people():
    assert STATES == (WAITING, PUSHING, CONTACT_LOST)
    assert len(set(STATES)) == 3


def test_before_the_first_contact_it_is_silent():
    waiting = control()
    waiting.activate(5.0)

    ticks = [waiting.tick(5.0 + k * PERIOD) for k in range(100)]

    assert all(tick.state == WAITING for tick in ticks)
    assert all(tick.v_x is None for tick in ticks)
    assert all(tick.phi == AHEAD and not tick.saturated for tick in ticks)
    assert all(math.isnan(tick.theta) for tick in ticks)
    assert [tick.silence for tick in ticks] == [k * PERIOD for k in range(100)]


def test_the_first_contact_starts_the_push_straight_ahead():
    starting = control()
    starting.activate(0.0)
    starting.tick(0.0)
    starting.feel(0.4, 0.0625)

    tick = starting.tick(0.125)

    assert tick.state == PUSHING
    assert tick.theta == 0.4
    assert tick.phi == AHEAD
    assert tick.v_x == 0.0
    assert tick.silence == 0.0625
    assert not tick.saturated


def test_it_pushes_by_the_law():
    running = control()
    v_x = []
    for k, theta in enumerate((0.1, 0.12, 0.08)):
        running.feel(theta, k * PERIOD)
        v_x.append(running.tick(k * PERIOD).v_x)

    # phi - 90 degrees: 0; 0.5 * 0.12 + 2 * 0.02 = 0.1; + 0.5 * 0.08 - 2 * 0.04 = 0.06
    assert v_x == [0.0, across(0.1), across(0.06)]


def test_a_saturated_push_is_reported():
    running = control()
    for k, theta in enumerate((0.0, 1.0)):
        running.feel(theta, k * PERIOD)
        tick = running.tick(k * PERIOD)

    assert tick.saturated
    assert tick.phi == math.radians(147.0)
    assert tick.v_x == across(math.radians(57.0))


def test_only_the_last_of_several_contacts_in_a_period_is_used():
    running = pushing(10.0)
    running.feel(0.9, 10.03125)
    running.feel(0.2, 10.0625)

    # + 0.5 * 0.2 + 2 * 0.1
    assert running.tick(10.125).phi == pytest.approx(AHEAD + 0.05 + 0.3, rel=1e-14)


def test_a_reading_is_used_only_once():
    running = pushing(10.0)

    without = running.tick(10.125)

    assert without.state == PUSHING
    assert without.phi == pytest.approx(AHEAD + 0.05, rel=1e-14)
    assert without.v_x == across(0.05)
    assert without.silence == 0.125


def test_a_missed_reading_is_not_a_change_of_the_last_one():
    running = pushing(10.0)
    running.tick(10.125)
    running.feel(0.13, 10.1875)

    # + 0.5 * 0.13 + 2 * 0.03, once
    assert running.tick(10.25).phi == pytest.approx(AHEAD + 0.05 + 0.125, rel=1e-14)


def test_it_stops_exactly_when_contact_is_older_than_the_timeout():
    running = pushing(10.0)

    at_timeout, beyond, later = (running.tick(10.0 + k * PERIOD) for k in (2, 3, 80))

    assert (at_timeout.state, at_timeout.v_x) == (PUSHING, across(0.05))
    for tick in (beyond, later):
        assert tick.state == CONTACT_LOST
        assert tick.v_x == 0.0
        assert tick.phi == AHEAD
        assert not tick.saturated
    assert later.silence == 10.0


def test_it_resumes_by_itself_from_straight_ahead_without_a_kick():
    running = pushing(10.0)
    running.tick(11.0)
    running.feel(-0.5, 11.125)  # far from the 0.1 before

    resumed = running.tick(11.125)

    assert (resumed.state, resumed.phi, resumed.v_x) == (PUSHING, AHEAD, 0.0)
    running.feel(-0.5, 11.25)
    assert running.tick(11.25).phi == pytest.approx(AHEAD - 0.25, rel=1e-14)


@pytest.mark.parametrize('stamp', [10.0, 9.96875, 9.9, -math.inf, math.nan])
def test_a_repeated_or_earlier_or_undated_contact_does_not_count(stamp):
    running = pushing(10.0)
    running.feel(0.6, stamp)

    tick = running.tick(10.125)

    assert tick.theta == 0.1
    assert tick.v_x == across(0.05)
    assert tick.silence == 0.125
    running.feel(0.6, stamp)
    assert running.tick(10.375).state == CONTACT_LOST


def test_a_contact_that_comes_out_of_order_does_not_replace_a_newer_one():
    running = pushing(10.0)
    running.feel(0.2, 10.125)
    running.feel(0.9, 10.0625)

    assert running.tick(10.125).theta == 0.2


@pytest.mark.parametrize('theta', [math.nan, math.inf, -math.inf])
def test_what_is_no_angle_is_no_contact(theta):
    running = pushing(10.0)
    for k in range(1, 4):
        running.feel(theta, 10.0 + k * PERIOD)
        tick = running.tick(10.0 + k * PERIOD)
        assert math.isfinite(tick.phi)
        assert tick.theta == 0.1

    assert (tick.state, tick.v_x) == (CONTACT_LOST, 0.0)


@pytest.mark.parametrize('theta', [math.nan, math.inf])
def test_what_is_no_angle_starts_nothing(theta):
    waiting = control()
    waiting.activate(0.0)
    waiting.feel(theta, 0.0)

    tick = waiting.tick(0.0)

    assert (tick.state, tick.v_x) == (WAITING, None)
    assert math.isnan(tick.theta)


@pytest.mark.parametrize('age', [0.3125, 10.0, 1e9])
def test_an_old_contact_starts_nothing(age):
    waiting = control()
    waiting.activate(20.0)
    waiting.feel(0.1, 20.0 - age)

    tick = waiting.tick(20.0)

    assert (tick.state, tick.v_x, tick.silence) == (WAITING, None, age)


def test_an_old_contact_does_not_resume():
    running = pushing(10.0)
    running.tick(11.0)
    running.feel(0.2, 10.5)

    tick = running.tick(11.125)

    assert (tick.state, tick.v_x) == (CONTACT_LOST, 0.0)


@pytest.mark.parametrize('ahead', [0.3, 10.0, 1e9, math.inf])
def test_a_contact_from_the_future_starts_nothing(ahead):
    waiting = control()
    waiting.activate(20.0)
    waiting.feel(0.1, 20.0 + ahead)

    tick = waiting.tick(20.0)

    assert (tick.state, tick.v_x) == (WAITING, None)


@pytest.mark.parametrize('ahead', [0.3, 10.0, 1e9, math.inf])
def test_a_contact_from_the_future_is_not_pushed_by(ahead):
    running = pushing(10.0)
    running.feel(0.9, 10.125 + ahead)

    tick = running.tick(10.125)

    assert tick.phi in (AHEAD, pytest.approx(AHEAD + 0.05, rel=1e-14))
    assert tick.v_x in (0.0, across(0.05))


@pytest.mark.parametrize('ahead', [0.3, 10.0, 1e9, math.inf])
def test_a_contact_from_the_future_does_not_keep_later_ones_from_counting(ahead):
    running = pushing(10.0)
    running.feel(0.9, 10.125 + ahead)
    running.tick(10.125)
    for k in range(2, 5):
        running.feel(0.2, 10.0 + k * PERIOD)
        tick = running.tick(10.0 + k * PERIOD)

    assert tick.state == PUSHING
    assert tick.theta == 0.2
    assert tick.phi > AHEAD + 0.1  # two errors of 0.2 and kp = 0.5 at least


def test_a_clock_that_is_a_little_ahead_does_no_harm():
    running = pushing(10.0)
    running.feel(0.2, 10.1875)

    tick = running.tick(10.125)

    assert tick.state == PUSHING
    assert tick.phi == pytest.approx(AHEAD + 0.35, rel=1e-14)
    assert tick.silence == -0.0625


def test_ticks_are_counted_from_1():
    counting = control()
    counting.activate(3.0)

    ticks = [counting.tick(3.0 + k * PERIOD) for k in range(5)]

    assert [tick.ticks for tick in ticks] == [1, 2, 3, 4, 5]
    assert [tick.ticks_lost for tick in ticks] == [0, 0, 0, 0, 0]


@pytest.mark.parametrize(
    ('times', 'lost'),
    [
        ([0, 1, 2, 3], 0),
        ([0, 2], 1),
        ([0, 1, 5, 6], 3),
        ([0, 3, 4, 6], 3),
        ([0, 1.3, 1.9, 3.1, 4], 0),  # early and late, but all there
        ([0, 1, 1, 2], 0),
        ([100], 0),
    ],
)
def test_periods_without_a_tick_are_lost(times, lost):
    counting = control()
    counting.activate(0.0)

    for time in times:
        tick = counting.tick(time * PERIOD)

    assert tick.ticks_lost == lost
    assert tick.ticks == len(times)


def test_activation_starts_over():
    running = pushing(10.0)
    running.tick(10.5)  # three ticks lost, contact lost

    running.activate(20.0)
    tick = running.tick(20.125)

    assert (tick.state, tick.v_x, tick.phi) == (WAITING, None, AHEAD)
    assert (tick.ticks, tick.ticks_lost) == (1, 0)
    assert tick.silence == 0.125
    assert math.isnan(tick.theta)
    running.feel(0.7, 20.25)
    assert running.tick(20.25).phi == AHEAD


def test_activation_forgets_a_contact_that_was_not_used():
    running = pushing(10.0)
    running.feel(0.7, 10.0625)

    running.activate(10.0625)

    assert running.tick(10.125).state == WAITING


def test_a_clock_that_goes_back_stops_the_finger_and_forgets_every_stamp():
    running = pushing(10.0)
    running.tick(10.125)

    back = running.tick(2.0)

    assert back.v_x == 0.0
    assert back.phi == AHEAD
    assert math.isnan(back.theta)
    assert back.silence == 0.0
    assert (back.ticks, back.ticks_lost) == (4, 0)

    running.feel(-0.5, 2.0625)  # before the clock's 10.0, but it is the first one now
    resumed = running.tick(2.125)
    assert (resumed.state, resumed.theta, resumed.phi) == (PUSHING, -0.5, AHEAD)
    assert resumed.ticks_lost == 0
    running.feel(-0.5, 2.25)
    assert running.tick(2.25).phi == pytest.approx(AHEAD - 0.25, rel=1e-14)


def test_a_clock_that_goes_back_without_contact_loses_it():
    running = pushing(10.0)
    running.tick(2.0)

    tick = running.tick(2.375)

    assert (tick.state, tick.v_x) == (CONTACT_LOST, 0.0)


def test_a_clock_that_goes_back_before_the_first_contact_changes_nothing():
    waiting = control()
    waiting.activate(10.0)
    waiting.tick(10.0)

    tick = waiting.tick(2.0)

    assert (tick.state, tick.v_x, tick.silence) == (WAITING, None, 0.0)


anything = st.floats(-2.0, 2.0) | st.sampled_from([math.nan, math.inf, -math.inf])


@checked
@given(
    st.lists(
        st.tuples(st.floats(-0.5, 1.0), anything, st.floats(-1.0, 1.0) | st.just(math.nan)),
        max_size=40,
    )
)
def test_whatever_comes_the_command_is_bounded_and_rests_without_contact(events):
    running = control()
    running.activate(0.0)
    now = 0.0
    for advance, theta, stamp in events:
        now += advance
        running.feel(theta, now + stamp)
        tick = running.tick(now)
        if tick.state == WAITING:
            assert tick.v_x is None
        else:
            assert abs(tick.v_x) <= 0.005 / math.tan(math.radians(33.0)) * (1.0 + 1e-14)
        if tick.state != PUSHING:
            assert tick.phi == AHEAD
            assert tick.v_x in (None, 0.0)
        assert math.radians(33.0) <= tick.phi <= math.radians(147.0)
