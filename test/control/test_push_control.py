# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import itertools
import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tactile_push.control import (
    AHEAD,
    ANOTHER_COMMAND,
    CLOCK_JUMPED,
    CONTACT_SILENT,
    FINGER_UNKNOWN,
    HELD,
    IMPLAUSIBLE_CONTACT,
    INACTIVE,
    NO_REASON,
    NOTHING_TO_DO,
    PUSHING,
    STATES,
    STOP_REASONS,
    STOPPED,
    TICKS_LOST,
    WAITING,
    WORKSPACE_LIMIT,
    Limits,
    PushControl,
    PushLaw,
    Steadying,
)

checked = settings(derandomize=True, deadline=None, max_examples=60)
PERIOD, TIMEOUT = 0.125, 0.25  # sums of them are exact


def control(kp=0.5, kd=2.0, theta_desired=0.0, **limits):
    bounds = Limits(
        **{'contact_timeout': TIMEOUT, 'max_speed': 1.0, 'max_acceleration': 1.0, **limits}
    )
    running = PushControl(PushLaw(kp, kd, theta_desired), 0.005, PERIOD, bounds)
    running.activate(0.0)
    return running


def ticks_until(running, start, end):
    """Tick every period from start to end, both included, and give the last tick."""
    for k in range(round((end - start) / PERIOD) + 1):
        tick = running.tick(start + k * PERIOD)
    return tick


def pushing(at=10.0, theta=0.1, **limits):
    # Two readings; the second one gives phi = 90 degrees + 0.5 * 0.1.
    running = control(**limits)
    running.activate(at - PERIOD)
    running.feel(theta, at - PERIOD)
    running.tick(at - PERIOD)
    running.feel(theta, at)
    assert running.tick(at).phi == pytest.approx(AHEAD + 0.05, rel=1e-14)
    return running


def across(phi_less_90):
    return pytest.approx(-0.005 * math.tan(phi_less_90), rel=1e-12)


def test_the_states_are_named_for_people():
    assert STATES == (INACTIVE, WAITING, PUSHING, STOPPED)
    assert len(set(STATES)) == 4
    assert STOP_REASONS[0] == NO_REASON == ''
    assert len(set(STOP_REASONS)) == 9
    assert set(STOP_REASONS) > HELD == {TICKS_LOST, CLOCK_JUMPED, ANOTHER_COMMAND}


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

    running.tick(10.0 + PERIOD)
    at_timeout, beyond = (running.tick(10.0 + k * PERIOD) for k in (2, 3))
    later = ticks_until(running, 10.5, 20.0)

    assert (at_timeout.state, at_timeout.v_x) == (PUSHING, across(0.05))
    for tick in (beyond, later):
        assert (tick.state, tick.stop_reason) == (STOPPED, CONTACT_SILENT)
        assert tick.v_x == 0.0
        assert tick.phi == AHEAD
        assert not tick.saturated
    assert later.silence == 10.0


def test_it_resumes_by_itself_from_straight_ahead_without_a_kick():
    running = pushing(10.0)
    assert ticks_until(running, 10.125, 11.0).state == STOPPED
    running.feel(-0.5, 11.125)  # far from the 0.1 before

    resumed = running.tick(11.125)

    assert (resumed.state, resumed.phi, resumed.v_x) == (PUSHING, AHEAD, 0.0)
    assert resumed.stop_reason == NO_REASON
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
    assert running.tick(10.375).state == STOPPED


def test_a_contact_that_comes_out_of_order_does_not_replace_a_newer_one():
    running = pushing(10.0)
    running.feel(0.2, 10.125)
    running.feel(0.9, 10.0625)

    assert running.tick(10.125).theta == 0.2


IMPOSSIBLE = [math.nan, math.inf, -math.inf, 1.58, -3.0]  # an edge that faces away


@pytest.mark.parametrize('theta', IMPOSSIBLE)
def test_what_no_pushed_edge_can_have_stops_the_finger_at_the_next_tick(theta):
    running = pushing(10.0)
    running.feel(theta, 10.0625)
    running.feel(0.1, 10.125)

    tick = running.tick(10.125)

    assert (tick.state, tick.stop_reason) == (STOPPED, IMPLAUSIBLE_CONTACT)
    assert (tick.v_x, tick.phi, tick.theta) == (0.0, AHEAD, 0.1)


