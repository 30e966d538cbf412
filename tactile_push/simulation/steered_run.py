# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""One object that is steered across the belt to a goal."""

from dataclasses import replace

from tactile_push import paper
from tactile_push.control import PushControl
from tactile_push.control.placing.steer_law import SteerLaw
from tactile_push.simulation.by_touch import LAG, NOISE, check_edges, faults_of, sensing_of
from tactile_push.simulation.placement import followed
from tactile_push.simulation.rig import Rig, RigConfig
from tactile_push.simulation.rollout import Rollout, check_time

NEAR = 2e-3  # of the goal, within which the centre of mass counts as there [m]


def steered_run(
    config: RigConfig,
    goal: float,
    steps: int,
    *,
    noise: float = NOISE,
    lag: float = LAG,
    seed: int = 0,
) -> Rollout:
    """Steer an object by touch alone.

    The law believes what the estimator finds. That one is told the outline and which edge is
    pushed, and neither where the finger touches nor c nor mu_c.

    Parameters
    ----------
    config : RigConfig
        The rig and where it starts; its finger is taken to have a tip that turns.
    goal : float
        Where the centre of mass shall be across the belt, from where the finger starts [m].
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
    check_edges(config, 'steer')
    rig = Rig(replace(config, tip_turns=True), faults_of(noise, lag))
    law = SteerLaw(paper.THETA_DESIRED, config.belt_speed, period, lag=lag)
    law.goal = config.tip.x + goal
    push = PushControl(law, config.belt_speed, period)
    return followed(rig, push, law, sensing_of(config, noise, lag), seed, steps)
