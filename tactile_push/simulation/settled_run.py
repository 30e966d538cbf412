# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""One object whose edge is brought to an angle by all that the pushes tell of it."""

from dataclasses import replace

import numpy as np

from tactile_push import paper
from tactile_push.control import PUSHING, PushControl
from tactile_push.control.placing.settle_law import SettleLaw
from tactile_push.pipeline import Sensing
from tactile_push.pipeline.belief import belief_of
from tactile_push.simulation.by_touch import LAG, NOISE, check_edges, faults_of, sensing_of
from tactile_push.simulation.experiment import control_periods
from tactile_push.simulation.rig import Rig, RigConfig
from tactile_push.simulation.rollout import Rollout, check_time


def settled_run(
    config: RigConfig,
    theta: float,
    steps: int,
    *,
    noise: float = NOISE,
    lag: float = LAG,
    seed: int = 0,
) -> Rollout:
    """Bring an object's edge to an angle.

    The law believes what the estimator finds. That one is told the outline and which edge is
    pushed, and neither where the finger touches nor c nor mu_c.

    Parameters
    ----------
    config : RigConfig
        The rig and where it starts; its finger is taken to have a tip that turns.
    theta : float
        Angle that the edge shall have [rad].
    steps : int
        Control periods.
    noise, lag : float, optional
        Standard deviation of the readings of theta [rad], and time constant with which the finger
        follows its command [s].
    seed : int, optional
        Of the sensor's errors.

    Returns
    -------
    Rollout
        What happened; shorter than `steps` if the finger stops.

    Raises
    ------
    ValueError
        If `steps` is negative, or the object has no straight edges.
    """
    period = paper.CONTROL_PERIOD
    check_time(steps, period)
    check_edges(config, 'settle')
    rig = Rig(replace(config, tip_turns=True), faults_of(noise, lag))
    knows = Sensing(sensing_of(config, noise, lag), lambda k, _: k * period)
    law = SettleLaw(theta, config.belt_speed, period, lag=lag)
    push = PushControl(law, config.belt_speed, period)
    rows: list[tuple[float, ...]] = []
    end = 'done'
    for k, tick in enumerate(control_periods(rig, push, 1, seed)):
        if rows:
            rows[-1] = (*rows[-1][:-1], rig.mode)
        if tick.state != PUSHING:
            end = tick.stop_reason or tick.state
            break
        pose = rig.object_pose
        rows.append((rig.theta, tick.phi, rig.d, pose.x, pose.y, rig.mode))
        if len(rows) > steps:
            break
        sensed = knows.tick((k, 0), tick)
        turning = rig.config.finger.turning(*rig.joints[:2])
        where = rig.finger_pose.x, turning, period * config.belt_speed
        law.believe(belief_of(sensed.values, *where))
    angles, phi, d, x, y, mode = np.array(rows).T
    return Rollout(angles, phi, d, x, y, mode.astype(np.int64), end)