@pytest.mark.parametrize('theta', IMPOSSIBLE)
def test_it_resumes_by_itself_when_contacts_have_been_plausible_for_the_timeout(theta):
    running = pushing(10.0)
    running.feel(theta, 10.125)
    running.tick(10.125)
    states = []
    for k in range(2, 6):
        running.feel(0.1, 10.0 + k * PERIOD)
        tick = running.tick(10.0 + k * PERIOD)
        states.append(tick.state)
        assert tick.v_x == 0.0 or len(states) == 4

    assert states == [STOPPED, STOPPED, PUSHING, PUSHING]
    assert tick.v_x == across(0.05)


def test_what_no_pushed_edge_can_have_is_nothing_while_inactive():
    running = control()
    running.deactivate()
    running.feel(math.nan, 1.0)
    running.activate(1.0)
    running.feel(0.1, 1.0)

    assert running.tick(1.0).state == PUSHING


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
    ticks_until(running, 10.125, 11.0)
    running.feel(0.2, 10.5)

    tick = running.tick(11.125)

    assert (tick.state, tick.v_x) == (STOPPED, 0.0)


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


def test_a_clock_that_is_ahead_does_not_put_off_the_stop():
    running = pushing(10.0)
    running.feel(0.2, 10.375)  # ahead by as much as is believed

    states = [running.tick(10.0 + k * PERIOD).state for k in range(1, 5)]

    # Looked at at 10.125, so it is older than the timeout of 0.25 after three more ticks.
    assert states == [PUSHING, PUSHING, PUSHING, STOPPED]


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
    assert running.tick(10.625).stop_reason == CONTACT_SILENT

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

    assert (back.state, back.stop_reason, back.v_x) == (STOPPED, CLOCK_JUMPED, 0.0)
    assert back.phi == AHEAD
    assert math.isnan(back.theta)
    assert back.silence == 0.0
    assert (back.ticks, back.ticks_lost) == (4, 0)

    running.feel(-0.5, 2.125)  # before the clock's 10.0, but it is the first one now
    held = running.tick(2.125)
    assert (held.stop_reason, held.v_x, held.theta) == (CLOCK_JUMPED, 0.0, -0.5)
    assert running.resume()
    resumed = running.tick(2.25)
    assert (resumed.state, resumed.theta, resumed.phi) == (PUSHING, -0.5, AHEAD)
    assert resumed.ticks_lost == 0


@pytest.mark.parametrize('jump', [-3600.0, -0.25, 0.25, 3600.0])
def test_a_clock_that_is_set_is_seen_against_one_that_cannot_be(jump):
    running = pushing(10.0)
    running.tick(10.125, 0.125)
    running.feel(0.1, 10.25)
    assert running.tick(10.25, 0.125).state == PUSHING
    running.feel(0.1, 10.375 + jump)

    tick = running.tick(10.375 + jump, 0.125)

    assert (tick.state, tick.stop_reason, tick.v_x) == (STOPPED, CLOCK_JUMPED, 0.0)
    assert tick.ticks_lost == 0


def test_a_clock_that_is_adjusted_by_less_than_a_period_does_no_harm():
    running = pushing(10.0)
    running.tick(10.125, 0.125)
    for k, shift in ((2, 0.03125), (3, -0.03125), (4, 0.0)):
        running.feel(0.1, 10.0 + k * PERIOD + shift)
        tick = running.tick(10.0 + k * PERIOD + shift, PERIOD)
        assert (tick.state, tick.ticks_lost) == (PUSHING, 0)


def test_a_jump_that_somebody_else_saw_stops_the_finger():
    running = pushing(10.0)
    running.notice_clock_jump(500.0)

    tick = running.tick(500.0)

    assert (tick.stop_reason, tick.v_x, tick.silence) == (CLOCK_JUMPED, 0.0, 0.0)
    assert tick.ticks_lost == 0


def test_a_clock_that_goes_back_before_the_first_contact_changes_nothing():
    waiting = control()
    waiting.activate(10.0)
    waiting.tick(10.0)

    tick = waiting.tick(2.0)

    assert (tick.state, tick.v_x, tick.silence) == (WAITING, None, 0.0)


