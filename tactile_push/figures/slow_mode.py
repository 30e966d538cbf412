# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""How the block drifts away while the finger tip turns, and how steadying holds it."""

import math
from dataclasses import replace

import matplotlib.figure
import numpy as np
import numpy.typing as npt

from tactile_push.control import PushLaw, Steadying, growth_rate
from tactile_push.figures.style import (
    BLACK,
    BLUE,
    GREY,
    ONE_COLUMN,
    ORANGE,
    RED,
    new_figure,
    styled,
)
from tactile_push.paper import (
    BLOCK_L,
    CONTROL_PERIOD,
    KD,
    KP,
    THETA_DESIRED,
    TRANSLATING_STEP,
)
from tactile_push.simulation import RigConfig, Rollout, experiment, paper_block
from tactile_push.tactile.planar_finger import USUAL_FINGER

STEPS = 1500
LARGEST_TRIM = math.radians(15.0)
MILLIMETRE = 1000.0  # of a metre
HOME = USUAL_FINGER.inverse(-USUAL_FINGER.proximal_length, USUAL_FINGER.distal_length)

Array = npt.NDArray[np.float64]


@styled
def slow_mode_figure() -> matplotlib.figure.Figure:
    """Draw the block of figure 8 for 150 s, with a tip that turns with the last link and without.

    The start, the gains and the limit surface of figure 8, through the rig with its finger, whose
    tip turns by -12.5 rad/m at home. Each line ends where the finger reaches the end of its
    workspace, x = -105 mm. The dashed line is the linear prediction from step 400 on, with the
    growth rate where the finger then is: d + l tan(theta_d) grows by e in 31 s. The dotted vertical
    line is step 400, from which on the paper takes the block to translate.

    With a straight tip the contact keeps d + r theta, and the block drifts to the right at 0.65
    mm/s. With the tip that turns, theta settles as in the paper and d does not, though it looks
    settled at step 400; the finger reaches the end of its workspace after 74 s. Steadying lowers
    theta by 12 degrees more and holds the block there.

    Returns
    -------
    matplotlib.figure.Figure
        The figure, one column wide.
    """
    figure = new_figure(ONE_COLUMN, 4.8)
    panels = figure.subplots(3, 1, sharex=True)
    straight = paper_block()
    turning = replace(straight, tip_turns=True)
    runs = {
        'straight tip': (_run(straight, 0.0), GREY, 1.0),
        'turning tip': (_run(turning, 0.0), RED, 1.2),
        'the same, steadied': (_run(turning, LARGEST_TRIM), BLUE, 1.2),
    }
    for label, (run, color, width) in runs.items():
        time = CONTROL_PERIOD * np.arange(len(run.theta))
        for axes, values in zip(panels, _drawn(run, straight.radius), strict=True):
            axes.plot(time, values, color=color, linewidth=width, label=label)
    drifting = runs['turning tip'][0]
    time, d, x = _predicted(drifting, straight.radius)
    panels[1].plot(time, MILLIMETRE * d, **LINEAR)
    panels[2].plot(time, MILLIMETRE * x, **LINEAR)
    for axes, label in zip(panels, ('θ [°]', 'd [mm]', 'x of the finger [mm]'), strict=True):
        axes.set_ylabel(label)
        axes.axvline(TRANSLATING_STEP * CONTROL_PERIOD, color=ORANGE, linewidth=0.8, ls=':')
    panels[0].axhline(math.degrees(THETA_DESIRED), color=GREY, linewidth=0.6)
    panels[0].annotate(r'$\theta_d$', (148.0, -9.5), color=GREY, va='bottom', ha='right')
    panels[0].annotate(
        f'step {TRANSLATING_STEP}', (41.0, 19.0), color=ORANGE, va='top', annotation_clip=False
    )
    panels[1].set_ylim(-7.0, 13.0)
    panels[2].set_ylim(-108.0, 12.0)
    panels[2].set(xlabel='time [s]', xlim=(0.0, STEPS * CONTROL_PERIOD))
    figure.legend(*panels[2].get_legend_handles_labels(), loc='outside lower center', ncols=2)
    return figure


LINEAR = {'color': BLACK, 'linewidth': 0.8, 'linestyle': '--', 'label': 'linear, from step 400'}


def _run(config: RigConfig, largest_trim: float) -> Rollout:
    """Run the block through finger, sensor and controller."""
    law = PushLaw(KP, KD, THETA_DESIRED)
    return experiment(config, law, STEPS, steadying=Steadying(largest_trim))


def _finger_x(run: Rollout, radius: float) -> Array:
    """Return where the finger's disk is in `finger_base` [m], from the object's pose."""
    home = USUAL_FINGER.forward(*HOME).x
    return home + run.x + run.d * np.cos(run.theta) + (BLOCK_L + radius) * np.sin(run.theta)


def _drawn(run: Rollout, radius: float) -> tuple[Array, Array, Array]:
    """Return theta [deg], d and x of the finger [mm]."""
    return np.degrees(run.theta), MILLIMETRE * run.d, MILLIMETRE * _finger_x(run, radius)


def _predicted(run: Rollout, radius: float) -> tuple[Array, Array, Array]:
    """Return time [s], d and x of the finger [m] by the linear mode, from step 400 on."""
    home = USUAL_FINGER.forward(*HOME)
    start_d, start_x = run.d[TRANSLATING_STEP], _finger_x(run, radius)[TRANSLATING_STEP]
    turning = USUAL_FINGER.turning(*USUAL_FINGER.inverse(start_x, home.y))
    growth = growth_rate(THETA_DESIRED, BLOCK_L, radius, turning, paper_block().belt_speed)
    time = CONTROL_PERIOD * np.arange(STEPS - TRANSLATING_STEP + 1, dtype=np.float64)
    balanced = -BLOCK_L * math.tan(THETA_DESIRED)
    d = balanced + (start_d - balanced) * np.exp(growth * time)
    x = start_x + (d - start_d) / (radius * turning)
    return time + TRANSLATING_STEP * CONTROL_PERIOD, d, x
