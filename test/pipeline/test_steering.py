# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The law that steers by the steps of the nodes: goals, estimates, and what it does without."""

import math

import pytest

from support.placed_run import Line
from tactile_push import paper
from tactile_push.control import CONTACT_SILENT, PUSHING, STOPPED, slow_mode
from tactile_push.control.law import push_angle
from tactile_push.control.placing import STAGES
from tactile_push.control.placing.stages import (
    HELD_STILL,
    NOT_FINITE,
    OTHER_FRAME,
    OUTSIDE_WORKSPACE,
    STEERING,
    STEERING_BLINDLY,
)
from tactile_push.interface import PLACE_RELEASE, PLACE_STATE, TOPICS
from tactile_push.pipeline.believing import OLDEST

ANY = (0.0, 0.0, 0.0, 1.0)
LIMITS = math.radians(33.0), math.radians(147.0)
DOUBT = 'nothing is known of the object, so law (18) acts'


def line_at(theta=0.1, d=-0.003, **more):
    return Line(theta, d, law='steer', **more)


def periods(line, count):
    for _ in range(count):
        line.period()
    return line


def is_law_18(before, tick, aim):
    """Whether a tick follows from the one before by law (18) with the paper's gains."""
    gains = paper.KP, paper.KD
    return tick.phi == push_angle(before.phi, tick.theta, before.theta, *gains, aim, *LIMITS)


def stage_of(values):
    return STAGES[int(values['stage'])]


def test_without_a_goal_law_18_acts_as_it_is():
    line = periods(line_at(), 12)
    assert {tick.trim for tick in line.ticks} == {0.0}
    for before, tick in zip(line.ticks[1:], line.ticks[2:], strict=False):
        assert is_law_18(before, tick, paper.THETA_DESIRED)
    assert math.isnan(line.states[-1]['goal_x'])
    assert line.placing.doubt == ''


def test_a_goal_is_steered_to_whatever_the_yaw_is_and_nothing_is_let_go():
    line = periods(line_at(), 3)
    assert line.placing.goal('left/finger_base', line.home + 0.003, (math.nan,) * 4) == ''
    periods(line, 250)
    assert line.centre - line.home == pytest.approx(0.003, abs=2e-3)
    assert stage_of(line.states[-1]) == STEERING
    assert tuple(line.states[-1]) == TOPICS[PLACE_STATE].field_names
    assert line.states[-1]['goal_x'] == pytest.approx(line.home + 0.003)
    assert line.states[-1]['x'] == pytest.approx(line.centre, abs=1e-3)
    assert PLACE_RELEASE not in {topic for topic, _, _ in line.heard}


def test_an_object_that_is_steered_drifts_wherever_its_goal_is_not(monkeypatch):
    monkeypatch.setattr(slow_mode, 'AVERAGED', 0.5)
    line = line_at(0.1, 0.003)  # which drifts to the left
    line.ask(-0.03, 0.0)
    periods(line, 12)
    on_its_way = line.control.outlook
    assert on_its_way.drift < -5e-4
    assert (on_its_way.lasts, on_its_way.e_fold) == (math.inf, math.inf)
    line.ask(0.05, 0.0)
    line.period()
    away = line.control.outlook
    way = line.ticks[-1].finger_x - line.control.push.limits.workspace_min
    assert away.lasts == pytest.approx(way / -away.drift)
    assert line.placing.cancel()
    line.period()  # law (18) acts, and theta is not where it is to be
    assert math.isnan(line.control.outlook.drift)


@pytest.mark.parametrize(
    ('frame', 'x', 'refusal'),
    [
        ('finger_disk', 0.0, OTHER_FRAME),
        ('finger_base', math.nan, NOT_FINITE),
        ('finger_base', math.inf, NOT_FINITE),
        ('finger_base', 0.106, OUTSIDE_WORKSPACE),
        ('finger_base', -0.106, OUTSIDE_WORKSPACE),
    ],
)
def test_a_place_that_makes_no_sense_is_refused_and_the_last_one_stays(frame, x, refusal):
    line = line_at()
    line.placing.goal('', 0.03, ANY)
    assert line.placing.goal(frame, x, ANY) == refusal
    assert line.control.push.law.goal == line.control.push.steadying.goal == 0.03


def test_while_the_finger_is_held_still_places_are_refused():
    line = periods(line_at(), 3)
    line.control.push.notice_another_command()
    assert line.placing.goal('', 0.0, ANY) == HELD_STILL


def test_a_cancelled_goal_leaves_law_18_as_it_is():
    line = line_at()
    assert not line.placing.cancel()
    line.ask(0.02, 0.0)
    periods(line, 10)
    assert line.placing.cancel()
    periods(line, 2)
    assert [tick.trim for tick in line.ticks[-2:]] == [0.0, 0.0]
    assert is_law_18(*line.ticks[-2:], paper.THETA_DESIRED)


def test_without_estimates_the_edge_alone_is_steered_by_and_that_is_told():
    line = line_at()
    line.ask(0.01, 0.0)
    periods(line, 12)
    line.senses = False
    periods(line, OLDEST + 1)
    assert stage_of(line.states[-1]) == STEERING
    periods(line, 15)
    assert stage_of(line.states[-1]) == STEERING_BLINDLY
    assert line.placing.doubt == DOUBT
    aim = paper.THETA_DESIRED + line.ticks[-1].trim
    assert is_law_18(*line.ticks[-2:], aim)
    # It begins where theta is, and not where an earlier trim would be.
    assert aim == pytest.approx(line.rig.theta, abs=math.radians(8.0))
    line.senses = True
    line.until(lambda: stage_of(line.states[-1]) == STEERING, 3)


def test_what_stops_the_finger_keeps_the_goal():
    line = line_at()
    line.ask(0.02, 0.0)
    periods(line, 10)
    line.feels = False
    line.until(lambda: line.ticks[-1].state == STOPPED, 10)
    assert (line.ticks[-1].stop_reason, line.ticks[-1].v_x) == (CONTACT_SILENT, 0.0)
    line.feels = True
    line.until(lambda: line.ticks[-1].state == PUSHING, 3)
    assert line.control.push.law.goal == pytest.approx(line.home + 0.02)