@pytest.mark.parametrize(('lost', 'state'), [(3, PUSHING), (4, STOPPED), (400, STOPPED)])
@pytest.mark.parametrize('steady', [False, True])
def test_more_ticks_lost_than_allowed_stop_the_finger_until_it_is_resumed(lost, state, steady):
    running = pushing(10.0, contact_timeout=1000.0)
    running.tick(10.125)
    late = 0.125 + (lost + 1) * PERIOD
    running.feel(0.1, 10.0 + late)

    tick = running.tick(10.0 + late, late - 0.125 if steady else math.nan)

    assert (tick.state, tick.ticks_lost) == (state, lost)
    if state == STOPPED:
        assert (tick.stop_reason, tick.v_x) == (TICKS_LOST, 0.0)
        for k in range(1, 20):
            running.feel(0.1, 10.0 + late + k * PERIOD)
            tick = running.tick(10.0 + late + k * PERIOD)
            assert (tick.stop_reason, tick.v_x) == (TICKS_LOST, 0.0)
        assert running.resume()
        tick = running.tick(10.0 + late + 20 * PERIOD)
        assert (tick.state, tick.v_x, tick.phi) == (PUSHING, 0.0, AHEAD)


def test_a_command_of_somebody_else_stops_the_finger_until_it_is_resumed():
    running = pushing(10.0)
    running.notice_another_command()
    for k in range(1, 10):
        running.feel(0.1, 10.0 + k * PERIOD)
        tick = running.tick(10.0 + k * PERIOD)
        assert (tick.state, tick.stop_reason, tick.v_x) == (STOPPED, ANOTHER_COMMAND, 0.0)

    assert running.resume()
    assert not running.resume()
    running.feel(0.1, 11.25)
    assert running.tick(11.25).state == PUSHING


def test_before_the_first_contact_others_may_move_the_finger():
    waiting = control()
    waiting.activate(0.0)
    waiting.notice_another_command()
    waiting.feel(0.1, 0.0)

    assert waiting.tick(0.0).state == PUSHING


def test_activation_resumes_too():
    running = pushing(10.0)
    running.notice_another_command()
    running.tick(10.125)

    running.activate(10.125)
    running.feel(0.1, 10.25)

    assert running.tick(10.25).state == PUSHING


def test_there_is_nothing_to_resume_unless_it_is_held():
    running = pushing(10.0)
    assert not running.resume()
    ticks_until(running, 10.125, 11.0)
    assert not running.resume()
    assert running.tick(11.125).stop_reason == CONTACT_SILENT
    assert not control().resume()


def test_resumed_without_contact_it_rests_until_there_is_one():
    running = pushing(10.0)
    ticks_until(running, 10.125, 11.0)
    running.notice_another_command()  # while stopped for another reason
    assert running.tick(11.125).stop_reason == ANOTHER_COMMAND
    assert running.resume()

    tick = running.tick(11.25)

    assert (tick.state, tick.stop_reason, tick.v_x) == (STOPPED, CONTACT_SILENT, 0.0)
    running.feel(0.1, 11.375)
    assert running.tick(11.375).state == PUSHING


def test_deactivation_gives_a_last_zero():
    running = pushing(10.0)

    last = running.deactivate()

    assert (last.state, last.stop_reason, last.v_x, last.phi) == (INACTIVE, NO_REASON, 0.0, AHEAD)
    assert control().deactivate().v_x == 0.0


# The edge at 0.1 asks for a finger to the left: phi > 90 degrees.
def test_at_the_workspace_limit_it_does_not_move_outward():
    running = pushing(10.0, workspace_min=-0.1, workspace_max=0.1)
    running.locate_finger(-0.1, 10.0625)
    running.feel(0.1, 10.125)

    tick = running.tick(10.125)

    assert (tick.state, tick.stop_reason, tick.v_x) == (STOPPED, WORKSPACE_LIMIT, 0.0)
    assert (tick.phi, tick.finger_x) == (AHEAD, -0.1)
    assert running.tick(10.25).stop_reason == WORKSPACE_LIMIT  # no reading, no change


