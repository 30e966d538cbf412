# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Fits centre and radius of a hemispherical tip to wrenches of touches at known places.

A contact at p + R n, where the tip's centre p and its radius R are unknown and its normal n is
known, has the moment p × f + R n × f about the sensor, and any torsion along n. Across n this is
linear in p and R. A force along n tells p alone; R shows only if the tip is pushed sideways, too.
"""

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from tactile_push.calibration.coverage import check_coverage
from tactile_push.calibration.residuals import rms
from tactile_push.tactile import contact_of_wrench
from tactile_push.tactile.sphere import Array, angles_between

UNKNOWNS = 4
BAD_FIT = math.radians(3.0)  # RMS from which on touches and places do not belong together
MOST_UNCERTAIN = 0.1  # standard deviation of the radius over it
PUSHING = 0.9  # share of the touches whose force has the usual sign, or the opposite


@dataclass(frozen=True)
class TipFit:
    """A tip on its sensor, and how well it explains the touches."""

    centre: (
        Array  #: of the hemisphere from the sensor's origin, in the sensor's axes, shape (3,) [m]
    )
    radius: float  #: of the hemisphere [m]
    radius_deviation: float  #: standard deviation of it [m]
    reaction: bool  #: whether the sensor tells what the tip exerts
    found: Array  #: directions in which the touches are found, in the axes of the tip, shape (n, 3)
    errors: Array  #: angle between each touch's known direction and that [rad]

    @property
    def rms(self) -> float:
        """Root of the mean square of the errors [rad]."""
        return rms(self.errors)

    @property
    def largest(self) -> int:
        """Index of the touch with the largest error."""
        return int(np.argmax(self.errors))


def fit_tip(
    forces: npt.ArrayLike, moments: npt.ArrayLike, directions: npt.ArrayLike, axes: npt.ArrayLike
) -> TipFit:
    """Fit centre and radius of the tip.

    Parameters
    ----------
    forces, moments : array_like, shape (n, 3)
        Tared wrench of each touch, in the sensor's axes and about its origin [N, N m].
    directions : array_like, shape (n, 3)
        Unit vectors from the tip's centre to the touches, in the axes of the tip.
    axes : array_like, shape (3, 3)
        The tip's axes in the sensor's frame, as columns.

    Returns
    -------
    TipFit
        The tip and its errors.

    Raises
    ------
    ValueError
        If touches are too few or badly spread, if none pushes sideways, or if no tip explains them
        to `BAD_FIT`.
    """
    check_coverage(directions)
    normals = np.asarray(directions, float) @ np.asarray(axes, float).T
    f, m = np.asarray(forces, float), np.asarray(moments, float)
    pressing = np.mean(np.sum(f * normals, axis=1) < 0.0)
    if not (pressing >= PUSHING or pressing <= 1.0 - PUSHING):
        raise ValueError(
            f'touches: expected forces that press on the tip, got {pressing:.0%} of them; check '
            'the places and the orientation of the tip'
        )
    reaction = bool(pressing < 0.5)
    if reaction:
        f, m = -f, -m
    equations, known = _equations(f, m, normals)
    solution, *_ = np.linalg.lstsq(equations, known, rcond=None)
    centre, radius = np.asarray(solution[:3], np.float64), float(solution[3])
    misfit = known - equations @ solution
    free = 2 * len(f) - UNKNOWNS  # two of each three equations are independent
    covariance = np.linalg.pinv(equations.T @ equations) * float(misfit @ misfit) / free
    deviation = math.sqrt(covariance[3, 3])
    if not 0.0 < deviation <= MOST_UNCERTAIN * radius:  # 0 if nothing at all tells it
        raise ValueError(
            'touches: expected some that push sideways as well, which tell the radius, got '
            f'{1e3 * radius:.1f} ± {1e3 * deviation:.1f} mm'
        )
    wrenches = zip(f, m, strict=True)
    found = np.array([contact_of_wrench(*wrench, centre, radius).normal for wrench in wrenches])
    errors = angles_between(found, normals)
    fit = TipFit(centre, radius, deviation, reaction, found @ np.asarray(axes, float), errors)
    if fit.rms > BAD_FIT:
        raise ValueError(
            f'touches: expected a tip that explains them to {math.degrees(BAD_FIT):g}° RMS, got '
            f'{math.degrees(fit.rms):.1f}°; touch {fit.largest + 1} is off most'
        )
    return fit


def _equations(f: Array, m: Array, normals: Array) -> tuple[Array, Array]:
    """Return the equations across each normal, of forces of 1 N; a lever each, as the residual."""
    rows, known = [], []
    for force, moment, normal in zip(f, m, normals, strict=True):
        across = (np.eye(3) - np.outer(normal, normal)) / np.linalg.norm(force)
        columns = [np.cross(axis, force) for axis in np.eye(3)] + [np.cross(normal, force)]
        rows.append(across @ np.stack(columns, axis=1))
        known.append(across @ moment)
    return np.concatenate(rows), np.concatenate(known)
