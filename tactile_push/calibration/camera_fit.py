# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Fits the model of a camera in a hemispherical tip to touches at known places."""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt
from scipy.optimize import least_squares

from tactile_push.calibration.coverage import check_coverage
from tactile_push.calibration.residuals import rms
from tactile_push.tactile.dome_camera import DomeCamera
from tactile_push.tactile.sphere import Array, angles_between

# Distances of the camera from the dome's centre from which the fit starts [radii]: a narrow lens
# far below, a wide one, and a fisheye in the centre.
STARTS = (-2.5, -1.0, -0.3, 0.0)
LONGEST = 60  # evaluations; it takes 20 unless touches are exact
NEARLY = 1e-4  # change of the cost over it, from which on the fit is done
ROBUST = 0.01  # of the dome's size in the image: errors from which on touches count less
# How far a camera may be from the usual one: axis off the dome's middle [of its size in the image],
# tilt [rad], bend of the lens [of its slope], eye aside and along the pole [radii]. Touches decide;
# these only choose among cameras that explain the touches alike.
USUAL = np.array([0.5, 0.5, 0.2, 0.2, 0.5, 0.5, 0.3, 0.3, 2.0])
USUAL_EYE = -1.0  # along the pole [radii]
WEIGHT = 0.1  # of the usual camera, beside touches that are as good as `ROBUST`
MOST_TILT, MOST_ASIDE = 0.6, 0.6  # [rad], [radii]
NEAREST, FARTHEST = 0.5, -20.0  # of the eye, along the pole [radii]
LEAST_SLOPE, BEYOND_RIM = 0.1, 0.2  # of the lens over that on its axis, so far out [rad]
BAD_FIT = math.radians(3.0)  # RMS from which on touches and directions do not belong together


@dataclass(frozen=True)
class CameraFit:
    """A camera and how well it explains the touches."""

    camera: DomeCamera  #: the model
    errors: Array  #: angle between each touch's known direction and the model's [rad]

    @property
    def rms(self) -> float:
        """Root of the mean square of the errors [rad]."""
        return rms(self.errors)

    @property
    def largest(self) -> int:
        """Index of the touch with the largest error."""
        return int(np.argmax(self.errors))


def fit_camera(
    pixels: npt.ArrayLike, directions: npt.ArrayLike, width: int, height: int
) -> CameraFit:
    """Fit a camera to touches.

    Parameters
    ----------
    pixels : array_like, shape (n, 2)
        Column and row of each touch in the image [px].
    directions : array_like, shape (n, 3)
        Unit vectors to the touches, in the axes of the tip.
    width, height : int
        Size of the images [px].

    Returns
    -------
    CameraFit
        The camera and its errors. A touch at a wrong place hardly moves the model and stands out.

    Raises
    ------
    ValueError
        If touches are too few or badly spread, if their sense of rotation is that of a mirror, or
        if no camera explains them to `BAD_FIT`.
    """
    at, towards = np.asarray(pixels, float), np.asarray(directions, float)
    check_coverage(towards)
    fit = _fit(at, towards, width, height)
    if fit.rms > BAD_FIT:
        raise ValueError(
            f'touches: expected a camera that explains them to {math.degrees(BAD_FIT):g}° RMS, got '
            f'{math.degrees(fit.rms):.1f}°{_culprit(at, towards, width, height)}'
        )
    return fit


def _culprit(at: Array, towards: Array, width: int, height: int) -> str:
    """Return the touch without which the fit is best, in words; '' if it is not good then."""
    start = (USUAL_EYE,)  # alone, as there are many fits
    without = [
        _fit(np.delete(at, out, 0), np.delete(towards, out, 0), width, height, start).rms
        for out in range(len(at))
    ]
    best = int(np.argmin(without))
    if without[best] > BAD_FIT:
        return ''
    return f'; without touch {best + 1} it is {math.degrees(without[best]):.2f}°'


