# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Numbers that travel together through the compiled mechanics, as named tuples."""

from typing import NamedTuple

from tactile_push.mechanics.compiled import Array


class Pose(NamedTuple):
    """Position of an object's centre of mass and its orientation."""

    x: float  #: position [m]
    y: float  #: position [m]
    angle: float  #: orientation [rad], counterclockwise


class Body(NamedTuple):
    """A pushed object, as the disk of one finger meets it; `Slider.body` makes it."""

    path: Array  #: pieces of the path of the disk around the object, (M + 1, 8); see `Outline.path`
    c: float  #: ratio m_max / f_max of the limit surface [m]
    #: rows of an exact limit surface, see `ExactLimitSurface.points`; None for the ellipsoid
    support: Array | None


class Finger(NamedTuple):
    """The finger's disk and its friction with the object."""

    cos_alpha: float  #: of the friction cone, see `friction_cone`
    sin_alpha: float  #: the same
    r: float  #: radius of the disk [m]
