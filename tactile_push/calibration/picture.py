# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Pictures of a calibration: the touches, and how far each is off."""

import math
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Circle

from tactile_push.calibration.residuals import rms
from tactile_push.calibration.touch_table import KnownTouch
from tactile_push.figures.style import (
    BLUE,
    GREY,
    ONE_COLUMN,
    ORANGE,
    RED,
    TWO_COLUMNS,
    new_figure,
    styled,
)
from tactile_push.tactile.sphere import Array, directions_of

if TYPE_CHECKING:
    from tactile_push.calibration.camera_calibration import CameraCalibration
    from tactile_push.calibration.wrench_fit import TipFit
    from tactile_push.tactile.touched_region import Reference

RINGS = (0.0, 30.0, 60.0)  # elevations that are drawn [degrees]
LONGEST = 25.0  # of the arrow of the largest error [degrees of the drawing]


@styled
def draw_camera(calibration: 'CameraCalibration', reference: 'Reference', file: Path) -> None:
    """Draw the touches in the image, and their errors.

    Parameters
    ----------
    calibration : CameraCalibration
        The calibration.
    reference : ndarray, shape (height, width)
        Image of the untouched tip.
    file : Path
        Where to write; the ending chooses the format.
    """
    camera = calibration.fit.camera
    known = _directions(calibration.touches)
    figure = new_figure(TWO_COLUMNS, 0.42 * TWO_COLUMNS)
    image, errors = figure.subplots(1, 2)
    image.imshow(reference, cmap='gray', vmin=0.0, vmax=255.0)
    around = np.linspace(-math.pi, math.pi, 181)
    for elevation in RINGS:
        ring = camera.pixels(directions_of(around, np.full_like(around, math.radians(elevation))))
        image.plot(*ring.T, color=ORANGE, linewidth=0.6)
    image.plot(*camera.pixels(known).T, '+', color='white', markersize=7, label='known')
    image.plot(*calibration.pixels.T, 'x', color=RED, markersize=4, label='seen')
    image.set_xlim(0, camera.width)
    image.set_ylim(camera.height, 0)
    image.set_xlabel('column [px]')
    image.set_ylabel('row [px]')
    image.legend(loc='upper right', labelcolor='white')
    _draw_errors(errors, known, camera.directions(calibration.pixels), calibration.fit.errors)
    figure.savefig(file)


@styled
def draw_tip(fit: 'TipFit', touches: Sequence[KnownTouch], file: Path) -> None:
    """Draw the errors of touches on a force/torque sensor.

    Parameters
    ----------
    fit : TipFit
        The calibration.
    touches : sequence of KnownTouch
        The touches.
    file : Path
        Where to write; the ending chooses the format.
    """
    figure = new_figure(ONE_COLUMN, ONE_COLUMN)
    _draw_errors(figure.subplots(), _directions(touches), fit.found, fit.errors)
    figure.savefig(file)


def _draw_errors(axes: Axes, known: Array, found: Array, errors: Array) -> None:
    """Draw on a map of the tip an arrow from each touch towards where it was found."""
    size, largest = math.degrees(rms(errors)), math.degrees(errors.max())
    scale = LONGEST / max(largest, 1e-9)
    start = _flat(known)
    way = scale * (_flat(found) - start)
    for elevation in RINGS:
        axes.add_patch(Circle((0.0, 0.0), 90.0 - elevation, fill=False, color=GREY, linewidth=0.5))
    axes.quiver(*start.T, *way.T, angles='xy', scale_units='xy', scale=1.0, color=RED, width=0.004)
    axes.plot(*start.T, '.', color=BLUE, markersize=3)
    axes.set_aspect('equal')
    axes.set_xlim(100.0, -100.0)  # left is to the left, as seen along the pole
    axes.set_ylim(-100.0, 100.0)
    axes.set_xlabel('from the pole to the left [°]')
    axes.set_ylabel('from the pole up [°]')
    for set_ticks in (axes.set_xticks, axes.set_yticks):
        set_ticks(range(-90, 91, 30))
    axes.set_title(f'errors × {scale:.3g}: RMS {size:.2f}°, largest {largest:.2f}°')


def _directions(touches: Sequence[KnownTouch]) -> Array:
    azimuths = [touch.azimuth for touch in touches]
    return directions_of(azimuths, [touch.elevation for touch in touches])


def _flat(directions: Array) -> Array:
    """Return directions on a map with the pole in its middle and true angles from it [degrees]."""
    x, y, z = directions.T
    across = np.hypot(x, y)
    scale = np.degrees(np.arctan2(across, z)) / np.maximum(across, 1e-12)
    return np.stack([x * scale, y * scale], axis=-1)