def _fit(
    at: Array, towards: Array, width: int, height: int, starts: tuple[float, ...] = STARTS
) -> CameraFit:
    """Return the best fit of those from several heights of the eye."""
    middle, turn = _flat_fit(at, towards)
    size = float(np.max(np.hypot(*(at - middle).T)))

    def camera(p: Array) -> DomeCamera:
        x, y, roll, *rest = p.tolist()
        rotation = math.remainder(roll, 2.0 * math.pi), rest[0], rest[1]
        radial, eye = (rest[2], rest[3], rest[4]), (rest[5], rest[6], rest[7])
        return DomeCamera(width, height, (x, y), rotation, radial, eye)

    def residuals(p: Array) -> Array:
        seen = (camera(p).pixels(towards) - at).ravel() / (ROBUST * size)
        bends = p[6:8] / p[5]
        unusual = [*(p[:2] - middle) / size, *p[3:5], *bends, *p[8:10], p[10] - USUAL_EYE]
        # The polynomial must not turn back before the rim, which no touch may reach.
        square = (math.atan2(1.0, -p[10]) + BEYOND_RIM) ** 2
        slope = 1.0 + square * (3.0 * bends[0] + 5.0 * square * bends[1])
        turns = max(LEAST_SLOPE - slope, 0.0) / ROBUST
        return np.concatenate([seen, WEIGHT * np.asarray(unusual) / USUAL, [turns]])

    def fit_from(height_of_eye: float) -> tuple[float, CameraFit]:
        at_rim = math.atan2(1.0, -height_of_eye)
        start = [*middle, turn, 0.0, 0.0, size / at_rim, 0.0, 0.0, 0.0, 0.0, height_of_eye]
        done = least_squares(residuals, start, max_nfev=LONGEST, **_how(size))
        found = camera(done.x)
        errors = angles_between(found.directions(at), towards)
        # A polynomial that turns back may image the touches well, but a pixel has no direction.
        cost = math.inf if np.isnan(errors).any() else done.cost
        return cost, CameraFit(found, np.where(np.isnan(errors), math.pi, errors))

    return min((fit_from(start) for start in starts), key=lambda fit: fit[0])[1]


def _how(size: float) -> dict[str, Any]:
    """Return steps, bounds and loss of the fit to a dome of a size in the image [px]."""
    free = np.inf
    steps = [0.1 * size, 0.1 * size, 0.3, 0.1, 0.1, 0.3 * size, 0.1 * size, 0.1 * size]
    upper = [free, free, free, MOST_TILT, MOST_TILT, free, free, free, MOST_ASIDE, MOST_ASIDE]
    lower = [-bound for bound in upper]
    lower[5] = 1e-3 * size  # the lens shows what is further off the axis further out
    bounds = [*lower, FARTHEST], [*upper, NEAREST]
    return {'x_scale': [*steps, 0.1, 0.1, 0.5], 'loss': 'soft_l1', 'bounds': bounds, 'ftol': NEARLY}


def _flat_fit(at: Array, towards: Array) -> tuple[Array, float]:
    """Return the middle of the dome and its roll, of a camera far away that looks along the pole.

    Seen like this the image is the tip's x and y, turned, scaled and shifted: one complex factor
    and one complex sum. Azimuths of the opposite sense make its complex conjugate.
    """
    image, tip = at[:, 0] + 1j * at[:, 1], towards[:, 0] + 1j * towards[:, 1]
    ones = np.ones_like(tip)
    (shift, factor), (error, *_), *_ = np.linalg.lstsq(np.stack([ones, tip], 1), image, rcond=None)
    _, (mirrored, *_), *_ = np.linalg.lstsq(np.stack([ones, tip.conj()], 1), image, rcond=None)
    if mirrored.real < error.real:
        raise ValueError(
            'touches: expected azimuths that grow from left over up to right as seen along the '
            'pole, got the opposite; either they are measured the other way round or the camera '
            'mirrors its image'
        )
    return np.array([shift.real, shift.imag]), -float(np.angle(factor))
