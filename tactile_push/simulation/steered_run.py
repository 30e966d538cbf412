# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""One object that is steered across the belt to a goal."""

from dataclasses import replace

from tactile_push import paper
from tactile_push.control import PushLaw, Steering
from tactile_push.mechanics.contact import L_START
from tactile_push.simulation.by_touch import LAG, NOISE, check_edges, faults_of
from tactile_push.simulation.experiment import experiment
from tactile_push.simulation.rig import RigConfig
from tactile_push.simulation.rollout import Rollout

NEAR = 2e-3  # of the goal, within which the centre of mass counts as there [m]


def steered_run(
    config: RigConfig,
    goal: float,
    steps: int,
    law: PushLaw | None = None,
    *,
    noise: float = NOISE,
    lag: float = LAG,
    seed: int = 0,
) -> Rollout:
    """Steer an object by its sensed angle and the finger's place alone.

    Parameters
    ----------
    config : RigConfig
        The rig and where it starts; its finger is taken to have a tip that turns.
    goal : float
        Where the centre of mass shall be across the belt, from where the finger starts [m].
    steps : int
        Control periods.
    law : PushLaw, optional
        Law (18), whose theta_d is trimmed; with the paper's gains by default. The run changes it.
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
        If the object has no straight edges.
    """
    check_edges(config, 'steer')
    law = law or PushLaw(paper.KP, paper.KD, paper.THETA_DESIRED)
    l = float(config.body.path[0, L_START])
    steering = Steering(law, config.belt_speed, config.tip.x + goal, l, config.radius)
    rig = replace(config, tip_turns=True)
    return experiment(rig, law, steps, faults=faults_of(noise, lag), steadying=steering, seed=seed)
