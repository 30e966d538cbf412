# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What becomes of a goal: served, preempted, refused, given up, and when the object is let go."""

import copy
import math
from itertools import groupby

import pytest

from support.placed_run import Line
from tactile_push.control import (
    CONTACT_SILENT,
    FINGER_UNKNOWN,
    NO_REASON,
    NOTHING_TO_DO,
    PUSHING,
    WAITING,
)
from tactile_push.control.placing import REFUSALS, STAGES, VERDICTS
from tactile_push.control.placing.stages import (
    AWAITING_CONTACT,
    CANCELLED,
    CONTRADICTED,
    FACES_AWAY,
    HELD_STILL,
    LEARNING,
    LETTING_GO,
    LIFTED,
    MISSED,
    NO_EDGE,
    NO_GOAL,
    NOT_FINITE,
    NOTHING_KNOWN,
    OBJECT_LOST,
    OTHER_FRAME,
    OTHER_ROTATION,
    OUTSIDE_WORKSPACE,
    PLACING,
    REGRASPING,
    RELEASED,
)
from tactile_push.estimation.contradictions import BLIND, CONTRADICTIONS, JUMPED
from tactile_push.interface import COMMAND, PLACE_RELEASE, PLACE_STATE, SENSING_STATE, TOPICS
from tactile_push.pipeline.belief import FRICTION, NEEDED

GOAL, SECOND = (-0.02, -0.1), (-0.012, 0.05)
STRAIGHT = (0.0, 0.0, 0.0, 1.0)
PERIOD = 0.1


def stage_of(values):
    return STAGES[int(values['stage'])]


def stages(line):
    """Return the stages in their order, each once in a row."""
    return [stage for stage, _ in groupby(map(stage_of, line.states))]


def said(line, topic):
    """Return the messages of a topic."""
    return [fields for name, _, fields in line.heard if name == topic]


@pytest.fixture(scope='module')
def placed():
    """Return a line on which two objects were placed, the second goal given right after the first.

    Nobody may change it.
    """
    line = Line()
    for _ in range(3):
        line.period()
    line.ask(*GOAL)
    line.until(lambda: line.placing.released == 1)
    line.ask(*SECOND)
    line.until(lambda: line.placing.released == 2)
    line.period()
    return line


@pytest.fixture(scope='module')
def ending():
    """Return what makes lines whose object is let go in the next period."""
    line = Line()
    line.ask(*GOAL)
    while line.placing.released == 0:
        before = copy.deepcopy(line) if line.states and line.states[-1]['way_left'] < 2e-3 else None
        line.period()
        line.placing.reach.pause()
    return lambda: copy.deepcopy(before)


def serving(periods=15, goal=GOAL, **how):
    """Return a line that has pushed to a goal for a while."""
    line = Line(**how)
    line.ask(*goal)
    for _ in range(periods):
        line.period()
    assert line.placing.stage in (LEARNING, PLACING)
    return line


def stands(line, stage, periods=8):
    """Return whether a goal has ended so, the finger stands still and nothing is let go."""
    ticks = [line.period() for _ in range(periods)]
    still = {tick.v_x for tick in ticks} == {0.0}
    return line.placing.stage == stage and still and not line.placed


def test_before_the_first_goal_the_finger_is_nobody_s(placed):
    before = placed.ticks[:3]
    assert [(tick.state, tick.v_x) for tick in before] == [(WAITING, None)] * 3
    assert [stage_of(values) for values in placed.states[:3]] == [NO_GOAL] * 3


def test_objects_are_placed_one_after_the_other(placed):
    for (x, theta), goal in zip(placed.placed, (GOAL, SECOND), strict=True):
        assert x == pytest.approx(goal[0], abs=1e-3)
        assert theta == pytest.approx(goal[1], abs=math.radians(1.0))


def test_a_goal_goes_through_its_stages(placed):
    one = [LEARNING, PLACING, LETTING_GO]
    # The second goal comes before the period after the release, so that it finds the finger up.
    assert stages(placed) == [NO_GOAL, *one, LIFTED, AWAITING_CONTACT, *one, RELEASED]


def test_the_word_to_let_go_and_to_be_down_again(placed):
    assert [fields['data'] for fields in said(placed, PLACE_RELEASE)] == [False, True, False, True]