def test_from_the_workspace_limit_it_moves_inward_by_itself_and_without_a_kick():
    running = pushing(10.0, workspace_min=-0.1, workspace_max=0.1)
    running.locate_finger(-0.11, 10.0625)
    running.feel(0.1, 10.125)
    running.tick(10.125)
    running.locate_finger(-0.11, 10.25)
    running.feel(0.09, 10.25)

    tick = running.tick(10.25)

    # From straight ahead + 0.5 * 0.09 - 2 * 0.01 is still outward.
    assert (tick.stop_reason, tick.v_x) == (WORKSPACE_LIMIT, 0.0)
    running.locate_finger(-0.11, 10.375)
    running.feel(0.05, 10.375)
    inward = running.tick(10.375)
    # 0.5 * 0.05 - 2 * 0.04 = -0.055
    assert (inward.state, inward.stop_reason) == (PUSHING, NO_REASON)
    assert inward.v_x == across(-0.055)


@pytest.mark.parametrize('x', [0.1, 0.2])
def test_at_the_other_limit_it_moves_inward(x):
    running = pushing(10.0, workspace_min=-0.1, workspace_max=0.1)
    running.locate_finger(x, 10.0625)
    running.feel(0.1, 10.125)

    assert running.tick(10.125).v_x == across(0.1)


def test_without_knowing_where_the_finger_is_it_pushes_until_it_has_known_once():
    running = pushing(10.0, joint_state_timeout=0.25)
    assert math.isnan(running.tick(10.125).finger_x)
    running.locate_finger(0.0, 10.125)
    running.locate_finger(math.nan, 10.25)
    for k in range(2, 5):
        running.feel(0.1, 10.0 + k * PERIOD)
        tick = running.tick(10.0 + k * PERIOD)
        reason = FINGER_UNKNOWN if k * PERIOD > 0.375 else NO_REASON
        assert tick.stop_reason == reason
    assert (tick.state, tick.v_x) == (STOPPED, 0.0)

    running.locate_finger(0.0, 10.625)
    running.feel(0.1, 10.625)
    tick = running.tick(10.625)
    assert (tick.state, tick.v_x, tick.phi) == (PUSHING, 0.0, AHEAD)


@pytest.mark.parametrize('act', ['jump', 'activate'])
def test_a_finger_that_was_known_once_has_to_be_known_after_a_new_start_too(act):
    running = pushing(10.0)
    running.locate_finger(0.0, 10.125)
    running.feel(0.1, 10.125)
    assert running.tick(10.125).state == PUSHING
    if act == 'jump':
        running.notice_clock_jump(20.0)
        running.tick(20.0)
        assert running.resume()
    else:
        running.deactivate()
        running.activate(20.0)
    for k in range(1, 5):
        running.feel(0.1, 20.0 + k * PERIOD)
        tick = running.tick(20.0 + k * PERIOD)
        assert (tick.state, tick.stop_reason, tick.v_x) == (STOPPED, FINGER_UNKNOWN, 0.0)

    running.locate_finger(0.0, 20.625)
    running.feel(0.1, 20.625)
    tick = running.tick(20.625)
    assert (tick.state, tick.v_x) == (PUSHING, 0.0)


def test_what_forbids_to_push_at_the_first_contact_is_said():
    waiting = control()
    waiting.locate_finger(0.0, 0.0)
    assert waiting.tick(0.0).state == WAITING
    assert waiting.tick(5.0).state == WAITING
    waiting.feel(0.1, 5.125)

    tick = waiting.tick(5.125)

    assert (tick.state, tick.stop_reason, tick.v_x) == (STOPPED, FINGER_UNKNOWN, 0.0)
    for k in range(2, 6):
        waiting.locate_finger(0.0, 5.0 + k * PERIOD)
        waiting.feel(math.nan, 5.0 + k * PERIOD)
        waiting.feel(0.1, 5.0 + k * PERIOD)
        assert waiting.tick(5.0 + k * PERIOD).stop_reason == IMPLAUSIBLE_CONTACT


@pytest.mark.parametrize('stamp', [10.0, 9.0, 11.0, math.nan])
def test_a_position_that_is_old_or_from_the_future_does_not_count(stamp):
    running = pushing(10.0)
    running.locate_finger(0.05, 10.0)
    running.tick(10.125)
    running.locate_finger(-1.0, stamp)

    assert running.tick(10.25).finger_x == 0.05


def test_the_velocity_is_bounded_and_the_law_goes_on_from_what_the_finger_does():
    running = pushing(10.0, max_speed=0.001)
    running.feel(0.5, 10.125)

    tick = running.tick(10.125)

    assert tick.limited
    assert tick.v_x == -0.001
    assert tick.phi == pytest.approx(math.pi - math.atan2(0.005, 0.001), rel=1e-14)
    running.feel(0.5, 10.25)
    assert running.tick(10.25).v_x == -0.001
    running.feel(0.0, 10.375)
    # - 2 * 0.5 takes it far to the other side at once: nothing has wound up.
    assert running.tick(10.375).v_x == 0.001


