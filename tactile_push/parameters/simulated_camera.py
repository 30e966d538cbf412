# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The camera in the simulated finger tip, and how `camera_sensor` has to be calibrated for it."""

import math
from typing import TYPE_CHECKING, Any

from tactile_push.parameters.camera_sensor import NO_RIM

if TYPE_CHECKING:
    from tactile_push.simulation.dome_image import DomeView

WIDTH, HEIGHT = 320, 240  # [px]
FOCAL_LENGTH = 130.0  # of a fisheye [px], so that the dome fills the image
EYE = (0.0, 0.0, -1.0)  # opposite the pole [radii]

# The lens images an angle alpha at 2 f sin(alpha / 2), of which this is the series.
CALIBRATION: dict[str, Any] = {
    'image_width': WIDTH,
    'image_height': HEIGHT,
    'centre': [(WIDTH - 1) / 2.0, (HEIGHT - 1) / 2.0],
    'rotation': [math.pi, 0.0, 0.0],
    'radial': [FOCAL_LENGTH, -FOCAL_LENGTH / 24.0, FOCAL_LENGTH / 1920.0],
    'eye': list(EYE),
    'reach': math.pi / 2.0,
    'rim': NO_RIM,
    'rim_elevations': NO_RIM,
}


def dome_view(noise: float) -> 'DomeView':
    """Return what the camera sees, with a noise in parts of the brightest level."""
    from tactile_push.simulation.dome_image import DomeView  # needs OpenCV

    return DomeView(WIDTH, HEIGHT, focal_length=FOCAL_LENGTH, eye=EYE, noise=noise)
