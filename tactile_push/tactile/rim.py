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
UNSEEN = math.pi / 2.0  # in place of an elevation at which there is no step
# Angle by which the step at the rim may be off, in the median of the sectors; picked. Noise and
# defocus leave a tenth of it.
MOVED = math.radians(1.0)


@dataclass(frozen=True)
class RimProfile:
    """How the rim looks, in `SECTORS` from azimuth -pi on, counted in its sense."""

    levels: tuple[float, ...]  #: brightness along it [levels]
    #: where the tip ends in the image [rad]: 0 as the camera has it, `UNSEEN` where it is not seen;
    #: empty if nobody looked
    elevations: tuple[float, ...] = ()

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
        return self._other_pattern(now) or self._other_place(now)

    def _other_place(self, now: 'RimProfile') -> str:
        before, after = np.array(self.elevations), np.array(now.elevations)
        known = before < UNSEEN
        if not (before.size == after.size and 2 * np.count_nonzero(known) >= SECTORS):
            return ''
        both = known & (after < UNSEEN)
        if 2 * np.count_nonzero(both) < np.count_nonzero(known):
            return 'the rim is not seen where it was calibrated: another tip or camera'
        off = float(np.median(np.abs(after[both] - before[both])))
        if off <= MOVED:
            return ''
        return (
            f'the rim is {math.degrees(off):.1f}° off its place in the calibration: another tip, '
            'or the camera has moved'
        )

    def _other_pattern(self, now: 'RimProfile') -> str:
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
        from tactile_push.tactile.rim_step import RimStep  # needs OpenCV

        self._step = RimStep(camera)
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
            The median in each sector, 0 in one that the image does not show, and where the tip
            ends.
        """
        parts = np.split(image.ravel()[self._pixels], self._ends)
        levels = tuple(float(np.median(part)) if part.size else 0.0 for part in parts)
        return RimProfile(levels, self._step.elevations(image))


def _has_pattern(levels: Array) -> bool:
    return float(np.std(levels)) > LEAST_PATTERN * max(float(np.mean(levels)), 1.0)
