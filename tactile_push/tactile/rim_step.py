# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Where in an image the tip ends: the step of brightness near its rim, all around.

If the camera shifts, tilts or sinks in its mount, or the tip is one of another size, the step is no
more where the calibrated camera had it.
"""

import math

import cv2
import numpy as np
import numpy.typing as npt

from tactile_push.tactile.dome_camera import DomeCamera
from tactile_push.tactile.rim import SECTORS, UNSEEN
from tactile_push.tactile.sphere import Array, directions_of
from tactile_push.tactile.touched_region import MEDIAN, SMOOTHING

SAMPLES = 5  # of azimuth in a sector
SPACING = math.radians(0.5)  # of samples in elevation
FARTHEST = math.radians(12.0)  # from the rim where a step is looked for
SIDE = 6  # samples on each side of a step, whose means are compared
NEAR = math.radians(2.0)  # of the largest step: what counts for its place
LEAST_STEP = 8.0  # between the two means [levels]; picked


class RimStep:
    """Finds the step near the rim.

    Parameters
    ----------
    camera : DomeCamera
        The calibrated camera.
    """

    def __init__(self, camera: DomeCamera) -> None:
        count = SECTORS * SAMPLES
        around = (np.arange(count) + 0.5) * 2.0 * math.pi / count - math.pi
        elevations = np.arange(-FARTHEST, FARTHEST + 0.5 * SPACING, SPACING)
        at = np.rint(camera.pixels(directions_of(*np.meshgrid(around, elevations, indexing='ij'))))
        columns, rows = np.moveaxis(at, -1, 0)
        self._seen = (
            (columns >= 0) & (columns < camera.width) & (rows >= 0) & (rows < camera.height)
        )
        pixels = np.where(self._seen, rows * camera.width + columns, 0.0)
        self._pixels = pixels.astype(int)
        # Between the last sample of one side and the first one of the other.
        self._between = elevations[SIDE - 1 : -SIDE] + 0.5 * SPACING

    def elevations(self, image: npt.NDArray[np.float32]) -> tuple[float, ...]:
        """Find the step in each sector.

        Parameters
        ----------
        image : ndarray, shape (height, width)
            Image of the untouched tip [levels].

        Returns
        -------
        tuple of float
            Elevation at which the step is, in `SECTORS` from azimuth -pi on [rad]; `UNSEEN` where
            there is none.
        """
        smooth = cv2.blur(cv2.medianBlur(image, MEDIAN), (SMOOTHING, SMOOTHING))
        levels = np.where(self._seen, smooth.ravel()[self._pixels], np.nan)
        levels = levels.reshape(SECTORS, SAMPLES, -1).mean(axis=1)
        sums = np.cumsum(np.pad(levels, ((0, 0), (1, 0))), axis=1)
        means = (sums[:, SIDE:] - sums[:, :-SIDE]) / SIDE
        steps = np.nan_to_num(np.abs(means[:, SIDE:] - means[:, :-SIDE]))
        return tuple(map(self._place, steps))

    def _place(self, steps: Array) -> float:
        """Return the place of the largest step: the centroid of what is near."""
        largest = int(np.argmax(steps))
        if steps[largest] < LEAST_STEP:
            return UNSEEN
        near = np.abs(self._between - self._between[largest]) < NEAR
        weights = np.where(near, steps, 0.0) ** 4
        return float(weights @ self._between / weights.sum())