def test_the_change_of_the_velocity_is_bounded_but_for_a_stop():
    running = pushing(10.0, max_acceleration=0.008)  # 1 mm/s a period of 0.125 s
    v_x = [running.tick(10.0).v_x]
    for k in range(1, 8):
        running.feel(0.1 + 0.2 * k, 10.0 + k * PERIOD)
        v_x.append(running.tick(10.0 + k * PERIOD).v_x)
    steps = [a - b for a, b in itertools.pairwise(v_x)]
    assert max(steps) == pytest.approx(0.001, rel=1e-12)
    assert v_x[-1] < -0.005

    stopped = ticks_until(running, 10.0 + 8 * PERIOD, 10.0 + 11 * PERIOD)
    assert stopped.v_x == 0.0


def test_the_bounds_leave_the_law_alone_where_they_are_not_met():
    bounded = pushing(10.0, max_speed=0.008, max_acceleration=0.2)
    free = pushing(10.0, max_speed=1e9, max_acceleration=1e9)
    for k in range(1, 30):
        theta = 0.1 * math.cos(0.3 * k)
        for running in (bounded, free):
            running.feel(theta, 10.0 + k * PERIOD)
        ticks = [running.tick(10.0 + k * PERIOD) for running in (bounded, free)]
        assert ticks[0] == ticks[1]
        assert not ticks[0].limited


def test_contacts_that_pause_for_longer_than_the_timeout_make_no_kick():
    running = pushing(10.0)
    running.feel(0.6, 10.28125)  # no tick saw the pause

    tick = running.tick(10.28125)

    assert (tick.state, tick.phi, tick.v_x) == (PUSHING, AHEAD, 0.0)


anything = st.floats(-2.0, 2.0) | st.sampled_from([math.nan, math.inf, -math.inf])
positions = st.floats(-0.2, 0.2) | st.just(math.nan)


@checked
@given(
    st.lists(
        st.tuples(
            st.floats(-0.5, 1.0),
            anything,
            st.floats(-1.0, 1.0) | st.just(math.nan),
            positions,
            st.sampled_from(['', '', '', 'other', 'resume', 'activate', 'jump']),
        ),
        max_size=40,
    )
)
def test_whatever_comes_the_command_is_bounded_and_rests_unless_it_pushes(events):
    running = control(max_speed=0.006, max_acceleration=0.016)
    now = before = 0.0
    for advance, theta, stamp, x, act in events:
        now += advance
        running.feel(theta, now + stamp)
        running.locate_finger(x, now + stamp)
        if act == 'other':
            running.notice_another_command()
        elif act == 'resume':
            running.resume()
        elif act == 'activate':
            running.activate(now)
        elif act == 'jump':
            running.notice_clock_jump(now)
        tick = running.tick(now)
        v_x = tick.v_x or 0.0
        assert abs(v_x) <= 0.006
        assert v_x == 0.0 or abs(v_x - before) <= 0.016 * PERIOD * (1.0 + 1e-12)
        assert (tick.v_x is None) == (tick.state == WAITING)
        assert (tick.stop_reason != NO_REASON) == (tick.state == STOPPED)
        if tick.state != PUSHING:
            assert tick.phi == AHEAD
            assert v_x == 0.0
        elif v_x > 0.0:
            assert not tick.finger_x >= 0.105
        assert math.radians(33.0) <= tick.phi <= math.radians(147.0)
        before = v_x


def test_a_tick_tells_how_old_the_position_of_the_finger_is():
    running = pushing(10.0)
    assert math.isnan(running.tick(10.125).finger_age)
    running.locate_finger(0.01, 10.125)
    running.feel(0.1, 10.25)
    assert running.tick(10.25).finger_age == 0.125


def test_a_tick_tells_how_the_tip_was_turned_at_the_position_of_the_finger():
    running = pushing(10.0)
    running.locate_finger(0.01, 10.0625, 1.7)
    assert running.tick(10.125).psi == 1.7
    running.locate_finger(0.02, 10.0, 1.8)  # not newer
    assert running.tick(10.25).psi == 1.7
    running.locate_finger(0.03, 10.25)  # the links are known, and a wrist is not
    tick = running.tick(10.375)
    assert tick.finger_x == 0.03
    assert math.isnan(tick.psi)


