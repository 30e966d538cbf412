# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The law that settles by the steps of the nodes: goals, estimates, and what it does without."""

import math

import numpy as np
import pytest

from support.placed_run import Line
from tactile_push import paper
from tactile_push.control import NO_REASON, PUSHING, slow_mode
from tactile_push.control.law import push_angle
from tactile_push.control.placing import STAGES
from tactile_push.control.placing.stages import (
    FACES_AWAY,
    HELD_STILL,
    NOT_FINITE,
    OTHER_FRAME,
    OTHER_ROTATION,
    SETTLING,
    SETTLING_BLINDLY,
)
from tactile_push.interface import PLACE_RELEASE, PLACE_STATE, TOPICS
from tactile_push.pipeline.believing import OLDEST

FIG_8 = paper.THETA_INITIAL, paper.D_INITIAL
STRAIGHT = (0.0, 0.0, 0.0, 1.0)
DOUBT = 'nothing is known of the object, so law (18) acts'


def line_at(theta, d, **more):
    return Line(theta, d, law='settle', **more)


def stage_of(values):
    return STAGES[int(values['stage'])]


@pytest.fixture(scope='module')
def settled():
    """Return a line at figure 8's start after 70 control periods; nobody may change it."""
    line, thetas = line_at(*FIG_8), []
    for _ in range(70):
        thetas.append(line.rig.theta)
        line.period()
    return line, np.array(thetas)


def test_without_a_goal_theta_is_at_theta_desired_by_step_50(settled):
    _, thetas = settled
    # Law (18) takes 192 steps.
    assert np.abs(thetas[50:] - paper.THETA_DESIRED).max() < math.radians(3.0)


def test_each_period_tells_what_is_known_and_nothing_is_ever_let_go(settled):
    line, _ = settled
    # Where the finger was at the first reading is not known: nobody knows how it moved before.
    stages = [stage_of(values) for values in line.states]
    assert stages == [SETTLING_BLINDLY] * 2 + [SETTLING] * 68
    assert all(tuple(values) == TOPICS[PLACE_STATE].field_names for values in line.states)
    assert {values['released'] for values in line.states} == {0.0}
    assert PLACE_RELEASE not in {topic for topic, _, _ in line.heard}
    assert line.states[-1]['d'] == pytest.approx(line.rig.d, abs=1e-3)
    assert line.placing.doubt == ''
    assert math.isnan(line.placing.let_go_in)


def test_a_goal_takes_the_place_of_theta_desired_until_it_is_given_up():
    line = line_at(0.0, 0.0)
    line.ask(math.nan, 0.2)  # wherever the object is to be
    for _ in range(30):
        line.period()
    assert line.rig.theta == pytest.approx(0.2, abs=math.radians(1.0))
    assert (line.states[-1]['goal_theta'], line.control.push.law.aim) == pytest.approx((0.2, 0.2))
    assert line.placing.cancel()
    assert not line.placing.cancel()
    for _ in range(40):
        line.period()
    assert line.rig.theta == pytest.approx(paper.THETA_DESIRED, abs=math.radians(1.0))
    assert math.isnan(line.states[-1]['goal_theta'])


@pytest.mark.parametrize('room', [0.01, 0.09])
def test_an_object_that_is_settled_drifts_as_under_law_18(monkeypatch, room):
    monkeypatch.setattr(slow_mode, 'AVERAGED', 1.0)
    start = line_at(0.1, 0.003).rig.finger_pose.x
    line = line_at(0.1, 0.003, theta_desired=0.1, workspace_min=start - room, workspace_max=0.2)
    assert math.isnan(line.control.outlook.drift)
    for _ in range(30):
        line.period()
    # It translates along the ray from the contact through the centre of mass: docs/placing.md.
    aside = -math.tan(line.rig.theta + math.atan2(line.rig.d, paper.BLOCK_L))
    outlook = line.control.outlook
    assert outlook.drift == pytest.approx(paper.BELT_SPEED * aside, rel=0.1)
    assert outlook.growth == 0.0  # the tip does not turn
    assert outlook.soon is (room < 0.03)


@pytest.mark.parametrize(
    ('frame', 'rotation', 'refusal'),
    [
        ('finger_disk', STRAIGHT, OTHER_FRAME),
        ('', (0.0, 0.0, math.nan, 1.0), NOT_FINITE),
        ('', (0.5, 0.0, 0.0, 1.0), OTHER_ROTATION),
        ('', (0.0, 0.0, 1.0, 0.0), FACES_AWAY),
    ],
)
def test_a_goal_that_makes_no_sense_is_refused_and_the_last_one_stays(frame, rotation, refusal):
    line = line_at(0.0, 0.0)
    line.ask(0.0, 0.1)
    assert line.placing.goal(frame, 0.0, rotation) == refusal
    assert line.control.push.law.aim == pytest.approx(0.1)
    assert (line.placing.goals, line.placing.refused, line.placing.refusal) == (1, 1, refusal)


def test_while_the_finger_is_held_still_goals_are_refused():
    line = line_at(0.0, 0.0)
    line.period()
    line.control.push.notice_another_command()
    assert line.placing.goal('', 0.0, STRAIGHT) == HELD_STILL


def test_without_estimates_law_18_acts_after_half_a_second_and_that_is_told():
    line = line_at(*FIG_8)
    for _ in range(10):
        line.period()
    line.senses = False
    for _ in range(OLDEST + 1):  # the first one still has the estimate of the period before
        line.period()
    assert stage_of(line.states[-1]) == SETTLING
    assert line.placing.doubt == ''
    for _ in range(20):
        before, tick = line.ticks[-1], line.period()
        assert (tick.state, tick.stop_reason) == (PUSHING, NO_REASON)
        limits = math.radians(33.0), math.radians(147.0)
        gains = paper.KP, paper.KD, paper.THETA_DESIRED
        assert tick.phi == push_angle(before.phi, tick.theta, before.theta, *gains, *limits)
    assert stage_of(line.states[-1]) == SETTLING_BLINDLY
    assert line.placing.doubt == DOUBT
    line.senses = True
    line.until(lambda: stage_of(line.states[-1]) == SETTLING, 3)
    assert line.placing.doubt == ''
