# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Objects on the belt from above as they are placed: ways of finger and object, and goals."""

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

import matplotlib.axes
import numpy as np

from tactile_push.control.placing.model import Goal
from tactile_push.figures.style import BLACK, BLUE, GREY, ORANGE, PALE, RED, new_figure
from tactile_push.mechanics.compiled import Array

MILLIMETRES = 1e3
BETWEEN = 0.05  # belt between two outlines that are drawn on the way [m]
ROUND = 60  # points of a circle: looks round


class PlacedWay(NamedTuple):
    """How one object was brought to its goal, on the belt."""

    title: str  #: what is written above
    #: corners about the centre of mass [m]; empty if they are not known
    outline: Sequence[tuple[float, float]]
    edge: float  #: angle of the pushed edge in the object [rad]
    finger: Array  #: centre of the finger's disk at each moment, shape (K, 2) [m]
    radius: float  #: of the disk [m]
    #: of the object at each moment: x, y of the centre of mass [m] and theta [rad], shape (K, 3)
    moved: Array
    goal: Goal  #: where to let go


def plot_placed(ways: Sequence[PlacedWay], files: Sequence[Path]) -> None:
    """Draw ways of finger and object from above, a panel for each object.

    The belt's direction is drawn to the right, so that what is left of the finger is above it. The
    goal says nothing about the place along the belt, so its outline stands where the object was let
    go.

    Parameters
    ----------
    ways : sequence of PlacedWay
        The objects in their order.
    files : sequence of Path
        Where to write; the ending chooses the format.
    """
    figure = new_figure(8.0, 2.6 * len(ways))
    panels = figure.subplots(len(ways), 1, sharex=True, squeeze=False)[:, 0]
    for axis, way in zip(panels, ways, strict=True):
        _draw(axis, way)
    panels[-1].set_xlabel('along the belt [mm]')
    figure.legend(*panels[0].get_legend_handles_labels(), loc='outside lower center', ncols=4)
    for file in files:
        figure.savefig(file, dpi=160)


def _draw(axis: matplotlib.axes.Axes, way: PlacedWay) -> None:
    """Draw one object, its belt counted from where the finger was at first."""
    start = 0.0, way.finger[0, 1]
    finger, centre = way.finger - start, way.moved[:, :2] - start
    theta = way.moved[:, 2]
    axis.axhline(MILLIMETRES * way.goal.x, color=RED, linewidth=0.8, linestyle=(0, (6, 3)))
    for k in np.searchsorted(finger[:, 1], np.arange(0.0, finger[-1, 1], BETWEEN)):
        _outline(axis, way, centre[k], theta[k], color=PALE, linewidth=0.8)
    axis.plot(*_along(finger), color=BLUE, linewidth=1.4, label='finger')
    axis.plot(*_along(centre), color=ORANGE, linewidth=1.4, label='centre of mass')
    turns = np.linspace(0.0, 2.0 * math.pi, ROUND)
    tip = way.radius * np.stack([np.cos(turns), np.sin(turns)], axis=1)
    axis.plot(*_along(finger[-1] + tip), color=GREY, linewidth=0.8)
    _outline(axis, way, centre[-1], theta[-1], color=BLACK, linewidth=1.2, label='let go')
    wanted = np.array([way.goal.x, centre[-1, 1]])
    dashed = {'color': RED, 'linewidth': 1.0, 'linestyle': (0, (2, 2))}
    _outline(axis, way, wanted, way.goal.theta, label='goal', **dashed)
    axis.set_title(way.title, fontsize='medium', loc='left')
    axis.set_ylabel('across [mm]')
    axis.set_aspect('equal')
    axis.invert_yaxis()


def _outline(
    axis: matplotlib.axes.Axes, way: PlacedWay, centre: Array, theta: float, **style: Any
) -> None:
    """Draw the outline about a centre of mass [m] with the pushed edge at theta [rad]."""
    angle = theta - way.edge
    turn = np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
    corners = np.reshape(np.asarray(way.outline, dtype=float), (-1, 2))
    closed = np.append(corners, corners[:1], axis=0)
    axis.plot(*_along(closed @ turn.T + centre), **style)
    axis.plot(*_along(centre[np.newaxis]), marker='+', markersize=6.0, color=style['color'])


def _along(points: Array) -> Array:
    """Return the coordinates along and across the belt of points [mm], shape (2, K)."""
    return MILLIMETRES * points[:, ::-1].T
