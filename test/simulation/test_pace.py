# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""When simulated time may go on, with wall time played by the test."""

import math
import random

import pytest

from tactile_push.simulation.pace import Pace

STEP = 0.02
PERIOD = 0.1
PATIENCE = 0.5
SLACK = 2.5 * STEP  # what two steps at the very start may be ahead


class Loop:
    """Simulated and wall time, moved on as the plant does."""

    def __init__(self, factor, start=1000.0, lag=0.0):
        self.pace = Pace(factor, PERIOD, PATIENCE, lag)
        self.wall = self.start = start
        self.steps = 0

    @property
    def time(self):
        """Simulated time [s]."""
        return self.steps * STEP

    def poll(self):
        """Try to make a step."""
        may = self.pace.may_reach(self.time + STEP, STEP, self.wall)
        if may:
            self.steps += 1
        return may

    def poll_for(self, duration, every=0.001):
        """Poll for a while of wall time; return how many steps it made."""
        before = self.steps
        end = self.wall + duration
        while self.wall < end:
            self.poll()
            self.wall += every
        return self.steps - before

    def close(self):
        """Give contact and command for the present time."""
        self.pace.reading(self.time)
        self.pace.contact(self.time)
        self.pace.command(self.time, self.time)


@pytest.mark.parametrize('factor', [0.1, 0.5, 1.0])
def test_time_alone_passes_as_fast_as_asked(factor):
    loop = Loop(factor)
    loop.poll_for(10.0)
    assert loop.time <= factor * 10.0 + SLACK
    assert loop.time >= factor * 10.0 - SLACK


def test_time_is_not_ahead_of_real_time_before_contacts_and_commands():
    loop = Loop(50.0)
    while loop.wall - loop.start < 5.0:
        loop.poll()
        assert loop.time <= loop.wall - loop.start + SLACK
        loop.wall += 0.001
    assert loop.time >= 5.0 - SLACK


@pytest.mark.parametrize('closed', ['contact', 'command'])
def test_contacts_or_commands_alone_do_not_let_it_run_ahead(closed):
    loop = Loop(50.0)
    for _ in range(3000):
        if closed == 'contact':
            loop.pace.contact(loop.time)
        else:
            loop.pace.command(loop.time, loop.time)
        loop.poll()
        loop.wall += 0.001
    assert loop.time <= 3.0 + SLACK
    assert loop.time >= 3.0 - SLACK


@pytest.mark.parametrize('factor', [0.5, 1.0, 3.0, 10.0])
def test_closed_loop_passes_as_fast_as_asked(factor):
    loop = Loop(factor)
    for _ in range(4000):
        loop.close()
        loop.poll()
        loop.wall += 0.0005
        assert loop.time <= factor * (loop.wall - loop.start) + 2.5 * STEP * max(1.0, factor)
    assert loop.time == pytest.approx(factor * 2.0, rel=0.05, abs=SLACK)


@pytest.mark.parametrize('seed', range(5))
def test_pace_holds_on_average_when_it_is_asked_irregularly(seed):
    jitter = random.Random(seed)
    loop = Loop(2.0)
    while loop.wall - loop.start < 10.0:
        loop.close()
        loop.poll()
        loop.wall += jitter.uniform(0.0, 0.009)
        assert loop.time <= 2.0 * (loop.wall - loop.start) + 2.0 * SLACK
    assert loop.time >= 0.9 * 20.0


def test_pause_of_the_machine_is_not_made_up_for_by_a_burst():
    loop = Loop(1.0)
    loop.poll_for(1.0)
    loop.wall += 60.0
    before = loop.steps
    while loop.poll():
        pass
    assert loop.steps - before <= 2


def run_to(loop, time):
    """Make steps, each as soon as the pace of the wall allows, until simulated time is there."""
    while loop.time < time - STEP / 2.0:
        loop.wall += 1.01 * STEP
        assert loop.poll(), f'held at {loop.time}'