def test_the_moment_is_told_in_its_period(placed):
    told = [values['let_go_in'] for values in placed.states if stage_of(values) == LETTING_GO]
    assert len(told) == 2
    assert all(0.0 <= moment < PERIOD for moment in told)
    others = [v['let_go_in'] for v in placed.states if stage_of(v) != LETTING_GO]
    assert all(map(math.isnan, others))


def test_the_finger_is_put_down_when_the_old_object_is_forgotten(placed):
    down = next(k for k, v in enumerate(placed.states) if stage_of(v) == AWAITING_CONTACT)
    assert placed.ticks[down].silence > placed.control.push.limits.contact_timeout
    assert placed.ticks[down].v_x == 0.0
    heard = [fields for topic, _, fields in placed.heard if topic == SENSING_STATE][:down]
    values = dict(zip(heard[-1]['name'], heard[-1]['position'], strict=True))
    assert values['readings'] == 0.0


def test_after_letting_go_the_finger_rests_for_a_reason_of_its_own(placed):
    last = placed.ticks[-1]
    assert (last.v_x, last.stop_reason) == (0.0, NOTHING_TO_DO)


def test_numbers_stand_under_the_names_of_the_interface(placed):
    for fields in said(placed, PLACE_STATE):
        assert tuple(fields['name']) == TOPICS[PLACE_STATE].field_names


def test_what_is_told_of_the_object_is_near_the_truth_at_the_end(placed):
    end = [values for values in placed.states if stage_of(values) == LETTING_GO][-1]
    x, theta = placed.placed[-1]
    # Until it is let go it moves by a millimetre at the most.
    assert end['x'] - placed.home == pytest.approx(x, abs=1.5e-3)
    assert end['theta'] == pytest.approx(theta, abs=math.radians(2.0))
    assert abs(end['x_miss']) < 1e-3
    assert end['way_left'] <= 0.005 * PERIOD
    assert end['goal_theta'] == pytest.approx(SECOND[1])
    assert end['belt_left'] < 0.3


def test_the_estimate_of_a_period_is_used_in_the_next(placed):
    acting = [v for v in placed.states if stage_of(v) in (LEARNING, PLACING)]
    assert [v['estimate_age'] for v in acting[1:-1]] == pytest.approx([PERIOD] * (len(acting) - 2))


def test_whether_the_goal_can_be_reached_is_told(placed):
    verdicts = [VERDICTS[int(v['reachable'])] for v in placed.states]
    assert verdicts[0] == 'unknown'
    last = next(k for k, v in enumerate(placed.states) if stage_of(v) == LETTING_GO)
    assert verdicts[last] == 'with reserve'


@pytest.mark.slow
def test_late_estimates_of_old_readings_serve_as_well():
    line = Line(late=2, age=0.04)
    line.ask(*GOAL)
    line.until(lambda: line.placing.released)
    ((x, theta),) = line.placed
    assert x == pytest.approx(GOAL[0], abs=1.5e-3)
    assert theta == pytest.approx(GOAL[1], abs=math.radians(1.5))
    ages = [v['estimate_age'] for v in line.states if stage_of(v) == PLACING]
    assert ages == pytest.approx([3.0 * PERIOD] * len(ages))


def test_a_goal_that_is_given_up_leaves_the_finger_still():
    line = serving()
    assert line.placing.cancel()
    assert stands(line, CANCELLED)
    assert not line.placing.cancel()


def test_a_new_goal_takes_the_place_of_the_old_one():
    line = serving()
    before = line.states[-1]['belt_left']
    assert line.ask(*SECOND) == ''
    tick = line.period()
    assert (tick.state, tick.stop_reason) == (PUSHING, NO_REASON)
    after = line.states[-1]
    assert (after['goals'], after['goal_theta']) == (2.0, pytest.approx(SECOND[1]))
    assert before < after['belt_left'] == pytest.approx(0.3)


