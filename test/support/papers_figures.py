# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The paper's figures for their tests, and what these have in common."""

import math

import numpy as np

from tactile_push.figures import (
    gain_figure,
    limit_surface_figure,
    motion_cone_figure,
    section_figure,
    settling_figure,
    slow_mode_figure,
    step_response_figure,
    trajectory_figure,
)

MAKERS = {
    2: limit_surface_figure,
    3: motion_cone_figure,
    6: section_figure,
    7: trajectory_figure,
    8: step_response_figure,
    'gains': gain_figure,
    'slow_mode': slow_mode_figure,
    'settling': settling_figure,
}
FILES = {figure: f'figure_{figure}' if isinstance(figure, int) else figure for figure in MAKERS}
BLOCK = 5.0, 4.75  # cm


def block_points(count=400):
    """Return the midpoints of a fine grid on the block [cm]."""
    x, y = (side * ((np.arange(count) + 0.5) / count - 0.5) for side in BLOCK)
    return [axis.ravel() for axis in np.meshgrid(x, y)]


C_UNI = np.hypot(*block_points()).mean()
C_UNI_SQUARE = 5.0 * (math.sqrt(2.0) + math.asinh(1.0)) / 6.0  # mean distance in a square [cm]


def lines_by_label(axes):
    """Return the lines of a panel by their labels."""
    return {line.get_label(): line for line in axes.get_lines()}


def cross(a, b):
    """Return the cross product in the plane."""
    return a[0] * b[1] - a[1] * b[0]