def is_held(loop):
    """Tell whether time stands still although the pace of the wall would allow a step."""
    loop.wall += 1.01 * STEP
    return not loop.poll()


def test_time_reaches_the_moment_of_the_due_command_but_does_not_pass_it():
    loop = Loop(1.0)
    run_to(loop, 1.0)
    loop.pace.command(1.0, 1.0)
    run_to(loop, 1.0 + PERIOD)
    for _ in range(10):
        assert is_held(loop)
    loop.pace.command(1.0 + PERIOD, loop.time)
    run_to(loop, 1.0 + 2.0 * PERIOD)
    assert is_held(loop)


def test_first_command_is_not_waited_for():
    loop = Loop(1.0)
    loop.pace.reading(0.0)
    loop.pace.contact(0.0)
    assert not loop.pace.commanded
    run_to(loop, 5.0)


def test_time_does_not_go_on_before_the_last_reading_has_become_a_contact():
    loop = Loop(1.0)
    run_to(loop, 1.0)
    loop.pace.contact(1.0)
    loop.pace.reading(1.0)
    run_to(loop, 1.02)
    loop.pace.reading(1.02)
    assert is_held(loop)
    loop.pace.contact(1.0)  # that of the reading before
    assert is_held(loop)
    loop.pace.contact(1.02)
    run_to(loop, 1.04)
    run_to(loop, 1.06)  # without another reading there is nothing to wait for


def test_contact_as_new_as_the_last_reading_is_enough_however_old_that_is():
    loop = Loop(1.0)
    run_to(loop, 1.0)
    loop.pace.reading(0.5)
    loop.pace.contact(0.5)
    loop.pace.command(1.0, 1.0)
    run_to(loop, 1.1)


def test_without_a_contact_yet_none_is_waited_for():
    loop = Loop(1.0)
    run_to(loop, 1.0)
    loop.pace.reading(1.0)
    loop.pace.command(1.0, 1.0)
    run_to(loop, 1.1)


def wait_in_vain(loop):
    """Poll until time goes on, and return how long it stood still [s of wall time]."""
    start = loop.wall
    while not loop.poll():
        loop.wall += 0.001
        assert loop.wall - start < 10.0 * PATIENCE
    return loop.wall - start


def test_missing_command_is_given_up_after_a_while_until_it_comes_again():
    loop = Loop(1.0)
    run_to(loop, 1.0)
    loop.pace.command(1.0, 1.0)
    assert loop.pace.commanded
    run_to(loop, 1.1)
    loop.wall += 1.01 * STEP
    assert wait_in_vain(loop) == pytest.approx(PATIENCE, abs=0.005)
    assert not loop.pace.commanded
    run_to(loop, 2.0)  # nobody waits any more
    loop.pace.command(2.0, 2.0)
    assert loop.pace.commanded
    run_to(loop, 2.1)
    assert is_held(loop)


def test_missing_contact_is_given_up_after_a_while_until_it_comes_again():
    loop = Loop(1.0)
    run_to(loop, 1.0)
    loop.pace.contact(1.0)
    loop.pace.command(1.0, 1.0)
    run_to(loop, 1.04)
    loop.pace.reading(1.04)
    loop.wall += 1.01 * STEP
    assert wait_in_vain(loop) == pytest.approx(PATIENCE, abs=0.005)
    assert loop.time == pytest.approx(1.06)
    assert loop.pace.commanded  # the command is another matter
    for _ in range(20):  # readings go on, commands too, and contacts stay away
        loop.pace.command(loop.time, loop.time)
        loop.pace.reading(loop.time)
        run_to(loop, loop.time + STEP)
    loop.pace.contact(loop.time)
    loop.pace.reading(loop.time)
    run_to(loop, loop.time + STEP)
    loop.pace.reading(loop.time)
    assert is_held(loop)