def test_a_tick_tells_what_the_clock_that_cannot_be_set_said():
    running = pushing(10.0)
    assert math.isnan(running.tick(10.125).elapsed)
    assert running.tick(10.25, 0.1250001).elapsed == 0.1250001


@checked
@given(
    thetas=st.lists(st.floats(-1.2, 1.2), min_size=8, max_size=20),
    x=st.sampled_from([math.nan, 0.0, 0.02]),
    middle=st.integers(2, 5),
)
def test_another_control_can_go_on_where_one_has_pushed(thetas, x, middle):
    first = control(max_speed=0.004, max_acceleration=0.02)
    ticks = []
    second = control(max_speed=0.004, max_acceleration=0.02)
    for k, theta in enumerate(thetas):
        now = 10.0 + k * PERIOD
        for running in (first, second):
            running.locate_finger(x, now - 0.0625, 1.5 - k / 64.0)
            running.feel(theta, now - 0.03125)
        ticks.append(first.tick(now))
        if k == middle:
            second.continue_from(ticks[-1], now)
        elif k > middle:
            assert repr(second.tick(now)) == repr(ticks[-1])  # in which NaN is NaN
    assert ticks[middle].state == PUSHING


def steadied(bound=0.1, x=0.0):
    """Return a control that pushes an edge at theta_d, and whose trim has begun."""
    running = control()
    running.steadying = Steadying(bound, 0.02, 0.01)
    for k in range(-4, 1):
        running.locate_finger(x, 10.0 + k * PERIOD, AHEAD)
        running.feel(0.0, 10.0 + k * PERIOD)
        assert running.tick(10.0 + k * PERIOD).trim == 0.0
    return running


def drifting(running, ticks, start=10.0, v_x=0.0005, psi=AHEAD):
    """Drift on at an angle of 0 and return the ticks."""
    found = []
    for k in range(1, ticks + 1):
        running.locate_finger(v_x * k * PERIOD, start + k * PERIOD, psi)
        running.feel(0.0, start + k * PERIOD)
        found.append(running.tick(start + k * PERIOD))
    return found


def test_the_law_steers_to_the_trimmed_angle():
    running = steadied()
    before = running.tick(10.0).phi
    ticks = drifting(running, 3)
    # A drift to the right raises the trim, so phi falls below straight ahead by kp times the sum.
    assert 0.0 < ticks[0].trim < ticks[1].trim < ticks[2].trim
    assert ticks[-1].phi == pytest.approx(before - 0.5 * sum(tick.trim for tick in ticks))
    assert running.law.theta_desired == 0.0
    assert running.law.aim == ticks[-1].trim


def test_without_a_bound_everything_is_as_without_steadying():
    plain, unbounded = control(), control()
    unbounded.steadying = Steadying(0.0)
    for running in (plain, unbounded):
        running.feel(0.0, 10.0 - PERIOD)
        running.tick(10.0 - PERIOD)
    assert [repr(t) for t in drifting(plain, 20)] == [repr(t) for t in drifting(unbounded, 20)]


STOPS = {
    CONTACT_SILENT: lambda running, now: [running.tick(now + k * PERIOD) for k in range(3)],
    IMPLAUSIBLE_CONTACT: lambda running, now: running.feel(math.nan, now),
    ANOTHER_COMMAND: lambda running, now: running.notice_another_command(),
    CLOCK_JUMPED: lambda running, now: running.notice_clock_jump(now),
}


@pytest.mark.parametrize('reason', STOPS)
def test_whatever_stops_the_finger_ends_the_trim(reason):
    running = steadied()
    drifting(running, 20)
    assert running.law.trim > 0.0
    now = 10.0 + 21 * PERIOD
    STOPS[reason](running, now)
    tick = running.tick(now + 3 * PERIOD)
    assert (tick.state, tick.stop_reason) == (STOPPED, reason)
    assert (tick.trim, running.law.aim) == (0.0, 0.0)


