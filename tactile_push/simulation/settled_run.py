# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""One object whose edge is brought to an angle by all that the pushes tell of it."""

import math
from dataclasses import replace

import numpy as np

from tactile_push import paper
from tactile_push.control import PUSHING, PushControl
from tactile_push.control.placing.settle_law import SettleLaw
from tactile_push.estimation import ActiveSensing, FingerMotion, ObjectEstimator, edges_of
from tactile_push.pipeline import Sensing
from tactile_push.pipeline.belief import belief_of
from tactile_push.simulation.experiment import control_periods
from tactile_push.simulation.faults import Faults
from tactile_push.simulation.rig import Rig, RigConfig
from tactile_push.simulation.rollout import Rollout, check_time
from tactile_push.simulation.sensor import Sensor
from tactile_push.simulation.servo import Servo

SHARE = 0.01  # standard deviation of l and r that the estimator is told, as a share
SILENCE = 0.3  # without a reading for longer the estimate starts over [s]


def settled_run(
    config: RigConfig,
    theta: float,
    steps: int,
    *,
    noise: float = math.radians(0.3),
    lag: float = 0.1,
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
    outline = config.slider.outline
    if (outline.pieces[:, 3:] > 0.0).all(axis=1).any():  # arcs have a length and a turn
        raise ValueError('object: expected one with straight edges to settle, got a round one')
    rig = Rig(
        replace(config, tip_turns=True),
        Faults(servo=Servo(time_constant=lag), sensor=Sensor(noise)),
    )
    estimator = ObjectEstimator(
        edges_of(outline.points(math.inf))[:1],
        noise,
        l_share=SHARE,
        radius=config.radius,
        radius_share=SHARE,
    )
    sensing = ActiveSensing(
        *(estimator, FingerMotion(lag), config.belt_speed, SILENCE), radius=config.radius
    )
    knows = Sensing(sensing, lambda k, _: k * period)
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
