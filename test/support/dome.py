# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""A small hemispherical tip with a fisheye in its centre, and images of it drawn by hand.

Seen from its centre, an angle from the pole is a distance from the image's middle, so that where a
spot of light has to be needs no camera's mathematics.
"""

import math

import numpy as np

from tactile_push.tactile.dome_camera import DomeCamera

WIDTH, HEIGHT = 160, 120
SLOPE = 36.0  # [px/rad], so that the rim's radius is 56.5 px
CENTRE = (80.0, 60.0)
CAMERA = DomeCamera(
    *(WIDTH, HEIGHT, CENTRE, (math.pi, 0.0, 0.0), (SLOPE, 0.0, 0.0), (0.0, 0.0, 0.0))
)
ROWS, COLUMNS = np.mgrid[:HEIGHT, :WIDTH].astype(float)
_X, _Y = COLUMNS - CENTRE[0], ROWS - CENTRE[1]
AROUND = np.arctan2(-_Y, -_X)  # azimuth: 0 to the left, a right angle up
ON_DOME = np.hypot(_X, _Y) <= SLOPE * math.pi / 2.0


class DomePainter:
    """Paints images one after the other, each with noise of its own [levels]."""

    def __init__(self, seed=0, noise=3.0):
        self._random = np.random.default_rng(seed)
        self._noise = noise

    def image(
        self, azimuth=math.nan, elevation=math.nan, skin=90.0, add=80.0, turned=0.0, size=9.0
    ):
        """Return an image of a tip that is touched at a place [rad], or of one that is not.

        `skin` is its brightness, `add` what a touch adds to it, `size` a touch's radius [px].
        """
        pattern = 1.0 + 0.2 * np.cos(AROUND - turned) + 0.1 * np.cos(3.0 * (AROUND - turned))
        levels = np.where(ON_DOME, skin * pattern, 5.0)
        if not math.isnan(azimuth):
            x, y = place(azimuth, elevation)
            square = 1.0 - ((COLUMNS - x) ** 2 + (ROWS - y) ** 2) / size**2
            levels = levels + np.where(ON_DOME, add * np.sqrt(np.maximum(square, 0.0)), 0.0)
        levels = levels + self._noise * self._random.standard_normal(levels.shape)
        return np.clip(np.rint(levels), 0, 255).astype(np.uint8)


def place(azimuth, elevation):
    """Return column and row of a place on the tip."""
    radius = SLOPE * (math.pi / 2.0 - elevation)
    return CENTRE[0] - radius * math.cos(azimuth), CENTRE[1] - radius * math.sin(azimuth)


def parameters(**others):
    """Return the parameters that describe the camera to `camera_sensor`."""
    return {
        'image_width': WIDTH,
        'image_height': HEIGHT,
        'centre': list(CENTRE),
        'rotation': list(CAMERA.rotation),
        'radial': list(CAMERA.radial),
        'eye': list(CAMERA.eye),
        **others,
    }
