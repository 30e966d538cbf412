# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Compiles what laws that believe would compile while the object is pushed."""

import math
from collections.abc import Sequence

import numpy as np

from tactile_push import paper
from tactile_push.control.placing.believing import Belief, BelievingLaw
from tactile_push.control.placing.horizon import pushes
from tactile_push.control.placing.law import PlaceLaw
from tactile_push.control.placing.learning import Spread
from tactile_push.control.placing.model import Goal, Pushed, centre_of_mass
from tactile_push.control.placing.settle_law import SettleLaw
from tactile_push.control.placing.steer_law import SteerLaw
from tactile_push.mechanics import friction_cone
from tactile_push.mechanics.resistance import Pressure
from tactile_push.mechanics.turning_tip import STRAIGHT

THETA = 0.1  # of an edge that is some way from the goal [rad]


def compile_placing() -> None:
    """Compile now, or load, what the law compiles as it learns, plans and plans again."""
    law = PlaceLaw(Goal(0.0, 0.0), 0.3, paper.BELT_SPEED, paper.CONTROL_PERIOD)
    _push(law, (5e-3, 1e-4, 1e-4))
    task = law.task()
    assert task is not None
    pushes((task.now, law.goal, task.pushed), task.bounds, 0.0, task.belt, 0, roundabout=True)


def compile_steering() -> None:
    """Compile now, or load, what the law that steers compiles."""
    law = SteerLaw(0.0, paper.BELT_SPEED, paper.CONTROL_PERIOD)
    law.goal = 0.0
    _push(law, (5e-3,))
    _push(law, (5e-3, 5e-3), mu_c=0.0)  # where the contact slips it plans, and goes on with that


def compile_settling() -> None:
    """Compile now, or load, what the law that settles compiles."""
    _push(SettleLaw(0.0, paper.BELT_SPEED, paper.CONTROL_PERIOD), (5e-3,))


def _push(law: BelievingLaw, deviations: Sequence[float], mu_c: float = 1.0) -> None:
    """Let a law push some way from its goal, with standard deviations of d in turn [m]."""
    pressure = Pressure(paper.C_UNIFORM**2, 0.0, 0.0, np.array((1.0, 0.0, 1.0)), 0.0)
    cos_alpha, sin_alpha = friction_cone(mu_c)
    l, r = paper.BLOCK_L, paper.FINGER_RADIUS
    pushed = Pushed(l, r, pressure, cos_alpha, sin_alpha, STRAIGHT, 0.0)
    ends = -paper.BLOCK_EDGE / 2.0, paper.BLOCK_EDGE / 2.0
    piece = paper.BELT_SPEED * paper.CONTROL_PERIOD
    for d_deviation in deviations:
        spread = Spread(1e-3, d_deviation, 0.1, 1e-3, piece)
        law.believe(Belief(0.0, THETA, 0.0, pushed, (0.3, math.inf), ends, spread))
        law.pass_time(paper.CONTROL_PERIOD)
        law.update(THETA)
    present = law.present()
    assert present is not None
    centre_of_mass(present[0], pushed)
