# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""One object placed by touch alone, and its way there."""

import typing
from dataclasses import dataclass

import numpy as np

from tactile_push import paper
from tactile_push.control import Limits, Tick
from tactile_push.control.limits import RETREAT
from tactile_push.control.placing.law import PlaceLaw
from tactile_push.control.placing.model import Goal
from tactile_push.control.placing.regrasp import Moves
from tactile_push.control.placing.stages import MISSED, RELEASED
from tactile_push.mechanics.compiled import Array
from tactile_push.simulation.by_touch import LAG, NOISE, check_edges, faults_of, sensing_of
from tactile_push.simulation.placement import Placement, place
from tactile_push.simulation.rig import Rig, RigConfig
from tactile_push.simulation.rollout import Rollout
from tactile_push.simulation.trace import Trace

if typing.TYPE_CHECKING:
    from tactile_push.simulation.mujoco_rig import MujocoRig


@dataclass(frozen=True, eq=False)
class PlacedRun:
    """How an object was placed."""

    #: what happened; the last moment is when the object was let go, or the end
    run: Rollout
    finger: Array  #: centre of the finger's disk on the belt at each moment [m], shape (K + 1, 2)
    goal: Goal  #: where to let go, x from where the finger starts
    placement: Placement  #: how the object lay at the end
    regrasps: int = 0  #: how often the finger left it for another contact


def placed_run(
    config: RigConfig, goal: Goal, steps: int, seed: int = 0, *, axes: int = 1
) -> PlacedRun:
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
    axes : int, optional
        How many ways the finger can move. With 2 it touches the object elsewhere where no push
        from the first contact leads to the goal.

    Returns
    -------
    PlacedRun
        What happened.

    Raises
    ------
    ValueError
        If the object has no straight edges.
    """
    check_edges(config, 'place')
    trace = Trace()
    finger: list[tuple[float, float]] = []
    sensing = sensing_of(config, NOISE, LAG)
    limits = Limits(retreat_max=RETREAT if axes == 2 else 0.0)
    moves = Moves(limits.max_speed, limits.max_acceleration, config.belt_speed)
    law = PlaceLaw(
        Goal(config.tip.x + goal.x, goal.theta),
        steps * paper.CONTROL_PERIOD * config.belt_speed,
        *(config.belt_speed, paper.CONTROL_PERIOD),
        lag=LAG,
        moves=moves if axes == 2 else None,
        room=RETREAT,
    )

    def watch(rig: 'Rig | MujocoRig', tick: Tick) -> None:
        trace.add(rig, tick.phi)
        finger.append((rig.finger_x, rig.finger_y))

    rig = Rig(config, faults_of(NOISE, LAG))
    done = place(rig, law, sensing=sensing, limits=limits, seed=seed, watch=watch)
    end = {RELEASED: 'done', MISSED: MISSED}.get(done.stage, done.end or done.stage)
    return PlacedRun(trace.run(end), np.array(finger), goal, done, law.regrasps)
