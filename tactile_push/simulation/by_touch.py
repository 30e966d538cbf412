# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What runs by touch alone have in common: finger and sensor as they are, and what is told."""

import math

from tactile_push.estimation import ActiveSensing, FingerMotion, ObjectEstimator, edges_of
from tactile_push.simulation.faults import Faults
from tactile_push.simulation.rig import RigConfig
from tactile_push.simulation.sensor import Sensor
from tactile_push.simulation.servo import Servo

NOISE, LAG = math.radians(0.3), 0.1  # of the readings of theta [rad] and of the finger [s]
SHARE = 0.01  # standard deviation of l and r that the estimator is told, as a share
SILENCE = 0.3  # without a reading for longer the estimate starts over [s]


def check_edges(config: RigConfig, purpose: str) -> None:
    """Refuse an object without a straight edge for a purpose, such as 'place'.

    Raises
    ------
    ValueError
        If it has none.
    """
    outline = config.slider.outline
    if (outline.pieces[:, 3:] > 0.0).all(axis=1).any():  # arcs have a length and a turn
        raise ValueError(f'object: expected one with straight edges to {purpose}, got a round one')


def faults_of(noise: float, lag: float) -> Faults:
    """Return a finger and a sensor that are not perfect.

    Parameters
    ----------
    noise, lag : float
        Standard deviation of the readings of theta [rad], and time constant with which the finger
        follows its command [s].
    """
    return Faults(servo=Servo(time_constant=lag), sensor=Sensor(noise))


def sensing_of(config: RigConfig, noise: float, lag: float) -> ActiveSensing:
    """Return an estimator that is told the outline and which edge is pushed.

    It is told neither where the finger touches nor c nor mu_c.

    Parameters
    ----------
    config : RigConfig
        The rig, with an object of straight edges.
    noise, lag : float
        As in `faults_of`.
    """
    estimator = ObjectEstimator(
        edges_of(config.slider.outline.points(math.inf))[:1],
        noise,
        l_share=SHARE,
        radius=config.radius,
        radius_share=SHARE,
    )
    motion = FingerMotion(lag)
    return ActiveSensing(estimator, motion, config.belt_speed, SILENCE, radius=config.radius)
