# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""How the rim of a tip looks all around, by which a camera that was turned is recognised.

Lamps light a tip unevenly. If the camera is turned in its mount, or the images are, the pattern
along the rim turns with it; another tip has another pattern. A tip that looks the same all around
has none, and then nobody can tell.
"""

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from tactile_push.tactile.dome_camera import DomeCamera
from tactile_push.tactile.sphere import Array, angles_of

SECTORS = 72  # of the azimuth, 5 degrees each
BAND = (math.radians(3.0), math.radians(25.0))  # elevation above the rim
LEAST_PATTERN = 0.04  # standard deviation over mean, below which the rim looks the same all around
# Correlations of patterns. Lamps age and dust settles: the pattern of the same tip stays above
# `SAME`. Turned, it falls below, and is found again at another azimuth.
SAME, FOUND_AGAIN = 0.9, 0.95


@dataclass(frozen=True)
class RimProfile:
    """Brightness along the rim."""

    levels: tuple[float, ...]  #: in `SECTORS` from azimuth -pi on, counted in its sense [levels]

    def difference(self, now: 'RimProfile') -> str:
        """Compare with the rim as it looks now.

        Parameters
        ----------
        now : RimProfile
            The rim in other images.

        Returns
        -------
        str
            What is different, for people; '' if it is the same rim, or one without a pattern.
        """
        before, after = np.asarray(self.levels), np.asarray(now.levels)
        if not _has_pattern(before):
            return ''
        if not _has_pattern(after):
            return 'the rim does not look as calibrated: all alike around'
        found = [float(np.corrcoef(np.roll(before, turn), after)[0, 1]) for turn in range(SECTORS)]
        if found[0] >= SAME:
            return ''
        best = int(np.argmax(found))
        if found[best] < FOUND_AGAIN:
            return f'the rim does not look as calibrated: correlation {found[0]:.2f}'
        turned = math.remainder(best * 360.0 / SECTORS, 360.0)
        return f'the image is turned by {turned:.0f}° against the calibration'


class Rim:
    """Measures the brightness along the rim.

    Parameters
    ----------
    camera : DomeCamera
        The calibrated camera.
    """

    def __init__(self, camera: DomeCamera) -> None:
        rows, columns = np.mgrid[: camera.height, : camera.width]
        azimuth, elevation = angles_of(camera.directions(np.stack([columns, rows], axis=-1)))
        band = np.flatnonzero((elevation >= BAND[0]) & (elevation <= BAND[1]))
        turn = (azimuth.ravel()[band] + math.pi) / (2.0 * math.pi)
        sector = (turn * SECTORS).astype(int) % SECTORS
        order = np.argsort(sector, kind='stable')
        self._pixels = band[order]
        self._ends = np.searchsorted(sector[order], np.arange(1, SECTORS))

    def profile(self, image: npt.NDArray[np.float32]) -> RimProfile:
        """Measure the brightness along the rim.

        Parameters
        ----------
        image : ndarray, shape (height, width)
            Image of the untouched tip [levels].

        Returns
        -------
        RimProfile
            The median in each sector; 0 in one that the image does not show.
        """
        parts = np.split(image.ravel()[self._pixels], self._ends)
        return RimProfile(tuple(float(np.median(part)) if part.size else 0.0 for part in parts))


def _has_pattern(levels: Array) -> bool:
    return float(np.std(levels)) > LEAST_PATTERN * max(float(np.mean(levels)), 1.0)
