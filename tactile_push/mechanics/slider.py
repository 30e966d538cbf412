# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""An object that slides on its support when it is pushed: outline and limit surface together."""

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from tactile_push.mechanics.body import Body, Finger, Pose
from tactile_push.mechanics.compiled import Array
from tactile_push.mechanics.contact import TOUCH, clearance
from tactile_push.mechanics.friction import check_friction, friction_cone
from tactile_push.mechanics.limit_surface import (
    EllipsoidalLimitSurface,
    ExactLimitSurface,
    summed_friction,
)
from tactile_push.mechanics.outline import Outline
from tactile_push.mechanics.push import move_finger
from tactile_push.mechanics.support import Support

UNBALANCED = 0.02  # how far loads may be off, as by two digits of a file [c]
OVERHANG = 1e-6  # how far a support point may stick out, by rounding [length of the outline]


@dataclass(frozen=True, eq=False)
class Slider:
    """An object that slides on its support.

    Raises
    ------
    ValueError
        If `c` is not positive and finite, as when all support is in one place, or the points are
        not finite rows.
    """

    outline: Outline  #: its origin at the centre of mass (or of friction, at rest)
    c: float  #: ratio m_max / f_max of the limit surface [m]
    #: rows of an exact limit surface, see `ExactLimitSurface.points`; None for the ellipsoid
    points: Array | None = None

    def __post_init__(self) -> None:
        if not (math.isfinite(self.c) and self.c > 0.0):
            raise ValueError(f'c: expected a positive length m_max / f_max [m], got {self.c}')
        if self.points is not None:
            points = np.ascontiguousarray(self.points, dtype=float)  # or the sums would be slow
            if points.ndim != 2 or len(points) not in (3, 5) or not np.isfinite(points).all():
                raise ValueError(
                    'points: expected finite rows x, y, load, and two more or none of the growth '
                    f'of loads, got {self.points!r}'
                )
            object.__setattr__(self, 'points', points)

    @classmethod
    def on(
        cls,
        outline: Outline,
        support: Support,
        *,
        exact: bool = False,
        tilt: float = 0.0,
        centre_of_mass: tuple[float, float] | None = None,
    ) -> 'Slider':
        """Put an object on its support.

        Parameters
        ----------
        outline : Outline
            The outline.
        support : Support
            What the object rests on, in the frame of the outline.
        exact : bool, optional
            Whether the limit surface is the exact one of the support's points instead of the
            ellipsoid of its c.
        tilt : float, optional
            mu_s times the height of the push above the support [m], see `ExactLimitSurface`; 0 for
            the ellipsoid.
        centre_of_mass : tuple of float, optional
            Centre of mass (x, y) [m], if it is known and mu_s is even: the loads must carry the
            weight there, as those of `Support.carrying` do. The motion depends on the loads alone.

        Returns
        -------
        Slider
            The object; its origin is the centre of friction at rest.

        Raises
        ------
        ValueError
            If support points lie outside the outline or all in one place, or the loads do not
            balance about the centre of mass. If the push may lift a support
            point off the ground, or is above an ellipsoid's.
        """
        loaded = support.points[support.loads > 0.0]
        beyond = ~outline.contains(loaded, OVERHANG * outline.length)
        if beyond.any():
            raise ValueError(
                f'support: expected points under the object, got {loaded[beyond][0]} m outside'
            )
        if tilt != 0.0 and not exact:
            raise ValueError(f'tilt: expected 0 m for the ellipsoid, got {tilt} m')
        surface = ExactLimitSurface(support, tilt)
        if centre_of_mass is not None:
            _check_weight(support, centre_of_mass)
        return cls(outline.about(*support.centre), support.c, surface.points if exact else None)

    def wrench(self, twist: npt.ArrayLike) -> Array:
        """Compute what keeps a motion going, as a share of f_max.

        Parameters
        ----------
        twist : array_like, shape (3,)
            Velocity (v_x, v_y, omega) [m/s, m/s, rad/s] of the origin in the object's axes, not
            zero.

        Returns
        -------
        ndarray, shape (3,)
            Force and moment by f_max (f_x, f_y, m) [1, 1, m].

        Raises
        ------
        ValueError
            If the twist is zero.
        """
        if self.points is None:
            return EllipsoidalLimitSurface(1.0, self.c).wrench(twist)
        return summed_friction(self.points, twist) / self.points[2].sum()

    def body(self, r: float) -> Body:
        """Return the object as the compiled functions take it.

        Parameters
        ----------
        r : float
            Radius of the finger's disk [m].

        Returns
        -------
        Body
            The object.

        Raises
        ------
        ValueError
            If the radius is not positive and finite.
        """
        return Body(self.outline.path(r), self.c, self.points)

    def pushed(
        self,
        pose: Pose,
        start: tuple[float, float],
        end: tuple[float, float],
        mu_c: float,
        r: float,
        turn: float = 0.0,
    ) -> Pose:
        """Predict where the object ends when a finger moves straight from one place to another.

        Parameters
        ----------
        pose : Pose
            Pose of the object at the start, its origin being that of the outline.
        start, end : tuple of float
            Centre of the finger's disk (x, y) at both ends of its way [m].
        mu_c : float
            Coefficient of friction between finger and object, 0 to infinity.
        r : float
            Radius of the finger's disk [m].
        turn : float, optional
            By how much the disk turns on its way [rad].

        Returns
        -------
        Pose
            Pose of the object at the end.

        Raises
        ------
        ValueError
            If finger and object overlap at the start, or a number is out of its range.
        """
        check_friction(mu_c)
        numbers = (*pose, *start, *end, turn)
        if not all(map(math.isfinite, numbers)):
            raise ValueError(f'pose, start, end, turn: expected finite numbers, got {numbers}')
        body = self.body(r)
        pose = Pose(*map(float, pose))
        sigma, gap = clearance(pose, *start, body.path, r)
        if gap < -OVERHANG * self.outline.length:
            raise ValueError(f'start: expected a finger clear of the object, got a gap of {gap} m')
        way = end[0] - start[0], end[1] - start[1]
        cos_alpha, sin_alpha = friction_cone(mu_c)
        finger = Finger(cos_alpha, sin_alpha, r)
        pose, _, _, _ = move_finger(
            pose, sigma, gap <= TOUCH, *start, *way, 1.0, body, finger, float(turn)
        )
        return pose


def _check_weight(support: Support, centre_of_mass: tuple[float, float]) -> None:
    """Refuse loads that statics forbids: they do not carry the weight where it is."""
    if not np.isfinite(centre_of_mass).all():
        raise ValueError(f'centre_of_mass: expected a finite point [m], got {centre_of_mass}')
    if not math.dist(support.centre, centre_of_mass) <= UNBALANCED * support.c:
        x, y = (round(value, 6) + 0.0 for value in support.centre)
        raise ValueError(
            f'support: expected loads that carry a weight at {centre_of_mass} m, got loads about '
            f'({x}, {y}) m'
        )
