# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""A picture of measured pushes beside predicted ones."""

import math
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes

from tactile_push.figures.style import BLUE, GREY, TWO_COLUMNS, new_figure, styled
from tactile_push.identification.identify import Identified
from tactile_push.identification.records import Push
from tactile_push.mechanics.compiled import Array


@styled
def draw_pushes(found: Identified, file: Path) -> None:
    """Draw how far the object went and turned in each push, measured and predicted.

    Parameters
    ----------
    found : Identified
        The pushes, each predicted by numbers that do not know it.
    file : Path
        Where to write; the ending chooses the format.
    """
    rows = np.array([_motion(push) for push in found.pushes.pushes])
    turned = rows[:, 3] + found.residual[:, 2]
    along = (rows[:, :2] * (rows[:, 4:] + found.residual[:, :2])).sum(axis=1)
    figure = new_figure(TWO_COLUMNS, 0.5 * TWO_COLUMNS)
    way, turn = figure.subplots(1, 2)
    errors = found.errors.figures()
    _draw(way, 1e3 * rows[:, 2], 1e3 * along, 'motion along the push [mm]')
    way.set_title(f'ends are off by {errors["mean_mm"]:.2f} mm in the mean')
    _draw(turn, np.degrees(rows[:, 3]), np.degrees(turned), 'turn [°]')
    turn.set_title(f'and by {errors["mean_deg"]:.2f}°')
    figure.savefig(file)


def _motion(push: Push) -> tuple[float, ...]:
    """Return direction of a push (2), motion of the object along it, turn, and motion (2)."""
    (x, y), (to_x, to_y) = push.way[0], push.way[-1]
    length = math.hypot(to_x - x, to_y - y) or 1.0
    e_x, e_y = (to_x - x) / length, (to_y - y) / length
    d_x, d_y = push.end.x - push.begin.x, push.end.y - push.begin.y
    turn = math.remainder(push.end.angle - push.begin.angle, math.tau)
    return e_x, e_y, e_x * d_x + e_y * d_y, turn, d_x, d_y


def _draw(axes: Axes, measured: Array, predicted: Array, what: str) -> None:
    ends = [min(measured.min(), predicted.min()), max(measured.max(), predicted.max())]
    axes.plot(ends, ends, color=GREY, linewidth=0.6)
    axes.plot(measured, predicted, '.', color=BLUE, markersize=3)
    axes.set_xlabel(f'measured {what}')
    axes.set_ylabel(f'predicted {what}')
    axes.set_aspect('equal', 'datalim')