def test_the_end_of_the_workspace_ends_the_trim():
    running = steadied()
    drifting(running, 20)
    running.locate_finger(-0.105, 10.0 + 21 * PERIOD, AHEAD)
    running.feel(0.4, 10.0 + 21 * PERIOD)  # the law wants it to the left
    tick = running.tick(10.0 + 21 * PERIOD)
    assert (tick.stop_reason, tick.trim) == (WORKSPACE_LIMIT, 0.0)


@pytest.mark.parametrize('deactivate', [True, False])
def test_a_new_start_begins_without_a_trim(deactivate):
    running = steadied()
    drifting(running, 20)
    if deactivate:
        assert running.deactivate().trim == 0.0
    running.activate(20.0)
    running.feel(0.0, 20.0)
    assert running.tick(20.0).trim == 0.0


def test_without_joint_states_there_is_no_trim():
    running = control()
    running.steadying = Steadying(0.1)
    for k in range(40):
        running.feel(0.01 * math.sin(k), 10.0 + k * PERIOD)
        assert running.tick(10.0 + k * PERIOD).trim == 0.0


def test_without_the_angle_of_the_tip_there_is_no_trim():
    running = steadied()
    assert {tick.trim for tick in drifting(running, 20, psi=math.nan)} == {0.0}


class Told(Steadying):
    """Keeps what it is told of the time, and trims nothing."""

    def __init__(self):
        super().__init__()
        self.elapsed = []

    def follow(self, theta, theta_desired, x, psi, elapsed):
        self.elapsed.append(elapsed)
        return 0.0


def test_steadying_is_told_how_long_ago_the_last_reading_was():
    running = control()
    running.steadying = told = Told()
    for k in (0, 1, 3, 4):  # the second period has no reading
        running.feel(0.0, 10.0 + k * PERIOD)
        ticks_until(running, 10.0 + k * PERIOD, 10.0 + (k + (k == 1)) * PERIOD)
    assert told.elapsed == [PERIOD, PERIOD, 2.0 * PERIOD, PERIOD]
    running.notice_another_command()
    running.resume()
    running.feel(0.0, 11.0)
    running.tick(11.0)
    assert told.elapsed[-1] == PERIOD  # it begins anew


class Idle(PushLaw):
    """A law that pushes when it is told to, and notes what it is told of time."""

    def __init__(self):
        super().__init__(0.5, 0.0, 0.0)
        self.idle = True
        self.passed, self.periods_without = [], 0

    @property
    def rests(self):
        return NOTHING_TO_DO if self.idle else NO_REASON

    def pass_time(self, seconds):
        self.passed.append(seconds)

    def go_on(self):
        self.periods_without += 1


def idling(now=10.0):
    running = PushControl(Idle(), 0.005, PERIOD, Limits(contact_timeout=TIMEOUT))
    running.activate(now)
    return running


def felt_at(running, *times):
    """Feel a contact at each time and tick; return the last tick."""
    for now in times:
        running.feel(0.1, now)
        tick = running.tick(now)
    return tick


def test_a_law_with_nothing_to_do_moves_nobody_s_finger():
    running = idling()
    tick = felt_at(running, 10.0, 10.125)
    assert (tick.state, tick.stop_reason, tick.v_x) == (WAITING, NO_REASON, None)
    running.law.idle = False
    assert felt_at(running, 10.25).state == PUSHING


def test_a_law_that_is_done_rests_for_a_reason_of_its_own_until_it_has_something_to_do():
    running = idling()
    running.law.idle = False
    assert felt_at(running, 10.0, 10.125, 10.25).v_x != 0.0
    running.law.idle = True
    tick = felt_at(running, 10.375)
    assert (tick.state, tick.stop_reason, tick.v_x) == (STOPPED, NOTHING_TO_DO, 0.0)
    # Nor does it matter then that nothing is felt any more.
    assert ticks_until(running, 10.5, 11.0).stop_reason == NOTHING_TO_DO
    assert not running.resume()
    running.law.idle = False
    tick = felt_at(running, 11.125)
    assert (tick.state, tick.stop_reason, tick.phi) == (PUSHING, NO_REASON, AHEAD)


def test_a_stop_that_waits_for_somebody_comes_before_a_law_that_rests():
    running = idling()
    running.law.idle = False
    felt_at(running, 10.0)
    running.notice_another_command()
    assert running.held
    running.law.idle = True
    assert felt_at(running, 10.125).stop_reason == ANOTHER_COMMAND
    assert running.resume()
    assert felt_at(running, 10.25).stop_reason == NOTHING_TO_DO
    assert not running.held