@pytest.mark.parametrize(
    ('frame', 'x', 'rotation', 'refusal'),
    [
        ('map', 0.0, STRAIGHT, OTHER_FRAME),
        ('finger_disk', 0.0, STRAIGHT, OTHER_FRAME),
        ('finger_base', math.nan, STRAIGHT, NOT_FINITE),
        ('', math.inf, STRAIGHT, NOT_FINITE),
        ('', 0.0, (0.0, 0.0, math.nan, 1.0), NOT_FINITE),
        ('', 0.0, (0.5, 0.5, 0.5, 0.5), OTHER_ROTATION),
        ('', 0.0, (0.0, 0.0, 0.0, 0.0), OTHER_ROTATION),
        ('', 0.0, (0.0, 0.0, math.sin(0.8), math.cos(0.8)), FACES_AWAY),
        ('', 0.0, (0.0, 0.0, 1.0, 0.0), FACES_AWAY),
        ('', 0.5, STRAIGHT, OUTSIDE_WORKSPACE),
        ('', 1e308, STRAIGHT, OUTSIDE_WORKSPACE),
    ],
)
def test_a_goal_that_is_none_is_refused_and_the_finger_goes_on(frame, x, rotation, refusal):
    line = Line()
    assert line.placing.goal(frame, x, rotation) == refusal
    assert line.period().v_x is None
    assert line.placing.stage == NO_GOAL
    told = line.states[-1]
    assert (told['goals'], told['refused']) == (0.0, 1.0)
    assert REFUSALS[int(told['refusal'])] == refusal
    assert line.ask(*GOAL, frame='left/finger_base') == ''
    line.period()
    assert line.placing.goal(frame, x, rotation) == refusal
    line.period()
    assert (line.ticks[-1].state, line.states[-1]['goals']) == (PUSHING, 1.0)


@pytest.mark.parametrize(
    ('theta', 'most'),
    [
        # With the contact at an end of the edge the centre of mass is half an edge beside it.
        (0.0, 0.105 + 0.025),
        (0.3, 0.105 + 0.025 * math.cos(0.3) - (0.02375 + 0.0135) * math.sin(0.3)),
    ],
)
def test_where_the_finger_has_to_be_depends_on_the_edge(theta, most):
    line = serving(2)
    rotation = (0.0, 0.0, math.sin(theta / 2.0), math.cos(theta / 2.0))
    assert line.placing.goal('', most - 1e-3, rotation) == ''
    assert line.placing.goal('', most + 1e-3, rotation) == OUTSIDE_WORKSPACE
    assert line.placing.goal('', -most + 2e-3 if not theta else 0.0, rotation) == ''


def test_a_goal_is_refused_while_the_finger_waits_for_somebody():
    line = serving(3)
    line.control.push.notice_another_command()
    assert line.ask(*SECOND) == HELD_STILL
    assert stands(line, LEARNING, 3)
    line.control.push.resume()
    line.period()
    assert line.ticks[-1].state == PUSHING


def test_a_round_object_has_no_edge_to_place():
    line = Line()
    line.senses = False
    stamp = line.stamp
    line.period()
    line.placing.sensed(stamp, ['edge', 'readings'], [math.nan, 0.0])
    assert line.ask(*GOAL) == NO_EDGE


def test_an_object_that_is_lost_on_the_way_ends_the_goal():
    line = serving()
    line.feels = False
    line.until(lambda: line.ticks[-1].stop_reason == CONTACT_SILENT, 5)
    assert line.ticks[-1].v_x == 0.0
    assert stands(line, OBJECT_LOST)
    line.feels = True
    assert stands(line, OBJECT_LOST)
    # The next goal is served as the first one was.
    line.ask(*SECOND)
    line.period()
    assert line.placing.stage == LEARNING
    assert line.ticks[-1].state == PUSHING


def contradicted(line, reason):
    """Let the newest estimate of a line, which is on its way, contradict the object."""
    ((_, message), *_) = line._under_way[-1]
    message['position'][message['name'].index('contradiction')] = float(
        CONTRADICTIONS.index(reason)
    )


def test_readings_that_contradict_the_object_end_the_goal_at_once():
    line = serving()
    contradicted(line, JUMPED)
    assert line.period().v_x == 0.0
    assert stands(line, CONTRADICTED)


def test_an_old_contradiction_is_none_of_the_next_object():
    line = serving()
    contradicted(line, JUMPED)
    line.senses = False
    assert stands(line, CONTRADICTED)
    line.ask(*SECOND)
    line.senses = True
    line.period()
    line.period()
    assert line.placing.stage == LEARNING


def test_a_tip_that_is_not_known_for_a_moment_is_no_contradiction():
    line = serving()
    contradicted(line, BLIND)
    line.period()
    assert line.placing.stage in (LEARNING, PLACING)


