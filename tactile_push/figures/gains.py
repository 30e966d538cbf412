# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Which gains settle the block when the finger does not follow its command perfectly (V.D)."""

import math
from typing import Any

import matplotlib.figure
import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes
from matplotlib.colors import BoundaryNorm, ListedColormap
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from tactile_push.figures.style import BLACK, RED, TWO_COLUMNS, new_figure, styled
from tactile_push.paper import D_INITIAL, FIGURE_8_GAINS, THETA_DESIRED, TOLERANCE
from tactile_push.simulation import Servo, paper_block, rollouts

STEPS = 600
LATEST = 500  # step from which theta must stay near
KP = np.geomspace(0.005, 5.0, 61)
KD = np.geomspace(0.5, 50.0, 41)
FRICTIONS = (0.0, 0.3, math.inf)
SERVOS = {
    'perfect finger': None,
    'lag 0.1 s': Servo(time_constant=0.1),
    'lag 0.1 s, delay 0.3 s': Servo(time_constant=0.1, delay=0.3),
}
LEVELS = (20, 50, 100, 150, 200, 300, 400, LATEST)
DOT: dict[str, Any] = {'marker': 'o', 'linestyle': '', 'color': 'white', 'markeredgecolor': BLACK}
SWINGS, CREEPS = -1, -2
SWINGING, CREEPING = '#F4C7AB', '0.87'


@styled
def gain_figure() -> matplotlib.figure.Figure:
    """Draw for which gains the paper's block settles, for three fingers and three frictions.

    The start of figure 8, kp and kd of the law (18) over three and two decades, and the step from
    which theta stays within 3 degrees of theta_d to the end, step 600, if it does so from step 500
    on. There are two ways not to: theta has not come near by then, or it comes near and does not
    stay, or the finger loses the block. In the upper row the finger goes exactly where it is told,
    in the others it lags behind its command (`Servo`). The dots are the gains of figure 8, the
    large one the paper's best on the real finger.

    With friction the perfect finger is the faster the larger both gains are, down to 25 steps. Lag
    and delay take away what is large: kp first, and with a delay kd too. Without friction there
    is less to take away from, and the larger gains of figure 8, (0.2, 10), which settle the block
    by step 118 with the perfect finger, do not with a lag of 0.1 s and a delay of 0.3 s. With
    friction they do, and the paper's gains settle it in all nine maps.

    Returns
    -------
    matplotlib.figure.Figure
        The figure, two columns wide.
    """
    figure = new_figure(TWO_COLUMNS, 6.6)
    panels = figure.subplots(len(SERVOS), len(FRICTIONS), sharex=True, sharey=True)
    colors = ListedColormap(matplotlib.colormaps['viridis_r'](np.linspace(0.0, 0.95, 7)))
    norm = BoundaryNorm(LEVELS, colors.N)
    perfect: dict[float, npt.NDArray[np.bool_]] = {}
    for row, (name, servo) in zip(panels, SERVOS.items(), strict=True):
        for axes, mu_c in zip(row, FRICTIONS, strict=True):
            step = settle_steps(mu_c, servo)
            _draw_outcome(axes, step, colors, norm)
            if servo is None:
                perfect[mu_c] = step >= 0
                value = r'\infty' if math.isinf(mu_c) else f'{mu_c:g}'
                axes.set_title(rf'$\mu_c = {value}$')
            else:
                axes.contour(KP, KD, perfect[mu_c], [0.5], colors=BLACK, linewidths=0.8)
        row[0].set_ylabel(f'{name}\n$k_d$ [rad/rad]')
        row[0].yaxis.set_major_formatter('{x:g}')
    for axes in panels[-1]:
        axes.set_xlabel('$k_p$ [rad/rad]')
        axes.xaxis.set_major_formatter('{x:g}')
    figure.colorbar(
        matplotlib.cm.ScalarMappable(norm, colors),
        ax=panels,
        label='within 3° of $\\theta_d$ from step',
        aspect=50,
        ticks=LEVELS,
    )
    figure.legend(
        handles=[
            Patch(facecolor=CREEPING, label=f'not yet near at step {LATEST}'),
            Patch(
                facecolor=SWINGING, hatch='////', edgecolor=RED, label='swings or loses the block'
            ),
            Line2D([], [], color=BLACK, linewidth=0.8, label='limit of the perfect finger'),
            Line2D([], [], **DOT, markersize=6.0, label='gains of fig. 8; large: the best'),
        ],
        loc='outside lower center',
        ncols=2,
    )
    return figure


def settle_steps(mu_c: float, servo: Servo | None) -> npt.NDArray[np.int64]:
    """Return the step from which theta stays in the band for each kd and kp, shape (41, 61).

    Gains without such a step have `SWINGS` or `CREEPS`.
    """
    kp, kd = (gains.ravel() for gains in np.meshgrid(KP, KD))
    block = paper_block(d=D_INITIAL, mu_c=mu_c)
    runs = rollouts(
        block.slider,
        theta=block.theta,
        d=D_INITIAL,
        mu_c=mu_c,
        kp=kp,
        kd=kd,
        theta_desired=THETA_DESIRED,
        steps=STEPS,
        servo=servo,
        band=TOLERANCE,
        history=True,
    )
    near = np.abs(runs.theta - THETA_DESIRED) <= TOLERANCE
    settles = (runs.settle_step >= 0) & (runs.settle_step <= LATEST)
    # Still on its way, rather than there and away again.
    creeps = ~near[:, :LATEST].any(axis=1) & (runs.steps == STEPS)
    step = np.where(settles, runs.settle_step, np.where(creeps, CREEPS, SWINGS))
    return step.reshape(len(KD), len(KP))


def _draw_outcome(
    axes: Axes, step: npt.NDArray[np.int64], colors: ListedColormap, norm: BoundaryNorm
) -> None:
    """Draw one map over the gains."""
    axes.set(xscale='log', yscale='log', facecolor=CREEPING)
    axes.pcolormesh(
        KP, KD, np.ma.masked_less(step, 0), cmap=colors, norm=norm, shading='nearest', zorder=1.0
    )
    swinging = np.where(step == SWINGS, 1.0, 0.0)
    with matplotlib.rc_context({'hatch.linewidth': 0.4, 'hatch.color': RED}):
        axes.contourf(KP, KD, swinging, [0.5, 1.5], colors=[SWINGING], hatches=['////'], zorder=1.5)
    for (kp, kd), size in zip(FIGURE_8_GAINS, (3.0, 6.0, 3.0), strict=True):
        axes.plot(kp, kd, **DOT, markersize=size, zorder=3.0)