def test_patience_starts_anew_with_every_wait():
    loop = Loop(1.0)
    run_to(loop, 1.0)
    for tick in range(4):
        loop.pace.command(1.0 + tick * PERIOD, loop.time)
        run_to(loop, 1.0 + (tick + 1) * PERIOD)
        start = loop.wall
        while loop.wall - start < 0.8 * PATIENCE:
            assert is_held(loop)


def test_plant_that_stood_still_itself_waits_on_for_what_it_has_not_read_yet():
    loop = Loop(1.0)
    run_to(loop, 1.0)
    loop.pace.command(1.0, loop.time)
    run_to(loop, 1.0 + PERIOD)
    assert is_held(loop)
    loop.wall += 10.0 * PATIENCE
    assert is_held(loop)
    loop.pace.command(1.0 + PERIOD, loop.time)
    assert loop.pace.commanded
    run_to(loop, 1.0 + 2.0 * PERIOD)


def test_after_it_gave_up_time_is_not_ahead_of_real_time():
    loop = Loop(50.0)
    loop.close()
    loop.poll_for(2.0 * PATIENCE)
    assert not loop.pace.commanded
    before, start = loop.time, loop.wall
    loop.poll_for(2.0)
    assert loop.time - before <= loop.wall - start + SLACK


@pytest.mark.parametrize('stamp', [0.5, 1.7e9, 5.1, -3.0])
def test_stamp_of_another_clock_is_taken_for_now(stamp):
    loop = Loop(1.0)
    run_to(loop, 5.0)
    loop.pace.command(stamp, 5.0)
    run_to(loop, 5.0 + PERIOD)
    assert is_held(loop)


def test_stamp_of_the_last_tick_counts_rather_than_the_time_of_arrival():
    loop = Loop(1.0)
    run_to(loop, 5.06)
    loop.pace.command(5.0, 5.06)
    run_to(loop, 5.1)
    assert is_held(loop)


def test_loop_on_a_loaded_machine_is_slower_and_the_same():
    """Deliver contacts and commands late by turns; time waits for each of them."""
    delay = random.Random(1)
    loop = Loop(10.0)
    loop.close()
    due = PERIOD
    contact = loop.time
    while loop.time < 5.0:
        may = loop.poll()
        if may:
            assert contact >= loop.time - 1.5 * STEP
            assert loop.time <= due + 1e-9
            loop.pace.reading(loop.time)
        elif contact < loop.time - STEP / 2.0:
            loop.wall += delay.uniform(0.0, 0.8 * PATIENCE)
            contact = loop.time
            loop.pace.contact(contact)
        elif loop.time > due - STEP / 2.0:
            loop.wall += delay.uniform(0.0, 0.8 * PATIENCE)
            loop.pace.command(due, loop.time)
            due += PERIOD
        loop.wall += 0.001
    assert due == pytest.approx(5.0)
    assert loop.wall - loop.start > 2.0 * 5.0 / 10.0


def test_time_does_not_wait_for_the_contact_of_a_reading_it_was_not_told_of():
    # As of a reading that is lost, tells of no contact or is an outlier.
    loop = Loop(10.0)
    loop.close()
    for k in range(500):
        if k % 10:
            loop.close()
        else:
            loop.pace.command(loop.time, loop.time)
        before = loop.wall
        while not loop.poll():
            loop.wall += 0.0005
        assert loop.wall - before <= 1.01 * STEP / 10.0 + 0.001
        assert not loop.pace.contact_overdue


def test_pace_tells_whether_a_contact_is_overdue():
    loop = Loop(1.0)
    loop.close()
    assert loop.poll()
    loop.pace.reading(loop.time)
    loop.wall += STEP
    assert not loop.poll()
    assert loop.pace.contact_overdue
    loop.pace.contact(loop.time)
    assert loop.poll()
    assert not loop.pace.contact_overdue


