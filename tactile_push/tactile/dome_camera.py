# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The model of a camera that sees a hemispherical tip from inside.

The camera looks from `eye`, in radii of the dome from its centre. A point of the dome in direction
u from the centre lies in direction u - eye from there, at an angle alpha off the optical axis, and
its image lies at a distance

    a1 alpha + a3 alpha^3 + a5 alpha^5

from the image of the axis. This is the polynomial of a lens, wide or narrow, and takes in a gel or
a window that bends the rays alike all around. An eye off the tip's axis, or one that looks past the
pole, makes an image that is not alike all around; the eye and the rotation account for that.
"""

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from tactile_push.tactile.sphere import Array

POWERS = (1, 3, 5)  # of the angle off the axis, in the polynomial
WIDEST = 2.0  # angle off the axis that a lens may show [rad]
STEPS = 30  # of Newton's method, which takes five unless it starts far off
EXACT = 1e-10  # [rad]


@dataclass(frozen=True)
class DomeCamera:
    """A camera within the tip, and how the tip looks in its images."""

    width: int  #: of the images [px]
    height: int  #: of the images [px]
    #: where the optical axis meets the image [px], from the middle of the upper left pixel
    centre: tuple[float, float]
    #: roll and two tilts [rad]. Untilted, the image's right has the azimuth `roll`; then the camera
    #: is turned about the image's right and about its lower edge
    rotation: tuple[float, float, float]
    radial: tuple[float, float, float]  #: a1, a3, a5 [px/rad, px/rad^3, px/rad^5]
    #: from where it looks, in radii of the dome from its centre, in the axes of the tip
    eye: tuple[float, float, float]

    @property
    def axes(self) -> Array:
        """The image's right, its lower edge and the optical axis in the tip's axes, as rows."""
        roll, right, down = self.rotation
        turned = np.array(
            [
                [math.cos(roll), math.sin(roll), 0.0],
                [-math.sin(roll), math.cos(roll), 0.0],
                [0.0, 0.0, 1.0],
            ]
        )
        angle = math.hypot(right, down)
        if angle == 0.0:
            return turned
        x, y = right / angle, down / angle
        cross = np.array([[0.0, 0.0, y], [0.0, 0.0, -x], [-y, x, 0.0]])
        tilt = np.eye(3) + math.sin(angle) * cross + (1.0 - math.cos(angle)) * cross @ cross
        return tilt.T @ turned

    def pixels(self, directions: npt.ArrayLike) -> Array:
        """Compute where points of the dome appear in the image.

        Parameters
        ----------
        directions : array_like, shape (..., 3)
            Unit vectors from the dome's centre, in the axes of the tip.

        Returns
        -------
        ndarray, shape (..., 2)
            Column and row [px].
        """
        x, y, z = np.moveaxis((np.asarray(directions, float) - self.eye) @ self.axes.T, -1, 0)
        across = np.hypot(x, y)
        alpha = np.arctan2(across, z)
        a1 = self.radial[0]
        scale = np.divide(
            self._radius(alpha), across, out=np.full_like(across, a1), where=across > 0.0
        )
        return np.stack([x * scale + self.centre[0], y * scale + self.centre[1]], axis=-1)

    def directions(self, pixels: npt.ArrayLike) -> Array:
        """Compute which points of the sphere appear in places of the image.

        Parameters
        ----------
        pixels : array_like, shape (..., 2)
            Column and row [px].

        Returns
        -------
        ndarray, shape (..., 3)
            Unit vectors from the dome's centre, in the axes of the tip; NaN where the camera sees
            past the sphere. Points below the rim have a negative last component.
        """
        x, y = np.moveaxis(np.asarray(pixels, float) - self.centre, -1, 0)
        radius = np.hypot(x, y)
        alpha = self._angle(radius)
        scale = np.divide(np.sin(alpha), radius, out=np.zeros_like(radius), where=radius > 0.0)
        rays = np.stack([x * scale, y * scale, np.cos(alpha)], axis=-1) @ self.axes
        eye = np.asarray(self.eye)
        along = rays @ eye
        square = along**2 - (eye @ eye - 1.0)
        far = -along + np.sqrt(np.where(square >= 0.0, square, math.nan))
        return eye + np.where(far > 0.0, far, math.nan)[..., None] * rays

    def solid_angle(self, x: float, y: float) -> float:
        """Compute how much of the dome a pixel shows.

        Parameters
        ----------
        x, y : float
            Column and row [px].

        Returns
        -------
        float
            Solid angle from the dome's centre [sr]; NaN past the sphere.
        """
        left, right, above, below = self.directions(
            [(x - 0.5, y), (x + 0.5, y), (x, y - 0.5), (x, y + 0.5)]
        )
        return float(np.linalg.norm(np.cross(right - left, below - above)))

    def dome(self) -> npt.NDArray[np.bool_]:
        """Find the pixels that show the dome down to its rim.

        Returns
        -------
        ndarray of bool, shape (height, width)
            True on the dome.
        """
        rows, columns = np.mgrid[: self.height, : self.width]
        return self.directions(np.stack([columns, rows], axis=-1))[..., 2] >= 0.0

    def _radius(self, alpha: Array) -> Array:
        a1, a3, a5 = self.radial
        square = alpha * alpha
        return alpha * (a1 + square * (a3 + square * a5))

    def _angle(self, radius: Array) -> Array:
        """Return the angle off the axis at a distance from its image; NaN where there is none."""
        a1, a3, a5 = self.radial
        limit = self._limit()
        alpha = np.minimum(radius / a1, limit)
        for _ in range(STEPS):
            square = alpha * alpha
            slope = np.maximum(a1 + square * (3.0 * a3 + 5.0 * square * a5), 1e-3 * a1)
            step = (self._radius(alpha) - radius) / slope
            alpha = np.clip(alpha - step, 0.0, limit)
            if np.all(np.abs(step) < EXACT):
                break
        return np.where(radius <= self._radius(np.asarray(limit)), alpha, math.nan)

    def _limit(self) -> float:
        """Return up to which angle off the axis the polynomial grows [rad], `WIDEST` at most."""
        a1, a3, a5 = self.radial
        # With s = alpha^2, its slope a1 + 3 a3 s + 5 a5 s^2 is 0 first at s = 2 a1 over this.
        square = 9.0 * a3 * a3 - 20.0 * a1 * a5
        turn = math.sqrt(square) - 3.0 * a3 if square >= 0.0 else 0.0
        return min(WIDEST, math.sqrt(2.0 * a1 / turn)) if turn > 0.0 else WIDEST
