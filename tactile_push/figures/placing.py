# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Objects on the belt from above as they are placed: ways of finger and object, and goals."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import matplotlib.axes
import numpy as np

from tactile_push.figures.style import BLACK, BLUE, GREY, ORANGE, PALE, RED, new_figure
from tactile_push.placed_way import PlacedWay, Points, from_above

MILLIMETRES = 1e3


def plot_placed(ways: Mapping[str, PlacedWay], files: Sequence[Path]) -> None:
    """Draw ways of finger and object from above, a panel for each object.

    The belt's direction is drawn to the right, so that what is left of the finger is above it.

    Parameters
    ----------
    ways : mapping of str to PlacedWay
        The objects in their order, by what is written above each.
    files : sequence of Path
        Where to write; the ending chooses the format.
    """
    figure = new_figure(8.0, 2.6 * len(ways))
    panels = figure.subplots(len(ways), 1, sharex=True, sharey=True, squeeze=False)[:, 0]
    for axis, (title, way) in zip(panels, ways.items(), strict=True):
        _draw(axis, way)
        axis.set_title(title, fontsize='medium', loc='left')
    panels[0].invert_yaxis()  # and with it all of them
    panels[-1].set_xlabel('along the belt [mm]')
    figure.legend(*panels[0].get_legend_handles_labels(), loc='outside lower center', ncols=4)
    for file in files:
        figure.savefig(file, dpi=160)


def _draw(axis: matplotlib.axes.Axes, way: PlacedWay) -> None:
    """Draw one object."""
    seen = from_above(way)
    axis.axhline(MILLIMETRES * seen.goal[0], color=RED, linewidth=0.8, linestyle=(0, (6, 3)))
    for centre, outline in seen.passed:
        _outline(axis, centre, outline, color=PALE, linewidth=0.8)
    axis.plot(*_along(seen.finger), color=BLUE, linewidth=1.4, label='finger')
    axis.plot(*_along(seen.centre), color=ORANGE, linewidth=1.4, label='centre of mass')
    axis.plot(*_along(seen.tip), color=GREY, linewidth=0.8)
    _outline(axis, seen.centre[-1], seen.free, color=BLACK, linewidth=1.2, label='let go')
    dashed = {'color': RED, 'linewidth': 1.0, 'linestyle': (0, (2, 2))}
    _outline(axis, seen.goal, seen.wanted, label='goal', **dashed)
    axis.set_ylabel('across [mm]')
    axis.set_aspect('equal')


def _outline(axis: matplotlib.axes.Axes, centre: Points, outline: Points, **style: Any) -> None:
    """Draw an outline and the centre of mass in it [m]."""
    axis.plot(*_along(np.append(outline, outline[:1], axis=0)), **style)
    axis.plot(*_along(centre[np.newaxis]), marker='+', markersize=6.0, color=style['color'])


def _along(points: Points) -> Points:
    """Return the coordinates along and across the belt of points [mm], shape (2, K)."""
    return MILLIMETRES * points[:, ::-1].T
