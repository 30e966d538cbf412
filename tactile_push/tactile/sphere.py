# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Azimuth and elevation as unit vectors in the axes of the finger tip, and back."""

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]


def directions_of(azimuth: npt.ArrayLike, elevation: npt.ArrayLike) -> Array:
    """Return the directions of azimuths and elevations.

    Parameters
    ----------
    azimuth, elevation : array_like
        Angles [rad] of one shape; elevation pi/2 is the pole.

    Returns
    -------
    ndarray
        Unit vectors in the axes of `fingertip`: x to the left, y up, z along the pole. They lie
        along a last axis of three.
    """
    a, e = np.asarray(azimuth, float), np.asarray(elevation, float)
    return np.stack([np.cos(e) * np.cos(a), np.cos(e) * np.sin(a), np.sin(e)], axis=-1)


def angles_of(directions: npt.ArrayLike) -> tuple[Array, Array]:
    """Return azimuth and elevation of directions.

    Parameters
    ----------
    directions : array_like, shape (..., 3)
        Unit vectors in the axes of `fingertip`.

    Returns
    -------
    tuple of ndarray
        Azimuth from -pi to pi, and elevation from -pi/2 to pi/2 [rad]; NaN where a direction is.
    """
    x, y, z = np.moveaxis(np.asarray(directions, float), -1, 0)
    return np.arctan2(y, x), np.arctan2(z, np.hypot(x, y))


def angles_between(one: npt.ArrayLike, other: npt.ArrayLike) -> Array:
    """Return the angles between unit vectors, exact for small ones too.

    Parameters
    ----------
    one, other : array_like, shape (..., 3)
        Unit vectors.

    Returns
    -------
    ndarray
        Angles from 0 to pi [rad].
    """
    u, v = np.asarray(one, float), np.asarray(other, float)
    return 2.0 * np.arctan2(np.linalg.norm(u - v, axis=-1), np.linalg.norm(u + v, axis=-1))