def test_whatever_the_estimate_says_the_command_is_finite_and_bounded():
    line = serving()
    for name in (*NEEDED, *FRICTION, 'age', 'readings', 'contradiction', 'edge'):
        for value in (1.8e308, -1.8e308, -1.0, 0.0, 5e-324, 900.0, math.inf, math.nan):
            if line.placing.stage not in (LEARNING, PLACING):
                line.ask(*GOAL)
            ((_, message), *_) = line._under_way[-1]
            message['position'][message['name'].index(name)] = value
            tick = line.period()
            assert abs(tick.v_x) <= 0.02, (name, value)  # `max_speed`
    assert line.placing.released == 0


@pytest.mark.parametrize('stamp', [(2**31 - 1, 0), (0, 0), (-1, 0)])
def test_an_estimate_of_no_control_period_is_none(stamp):
    line = serving(5)
    line.placing.sensed(stamp, ['contradiction'], [2.0])
    for _ in range(8):
        line.period()
    assert line.placing.stage in (LEARNING, PLACING)
    assert line.states[-1]['estimate_age'] == pytest.approx(PERIOD)


def test_without_estimates_the_law_does_for_half_a_second_and_then_stops():
    line = serving()
    line.senses = False
    line._under_way.clear()
    ticks = [line.period() for _ in range(5)]
    assert {tick.state for tick in ticks} == {PUSHING}
    assert line.period().v_x == 0.0
    assert stands(line, NOTHING_KNOWN)


def test_without_a_first_estimate_it_stops_too():
    line = Line()
    line.senses = False
    line.ask(*GOAL)
    ticks = [line.period() for _ in range(7)]
    assert {tick.v_x for tick in ticks} == {0.0}
    assert stands(line, NOTHING_KNOWN)


def test_without_the_finger_s_place_nothing_is_let_go():
    line = serving()
    line.control.push.locate_finger = lambda *where: None
    line.until(lambda: line.ticks[-1].stop_reason == FINGER_UNKNOWN, 6)
    assert line.period().v_x == 0.0
    assert not line.placed


def test_a_belt_that_is_used_up_ends_the_goal_without_letting_go():
    line = Line(belt_length=0.01)
    line.ask(0.08, 0.5)
    line.until(lambda: line.placing.stage == MISSED, 25)
    line.period()
    assert stands(line, MISSED)


def test_at_the_moment_it_is_let_go(ending):
    line = ending()
    line.period()
    assert line.placing.released == 1
    line.period()
    assert line.placing.stage == RELEASED
    assert not line.placing.cancel()


@pytest.mark.parametrize(
    ('happens', 'stage'),
    [
        (lambda line: line.placing.cancel(), CANCELLED),
        (lambda line: line.placing.goal('', 0.0, STRAIGHT), PLACING),
        (lambda line: line.control.push.notice_another_command(), PLACING),
        (lambda line: line.control.push.notice_clock_jump(0.0), PLACING),
        (
            lambda line: line.placing.sensed(line.stamp, ['contradiction'], [2.0]),
            CONTRADICTED,
        ),
    ],
    ids=['cancelled', 'preempted', 'another command', 'clock jumped', 'contradiction'],
)
def test_what_comes_before_the_moment_keeps_the_object(ending, happens, stage):
    line = ending()
    line.before_release = happens
    line.period()
    assert line.placing.released == 0
    line.period()
    assert line.placing.stage == stage
    assert not line.placed


def test_a_goal_that_waits_for_the_lifted_finger_can_be_given_up(ending):
    line = ending()
    line.period()
    line.ask(*SECOND)
    line.period()
    assert line.placing.stage == LIFTED
    assert line.placing.cancel()
    for _ in range(6):
        line.period()
    assert line.placing.stage == CANCELLED
    assert [fields['data'] for fields in said(line, PLACE_RELEASE)] == [False, True]


def test_a_deactivated_law_gives_the_goal_up():
    line = serving()
    line.deactivate()
    assert stage_of(line.states[-1]) == CANCELLED


ACROSS = (0.015, 0.35)  # which no push from a contact so far to the right reaches