def test_the_law_knows_the_time_between_ticks_and_which_had_no_new_contact():
    running = idling()
    running.law.idle = False
    felt_at(running, 10.0, 10.125)
    running.tick(10.25)
    running.tick(10.5, 0.25)
    assert running.law.passed == [PERIOD, PERIOD, 0.25]
    assert running.law.periods_without == 1  # the last one comes too late for the contact


def test_a_clock_that_was_set_back_is_no_time():
    running = idling()
    felt_at(running, 10.0)
    running.tick(5.0)
    assert running.law.passed == []


class Away(PushLaw):
    """A law that takes the finger off the object."""

    def __init__(self, *wanted):
        super().__init__(0.5, 2.0, 0.0)
        self.wanted = list(wanted)

    @property
    def apart(self):
        return self.away is not None

    def go_on(self):
        self.away = self.wanted.pop(0) if self.wanted else None

    def update(self, theta):
        self.go_on()
        return super().update(theta)


def away(*wanted, **limits):
    bounds = Limits(
        **{'contact_timeout': TIMEOUT, 'max_speed': 0.02, 'retreat_max': 0.01, **limits}
    )
    running = PushControl(Away(*wanted), 0.005, PERIOD, bounds)
    running.activate(0.0)
    running.feel(0.1, 0.0)
    return running


def test_a_contact_that_is_lost_on_purpose_is_no_reason_to_stop():
    running = away(*[(0.0, 0.0)] * 9)
    tick = ticks_until(running, 0.0, 8 * PERIOD)
    assert tick.silence > 2.0 * TIMEOUT
    assert (tick.state, tick.stop_reason, tick.apart) == (PUSHING, NO_REASON, True)
    # Afterwards it is one again.
    tick = running.tick(9 * PERIOD)
    assert (tick.state, tick.apart) == (PUSHING, False)
    tick = running.tick(10 * PERIOD)
    assert (tick.state, tick.stop_reason, tick.apart) == (STOPPED, CONTACT_SILENT, False)


def test_both_velocities_off_the_object_are_bounded_and_so_are_their_changes():
    running = away(*[(0.05, -0.05)] * 4, max_acceleration=0.08, retreat_max=1.0)
    ticks = [running.tick(k * PERIOD) for k in range(6)]
    found = [(tick.v_x, tick.v_y) for tick in ticks]
    # By 0.08 m/s^2 * 0.125 s at the most, up to 0.02 m/s.
    assert found[:4] == [(0.01, -0.01), *[(0.02, -0.02)] * 3]
    assert [tick.limited for tick in ticks[:4]] == [True] * 4
    assert found[4][1] == pytest.approx(-0.01)
    assert found[5][1] == 0.0
    assert not any(tick.v_y for tick in [running.tick(6 * PERIOD)])


def test_the_law_is_told_what_the_finger_gets():
    running = away((0.05, -0.05), max_acceleration=0.08)
    tick = running.tick(0.0)
    assert running.law.away == (tick.v_x, tick.v_y) == (0.01, -0.01)


@pytest.mark.parametrize('room', [0.0, 0.004])
def test_the_finger_goes_no_farther_back_than_it_may(room):
    running = away(*[(0.0, -0.02)] * 20, retreat_max=room, max_acceleration=1.0)
    ticks = [running.tick(k * PERIOD) for k in range(10)]
    gone = -sum(tick.v_y for tick in ticks) * PERIOD
    assert gone <= room
    assert room == 0.0 or gone > 0.0


def test_a_stop_off_the_object_stops_both_ways():
    running = away(*[(0.01, -0.02)] * 20)
    running.tick(0.0)
    running.notice_another_command()
    tick = running.tick(PERIOD)
    assert (tick.state, tick.stop_reason) == (STOPPED, ANOTHER_COMMAND)
    assert (tick.v_x, tick.v_y, tick.apart) == (0.0, 0.0, False)


def test_a_finger_whose_place_is_not_known_any_more_stops_off_the_object_too():
    running = away(*[(0.0, -0.001)] * 20, joint_state_timeout=TIMEOUT)
    running.locate_finger(0.0, 0.0)
    tick = ticks_until(running, 0.0, 4 * PERIOD)
    assert (tick.state, tick.v_y) == (STOPPED, 0.0)
