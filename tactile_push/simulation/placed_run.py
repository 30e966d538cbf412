# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""One object placed by touch alone, and its way there."""

import math
from dataclasses import dataclass

import numpy as np

from tactile_push import paper
from tactile_push.control import Tick
from tactile_push.control.placing.law import PlaceLaw
from tactile_push.control.placing.model import Goal
from tactile_push.estimation import ActiveSensing, FingerMotion, ObjectEstimator, edges_of
from tactile_push.mechanics.compiled import Array
from tactile_push.simulation.faults import Faults
from tactile_push.simulation.placement import Placement, place
from tactile_push.simulation.rig import Rig, RigConfig
from tactile_push.simulation.rollout import Rollout
from tactile_push.simulation.sensor import Sensor
from tactile_push.simulation.servo import Servo

NOISE, LAG = math.radians(0.3), 0.1  # of the readings of theta [rad] and of the finger [s]
SHARE = 0.01  # standard deviation of l and r that the estimator is told, as a share
SILENCE = 0.3  # without a reading for longer the estimate starts over [s]


@dataclass(frozen=True, eq=False)
class PlacedRun:
    """How an object was placed."""

    #: what happened; the last moment is when the object was let go, or the end
    run: Rollout
    finger: Array  #: centre of the finger's disk on the belt at each moment [m], shape (K + 1, 2)
    goal: Goal  #: where to let go, x from where the finger starts
    placement: Placement  #: how the object lay at the end


def placed_run(config: RigConfig, goal: Goal, steps: int, seed: int = 0) -> PlacedRun:
    """Place an object by touch alone.

    The sensor errs by `NOISE` and the finger follows its commands with `LAG`. The law is told the
    outline and which edge is pushed. It is told neither where the finger touches nor c nor mu_c.

    Parameters
    ----------
    config : RigConfig
        The rig and where it starts, with an object of straight edges.
    goal : Goal
        Where to let go, x from where the finger starts.
    steps : int
        Control periods for which there is belt.
    seed : int, optional
        Of the sensor's errors.

    Returns
    -------
    PlacedRun
        What happened.

    Raises
    ------
    ValueError
        If the object has no straight edges.
    """
    outline = config.slider.outline
    rows: list[tuple[float, ...]] = []
    if (outline.pieces[:, 3:] > 0.0).all(axis=1).any():  # arcs have a length and a turn
        raise ValueError('object: expected one with straight edges to place, got a round one')
    estimator = ObjectEstimator(
        edges_of(outline.points(math.inf))[:1],
        NOISE,
        l_share=SHARE,
        radius=config.radius,
        radius_share=SHARE,
    )
    sensing = ActiveSensing(
        *(estimator, FingerMotion(LAG), config.belt_speed, SILENCE), radius=config.radius
    )
    law = PlaceLaw(
        Goal(config.tip.x + goal.x, goal.theta),
        steps * paper.CONTROL_PERIOD * config.belt_speed,
        *(config.belt_speed, paper.CONTROL_PERIOD),
        lag=LAG,
    )

    def watch(rig: Rig, tick: Tick) -> None:
        pose = rig.object_pose
        moved = rig.theta, tick.phi, rig.d, pose.x, pose.y, rig.mode
        rows.append((*moved, rig.finger_x, rig.finger_y))

    faults = Faults(servo=Servo(time_constant=LAG), sensor=Sensor(NOISE))
    done = place(config, law, sensing=sensing, faults=faults, seed=seed, watch=watch)
    theta, phi, d, x, y, mode, finger_x, finger_y = np.array(rows).T
    run = Rollout(theta, phi, d, x, y, mode.astype(np.int64), done.end or 'done')
    return PlacedRun(run, np.stack([finger_x, finger_y], axis=1), goal, done)
