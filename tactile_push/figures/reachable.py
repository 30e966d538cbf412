# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The goals that can be reached from one start, and why the others cannot."""

import math
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
from matplotlib.colors import ListedColormap
from matplotlib.patches import Patch

from tactile_push.control.placing.reachable_set import ReachableSet
from tactile_push.control.placing.stages import (
    AT_THE_LIMITS,
    BELT,
    CONTACT,
    EDGE,
    FRICTION,
    OUT_OF_REACH,
    SENSOR,
    WITH_RESERVE,
    WORKSPACE,
)
from tactile_push.figures.style import new_figure

MILLIMETRES = 1e3
# Colours that also differ in grey.
COLORS = {
    (WITH_RESERVE, ''): ('with reserve', '#0072B2'),
    (AT_THE_LIMITS, ''): ('at the limits', '#8CC4E8'),
    (OUT_OF_REACH, BELT): ('not: belt', '#F5E6C8'),
    (OUT_OF_REACH, WORKSPACE): ('not: workspace', '0.85'),
    (OUT_OF_REACH, EDGE): ("not: edge's end", '#E69F00'),
    (OUT_OF_REACH, SENSOR): ('not: sensor', '#CC79A7'),
    (OUT_OF_REACH, FRICTION): ('not: friction', '#D55E00'),
    (OUT_OF_REACH, CONTACT): ('not: contact', '0.55'),
}
MARKS = {'start': 'ko', 'goal': 'rx', 'nearest': 'r+'}


def plot_reachable(
    found: ReachableSet, marks: Mapping[str, tuple[float, float]], files: Sequence[Path]
) -> None:
    """Draw the set of reachable goals over x and theta.

    Parameters
    ----------
    found : ReachableSet
        What is known of a grid of goals.
    marks : mapping of str to tuple of float
        Places to mark, x [m] and theta [rad], under 'start', 'goal' and 'nearest'.
    files : sequence of Path
        Where to write; the ending chooses the format.
    """
    kinds = list(COLORS)
    values = np.array([[kinds.index(told) for told in row] for row in found.told])
    figure = new_figure(7.2, 4.2)
    axes = figure.subplots()
    axes.pcolormesh(
        MILLIMETRES * np.array(found.xs),
        np.degrees(found.thetas),
        values,
        cmap=ListedColormap([color for _, color in COLORS.values()]),
        vmin=-0.5,
        vmax=len(kinds) - 0.5,
        shading='nearest',
    )
    for name, (x, theta) in marks.items():
        axes.plot(MILLIMETRES * x, math.degrees(theta), MARKS[name], markersize=7, label=name)
    axes.set_xlabel('x of the centre of mass, from where the finger starts [mm]')
    axes.set_ylabel('θ of the edge [°]')
    there = [
        Patch(color=color, label=label)
        for kind, (label, color) in COLORS.items()
        if found.count(*kind)
    ]
    points = axes.get_legend_handles_labels()[0]
    figure.legend(handles=[*there, *points], loc='outside right upper', frameon=False)
    for file in files:
        figure.savefig(file, dpi=160)