@pytest.fixture(scope='module')
def regrasped():
    """Return a line with a finger of two axes that has placed two objects, and a copy of it.

    The copy is of when the finger was on its way to the second contact. Nobody may change them.
    """
    line = Line(theta=0.35, d=0.012, axes=2)
    line.ask(*ACROSS)
    line.until(lambda: line.placing.stage == REGRASPING and line.ticks[-1].v_x < -0.01)
    away = copy.deepcopy(line)
    line.until(lambda: line.placing.released == 1)
    line.ask(*ACROSS)
    line.until(lambda: stages(line)[-1] == LEARNING)
    return line, away


def test_what_no_push_reaches_is_placed_from_another_contact(regrasped):
    line, _ = regrasped
    ((x, theta),) = line.placed
    assert x == pytest.approx(ACROSS[0], abs=1e-3)
    assert theta == pytest.approx(ACROSS[1], abs=math.radians(1.0))
    expected = [LEARNING, PLACING, REGRASPING, PLACING]
    assert [stage for stage in stages(line) if stage in expected][:4] == expected


def test_a_contact_that_is_lost_on_purpose_stops_nothing_and_nothing_is_forgotten(regrasped):
    line, _ = regrasped
    told = [dict(zip(m['name'], m['position'], strict=True)) for m in said(line, SENSING_STATE)]
    for tick, state, sensed in zip(line.ticks, line.states, told, strict=False):
        assert tick.apart == (stage_of(state) == REGRASPING)
        if tick.apart:
            assert (tick.state, tick.stop_reason) == (PUSHING, NO_REASON)
            assert sensed['readings'] > 20.0
    silence = max(tick.silence for tick in line.ticks if tick.apart)
    assert silence > 2.0 * line.control.push.limits.contact_timeout
    moves = {(tick.v_x != 0.0, tick.v_y != 0.0) for tick in line.ticks if tick.apart}
    assert {(False, True), (True, False), (False, False)} <= moves
    commands = [fields['twist']['linear']['y'] for fields in said(line, COMMAND)]
    assert min(commands) == -line.control.push.limits.max_speed


def test_once_it_has_let_go_the_finger_goes_back_to_its_line_before_it_is_put_down(regrasped):
    line, _ = regrasped
    placed = next(k for k, state in enumerate(line.states) if stage_of(state) == LIFTED)
    after = [tick.v_y for tick in line.ticks[placed:]]
    assert min(after) == 0.0
    back = -sum(tick.v_y for tick in line.ticks[:placed]) * PERIOD
    assert sum(after) * PERIOD == pytest.approx(back, abs=2e-4)
    assert back > 0.002
    down = next(
        k
        for k, state in enumerate(line.states)
        if stage_of(state) == AWAITING_CONTACT and k > placed
    )
    assert not any(tick.v_y for tick in line.ticks[down:])
    assert not any(tick.apart for tick in line.ticks[placed:])


def test_a_goal_that_is_given_up_off_the_object_leaves_the_finger_still(regrasped):
    away = copy.deepcopy(regrasped[1])
    assert away.placing.cancel()
    assert stands(away, CANCELLED)
    assert not any(tick.v_y or tick.apart for tick in away.ticks[-8:])


def test_an_object_that_does_not_come_to_the_finger_is_lost(regrasped):
    away = copy.deepcopy(regrasped[1])
    away.feels = False
    away.until(lambda: away.placing.stage != REGRASPING, 100)
    assert stands(away, OBJECT_LOST)
    assert away.ticks[-1].stop_reason == NOTHING_TO_DO


def test_joint_states_that_stop_off_the_object_stop_the_finger_which_goes_no_further(regrasped):
    away = copy.deepcopy(regrasped[1])
    away.joints_tell = False
    away.until(lambda: away.ticks[-1].stop_reason == FINGER_UNKNOWN, 5)
    assert (away.ticks[-1].v_x, away.ticks[-1].v_y) == (0.0, 0.0)
    away.joints_tell = True
    assert stands(away, OBJECT_LOST)


def test_a_new_goal_off_the_object_is_gone_for_from_the_second_contact(regrasped):
    away = copy.deepcopy(regrasped[1])
    assert away.ask(0.005, 0.3) == ''
    assert away.placing.stage == REGRASPING
    away.until(lambda: away.placing.stage == PLACING, 100)
    assert not any(tick.stop_reason for tick in away.ticks[-20:])
