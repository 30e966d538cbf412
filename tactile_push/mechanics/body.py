# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Numbers that travel together through the compiled mechanics, as named tuples."""

from typing import NamedTuple

from tactile_push.mechanics.compiled import Array


class Pose(NamedTuple):
    """Position of an object's centre of mass and its orientation.

    Parameters
    ----------
    x, y : float
        Position [m].
    angle : float
        Orientation [rad], counterclockwise.
    """

    x: float
    y: float
    angle: float


class Body(NamedTuple):
    """A pushed object, as the disk of one finger meets it; `Slider.body` makes it.

    Parameters
    ----------
    path : ndarray, shape (M + 1, 8)
        Pieces of the path of the disk's centre around the object, see `Outline.path`.
    c : float
        Ratio m_max / f_max of the limit surface [m].
    support : ndarray, shape (3, N), or None
        Support points (x, y, load) of the exact limit surface, in the object's frame [m, m];
        None for the ellipsoid.
    """

    path: Array
    c: float
    support: Array | None


class Finger(NamedTuple):
    """The finger's disk and its friction with the object.

    Parameters
    ----------
    cos_alpha, sin_alpha : float
        The friction cone, see `friction_cone`.
    r : float
        Radius of the disk [m].
    """

    cos_alpha: float
    sin_alpha: float
    r: float