def test_time_waits_for_a_contact_that_is_no_older_than_the_lag():
    loop = Loop(100.0, lag=0.05)
    loop.close()
    for _ in range(20):
        while not loop.poll():
            loop.wall += 0.001
        loop.pace.reading(loop.time)
        loop.pace.command(loop.time, loop.time)
        loop.pace.contact(loop.time - 0.05 - STEP)  # older than the lag
        assert loop.poll_for(0.1) == 0
        loop.pace.contact(loop.time - 0.05)
        assert loop.poll_for(0.001) == 1
        loop.pace.reading(loop.time)
        loop.pace.contact(loop.time - 0.05)
        loop.pace.command(loop.time, loop.time)


def test_time_waits_for_the_servo_s_answer_to_joint_states_and_command():
    loop = Loop(10.0)
    loop.close()
    loop.pace.answer(loop.time, loop.time)
    loop.poll_for(0.1)
    stands = loop.time
    assert loop.poll_for(0.05) == 0
    loop.close()
    assert loop.poll_for(0.05) == 0  # contact and command are there, the answer is not
    loop.pace.answer(stands, 0.0)
    assert loop.poll_for(0.05) == 0  # it has not had the command
    loop.pace.answer(stands, stands)
    assert loop.poll_for(0.1) > 0


def test_time_does_not_wait_for_a_servo_that_has_gone_or_never_was():
    loop = Loop(10.0)
    for answered in (False, True):
        if answered:
            loop.pace.answer(loop.time, loop.time)
        before = loop.time
        while loop.time < before + 1.0:
            loop.close()
            loop.poll()
            loop.wall += 0.001
    assert loop.wall - loop.start < 2.0 / 10.0 + PATIENCE + 0.4


def test_time_stops_at_the_moment_of_a_release_until_it_is_said():
    loop = Loop(1.0)
    run_to(loop, 1.0)
    pace = loop.pace
    pace.command(1.0, 1.0)
    pace.decision(1.0, 0.033)
    assert pace.stop_before(1.0, 1.02) == 1.02
    run_to(loop, 1.02)
    moment = pace.stop_before(1.02, 1.04)
    # No earlier, as a clock that is a nanosecond short wakes nobody.
    assert 1.033 < moment < 1.033 + 1e-5
    loop.wall += 1.01 * STEP
    assert pace.may_reach(moment, STEP, loop.wall)
    assert pace.stop_before(moment, 1.04) == 1.04
    assert is_held(loop)
    assert is_held(loop)
    pace.released()
    run_to(loop, 1.0 + PERIOD)


def test_time_that_has_passed_a_release_stands_until_it_is_said():
    loop = Loop(1.0)
    run_to(loop, 1.04)
    loop.pace.command(1.0, 1.04)
    loop.pace.decision(1.0, 0.033)
    assert loop.pace.stop_before(1.04, 1.06) == 1.06
    assert is_held(loop)
    loop.pace.released()
    run_to(loop, 1.06)


def test_a_command_does_not_count_before_what_its_period_decided():
    loop = Loop(1.0)
    run_to(loop, 1.0)
    loop.pace.decision(1.0, math.nan)
    loop.pace.command(1.0, 1.0)
    run_to(loop, 1.0 + PERIOD)
    loop.pace.command(1.0 + PERIOD, loop.time)
    assert is_held(loop)
    loop.pace.decision(1.0 + PERIOD, math.nan)
    run_to(loop, 1.0 + 2.0 * PERIOD)


@pytest.mark.parametrize('let_go_in', [math.nan, 0.033])
def test_time_does_not_wait_for_decisions_of_a_controller_that_has_gone(let_go_in):
    loop = Loop(10.0)
    loop.close()
    loop.pace.decision(0.0, let_go_in)
    loop.poll_for(2.0 * PATIENCE + 0.5)
    before, start = loop.time, loop.wall
    while loop.time < before + 1.0:
        loop.close()
        loop.poll()
        loop.wall += 0.001
    assert loop.wall - start < 1.0 / 10.0 + PATIENCE + 0.2
