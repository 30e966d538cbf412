# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""When the next of several goals is due."""

import math

from tactile_push.control.placing.stages import STAGES
from tactile_push.pipeline.goals import GoalsInTurn

FIRST, SECOND = (-0.05, 0.1), (-0.06, -0.2)


def state(stage, goals, refused=0):
    """Return the numbers of a message of `place/state`."""
    return {'stage': float(STAGES.index(stage)), 'goals': float(goals), 'refused': float(refused)}


def test_a_goal_is_given_once_and_the_next_when_it_has_ended():
    goals = GoalsInTurn([FIRST, SECOND])
    assert goals.state(state('no goal', 0)) == FIRST
    assert goals.state(state('no goal', 0)) is None  # it is on its way
    for stage in ('waiting for contact', 'learning', 'placing', 'letting go'):
        assert goals.state(state(stage, 1)) is None
    assert goals.state(state('released', 1)) == SECOND
    # The object before is still let go.
    assert goals.state(state('released', 1)) is None
    assert goals.state(state('lifted', 2)) is None
    assert not goals.done
    assert goals.state(state('missed', 2)) is None
    assert goals.done
    assert goals.state(state('missed', 2)) is None


def test_a_goal_that_is_refused_has_ended():
    goals = GoalsInTurn([FIRST, SECOND])
    assert goals.state(state('released', 7, 3)) == FIRST
    assert goals.state(state('released', 7, 3)) is None
    assert goals.state(state('released', 7, 4)) == SECOND
    assert goals.state(state('learning', 8, 4)) is None
    assert goals.state(state('object lost', 8, 4)) is None
    assert goals.done


def test_a_message_without_counts_says_nothing():
    goals = GoalsInTurn([FIRST])
    assert goals.state({}) is None
    assert goals.state({**state('no goal', 0), 'refused': math.nan}) is None
    assert goals.state(state('no goal', 0)) == FIRST


def test_no_goals_are_done_from_the_beginning():
    assert GoalsInTurn([]).done
