# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Figures 7 and 8 of the paper: the simulated block, open loop and under the law (Section V.B)."""

import math
from typing import Any

import matplotlib.figure
import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Circle

from tactile_push.control import AHEAD, PushLaw
from tactile_push.figures.style import (
    BLACK,
    BLUE,
    CENTIMETRE,
    GREY,
    ONE_COLUMN,
    ORANGE,
    PALE_BLUE,
    RED,
    TWO_COLUMNS,
    new_figure,
    styled,
)
from tactile_push.paper import (
    C_MAX,
    C_MIN,
    C_UNIFORM,
    CONTROL_PERIOD,
    FIGURE_7_D,
    FIGURE_7_PUSHES,
    FIGURE_8_GAINS,
    THETA_DESIRED,
)
from tactile_push.simulation import RigConfig, paper_block, rollout

OPEN_LOOP = ((C_MAX, math.inf), (C_UNIFORM, math.inf), (C_MIN, math.inf), (C_UNIFORM, 0.0))
BETWEEN_SNAPSHOTS = 50
STEPS = 400


@styled
def trajectory_figure() -> matplotlib.figure.Figure:
    """Draw figure 7: where the block goes when it is pushed straight on without control.

    The paper's block, 5 cm x 4.75 cm, phi = 90 degrees, theta(0) = 0, d(0) = -0.5 cm, under the
    ellipsoid with four combinations: c_max = 3.45 cm, c_uni = 1.87 cm and c_min = 0.67 cm with
    mu_c infinite, and c_uni with mu_c = 0. Snapshots of the block and the finger's disk, of radius
    1.35 cm, every 50 pushes, which is every 2.5 cm, each on top of the ones before, and the path of
    the centre of mass. The axes are fixed to the belt; the finger starts at the origin.

    The finger starts to the left of the centre of mass, so the block turns clockwise in all four,
    as the voting theorem says. It turns the more the smaller c is: by 22, 55 and 103 degrees in 200
    pushes. With infinite friction the contact sticks and the block rolls on the finger, beyond the
    centre of mass: d grows to 0.8 cm in (b). At the end of (c) the finger pulls. Without friction
    the finger slips back to the left, to d = -0.8 cm, and the block turns by 44 degrees.

    Returns
    -------
    matplotlib.figure.Figure
        The figure, two columns wide.
    """
    figure = new_figure(TWO_COLUMNS, 3.35)
    panels = figure.subplots(1, len(OPEN_LOOP), sharex=True, sharey=True)
    for axes, (c, mu_c), letter in zip(panels, OPEN_LOOP, 'abcd', strict=True):
        _draw_snapshots(axes, paper_block(theta=0.0, d=FIGURE_7_D, c=c, mu_c=mu_c))
        value = r'\infty' if math.isinf(mu_c) else f'{mu_c:g}'
        axes.set_title(rf'({letter})  $c = {CENTIMETRE * c:.2f}\,$cm, $\mu_c = {value}$')
        axes.set_xlabel('$x$ [cm]')
        axes.set(aspect='equal', xticks=(0, 5), yticks=(0, 5, 10, 15))
    panels[0].set_ylabel('$y$ [cm]')
    return figure


def _draw_snapshots(axes: Axes, config: RigConfig) -> None:
    """Draw block and finger every so many pushes."""
    run = rollout(config, AHEAD, FIGURE_7_PUSHES, CONTROL_PERIOD)
    x, y = CENTIMETRE * run.x, CENTIMETRE * run.y
    corners = CENTIMETRE * config.slider.outline.points(config.radius)
    for k in range(0, FIGURE_7_PUSHES + 1, BETWEEN_SNAPSHOTS):
        cos, sin = math.cos(run.theta[k]), math.sin(run.theta[k])
        block = corners @ [[cos, sin], [-sin, cos]] + (x[k], y[k])
        finger = 0.0, CENTIMETRE * config.belt_speed * CONTROL_PERIOD * k
        style: dict[str, Any] = {
            'edgecolor': BLACK,
            'linewidth': 0.7,
            'zorder': 2.0 + k / FIGURE_7_PUSHES,
        }
        axes.fill(*block.T, facecolor='0.92', **style)
        axes.add_patch(Circle(finger, CENTIMETRE * config.radius, facecolor=PALE_BLUE, **style))
    axes.plot(x, y, color=RED, zorder=4.0)
    axes.plot(x[::BETWEEN_SNAPSHOTS], y[::BETWEEN_SNAPSHOTS], 'o', color=RED, ms=2.5, zorder=4.0)


@styled
def step_response_figure() -> matplotlib.figure.Figure:
    """Draw figure 8: the step response under the control law (18).

    The paper's block with c_uni = 1.87 cm and mu_c infinite, theta(0) = 20 degrees, d(0) = -0.6 cm,
    phi(0) = 90 degrees, theta_d = -10 degrees, one push a step of 0.1 s, for the gains (kp, kd) =
    (0.05, 5), which the paper found best on the real finger, for smaller ones, (0.02, 2), and for
    larger ones, (0.2, 10); theta and phi in radians.

    All end in the same translation, theta = -10 degrees and phi = 82.6 degrees. The paper's gains
    bring theta there without overshoot, within 3 degrees from step 192 on. Smaller ones overshoot
    by 2 degrees. Larger ones are there by step 102, with larger push angles, for in the simulation
    the finger goes exactly where it is told (V.D).

    Returns
    -------
    matplotlib.figure.Figure
        The figure, one column wide.
    """
    figure = new_figure(ONE_COLUMN, 3.8)
    upper, lower = figure.subplots(2, 1, sharex=True)
    upper.axhline(math.degrees(THETA_DESIRED), color=GREY, linewidth=0.8)
    upper.annotate(r'$\theta_d$', (3.0, -9.6), color=GREY, va='bottom')
    for (kp, kd), color, style in zip(
        FIGURE_8_GAINS, (ORANGE, BLACK, BLUE), ('--', '-', '-.'), strict=True
    ):
        run = rollout(
            paper_block(c=C_UNIFORM), PushLaw(kp, kd, THETA_DESIRED), STEPS, CONTROL_PERIOD
        )
        line = {'color': color, 'linestyle': style, 'label': f'$k_p = {kp:g}$, $k_d = {kd:g}$'}
        step = np.arange(len(run.theta))
        upper.plot(step, np.degrees(run.theta), **line)
        lower.plot(step, np.degrees(run.phi) - 90.0, **line)
    upper.set_ylabel(r'$\theta$ [°]')
    lower.set_ylabel(r'$\phi - 90°$ [°]')
    lower.set(xlabel='step $k$ (0.1 s each)', xlim=(0, STEPS))
    upper.legend(loc='upper right')
    return figure
