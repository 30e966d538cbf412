# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import math

import numpy as np
import pytest

from support.sticking_block import BOUNDS, PRESSURE, STICKING
from tactile_push.control.placing.arcs import ARCS, LENGTH, UNKNOWNS
from tactile_push.control.placing.model import (
    Goal,
    Situation,
    centre_of_mass,
    follow,
)
from tactile_push.control.placing.search import (
    COLUMNS,
    FAMILIES,
    ROUNDABOUT,
    arcs,
    search,
    search_roundabout,
)

START = Situation(0.0, 0.2, 0.003, 0.0, 0.0)


def searched(goal, most=0.2, roundabout=False):
    found = np.empty((ROUNDABOUT if roundabout else FAMILIES, COLUMNS))
    searching = search_roundabout if roundabout else search
    searching(START, goal, STICKING, BOUNDS, 0.0, most, found)
    return found[np.isfinite(found[:, 0])]


def followed(row):
    push = np.empty(UNKNOWNS)
    arcs(row, push)
    now = START
    for u, belt in zip(push[:ARCS], push[ARCS:], strict=True):
        now = follow(now, u, belt * LENGTH, STICKING)
    return now, push


@pytest.mark.parametrize('roundabout', [False, True])
@pytest.mark.parametrize('goal', [Goal(-0.03, -0.1), Goal(0.01, 0.3)])
def test_the_best_of_what_it_finds_costs_what_it_misses(goal, roundabout):
    found = searched(goal, roundabout=roundabout)
    row = found[np.argmin(found[:, 0])]
    now, push = followed(row)
    x, theta = centre_of_mass(now, STICKING) - goal.x, now.theta - goal.theta
    belt = push[ARCS:].sum()
    assert math.hypot(1e3 * x, math.degrees(theta)) < 2.0  # one to begin with
    assert row[0] == pytest.approx(belt + (1e3 * x) ** 2 + math.degrees(theta) ** 2, abs=0.5)


@pytest.mark.parametrize('roundabout', [False, True])
def test_all_that_it_finds_keeps_to_belt_and_steepest_command(roundabout):
    found = searched(Goal(-0.03, -0.1), most=0.1, roundabout=roundabout)
    assert len(found) > FAMILIES / 4
    commands, ends = found[:, 1 : 1 + ARCS], found[:, 1 + ARCS :]
    assert (ends >= 0.0).all()
    assert (np.diff(ends) >= 0.0).all()
    assert ends.max() <= 0.1 + 1e-12
    assert np.abs(commands).max() <= BOUNDS.steepest


def test_on_a_belt_too_short_for_the_turn_what_it_finds_misses_the_rest_of_it():
    wheelbase = (PRESSURE.c_squared + START.d**2 + STICKING.l**2) / math.hypot(START.d, STICKING.l)
    turn = math.hypot(1.0, BOUNDS.steepest) / wheelbase * 0.005  # theta' <= sqrt(1 + U^2)/L
    found = searched(Goal(0.0, -0.3), most=0.005)
    assert found[:, 0].min() > math.degrees(0.5 - turn) ** 2
