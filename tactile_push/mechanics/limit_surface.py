# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Limit surfaces of a sliding object (Section II.B): the paper's ellipsoid and the exact one."""

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from tactile_push.mechanics.compiled import Array
from tactile_push.mechanics.exact_motion import (
    STANDSTILL,
    exact_slipping,
    next_guess,
    pushing_force,
)
from tactile_push.mechanics.support import Support

ROUNDING = 1e-9  # of a load that just vanishes, as a share of it
ONE_PLACE = 1e-12  # of the support's places, relative to their distance from the origin


@dataclass(frozen=True)
class EllipsoidalLimitSurface:
    """The ellipsoid (3) that stands for the limit surface.

    Raises
    ------
    ValueError
        If one of them is not positive and finite.

    References
    ----------
    K. M. Lynch, H. Maekawa and K. Tanie, "Manipulation and active sensing by pushing using
    tactile feedback", IROS 1992, eqs. (1) to (5).
    R. D. Howe and M. R. Cutkosky, "Practical force-motion models for sliding manipulation",
    International Journal of Robotics Research 15 (6), 557-572, 1996.
    """

    f_max: float  #: greatest frictional force, in pure translation [N], eq. (2)
    m_max: float  #: greatest frictional moment, in pure rotation [N m], eq. (1)

    def __post_init__(self) -> None:
        for name in ('f_max', 'm_max'):
            value = getattr(self, name)
            if not (np.isfinite(value) and value > 0.0):
                raise ValueError(f'{name}: expected a positive finite number, got {value}')

    @property
    def c(self) -> float:
        """The ratio m_max / f_max [m] of eqs. (4) and (5)."""
        return self.m_max / self.f_max

    def level(self, wrench: npt.ArrayLike) -> float:
        """Evaluate the left side of (3): below 1 the object rests, at 1 it slides.

        Parameters
        ----------
        wrench : array_like, shape (3,)
            Applied force and moment (f_x, f_y, m) [N, N, N m] about the centre of mass.

        Returns
        -------
        float
            Value of the quadratic form, without unit.
        """
        f_x, f_y, m = np.asarray(wrench, dtype=float)
        return float((f_x**2 + f_y**2) / self.f_max**2 + m**2 / self.m_max**2)

    def twist(self, wrench: npt.ArrayLike) -> Array:
        """Compute the direction of motion under a wrench on the surface, eqs. (4) and (5).

        Parameters
        ----------
        wrench : array_like, shape (3,)
            Applied force and moment (f_x, f_y, m) [N, N, N m] about the centre of mass.

        Returns
        -------
        ndarray, shape (3,)
            Outward normal of the ellipsoid, scaled to (f_x, f_y, m / c**2): the velocity
            (v_x, v_y, omega) up to a positive factor.
        """
        f_x, f_y, m = np.asarray(wrench, dtype=float)
        return np.array([f_x, f_y, m / self.c**2])

    def wrench(self, twist: npt.ArrayLike) -> Array:
        """Compute the wrench on the surface that keeps a motion going.

        Parameters
        ----------
        twist : array_like, shape (3,)
            Velocity (v_x, v_y, omega) [m/s, m/s, rad/s] of the centre of mass, not zero.

        Returns
        -------
        ndarray, shape (3,)
            Force and moment (f_x, f_y, m) [N, N, N m] whose level is 1.

        Raises
        ------
        ValueError
            If the twist is zero: a resting object does not determine its wrench.
        """
        v_x, v_y, omega = np.asarray(twist, dtype=float)
        direction = np.array([v_x, v_y, self.c**2 * omega])
        level = self.level(direction)
        if not level > 0.0:
            raise ValueError(f'twist: expected a motion that is not zero, got {twist!r}')
        return direction / np.sqrt(level)


@dataclass(frozen=True, eq=False)
class ExactLimitSurface:
    """The limit surface of the points that an object rests on.

    A horizontal force at a height above the support tilts the pressure towards where it points: the
    centre of friction moves by `tilt` f / f_max. Loads grow linearly with the place, as shares of
    those at rest; on three points no other loads balance, on equal points it is what equal springs
    give. The force is the one that the loads resist, so both are found together.

    Raises
    ------
    ValueError
        If all load is in one place: it resists no moment. If the tilt is negative or not finite, or
        a point would lift off under a force of f_max in some direction.

    References
    ----------
    S. Goyal, A. Ruina and J. Papadopoulos, "Planar sliding with dry friction Part 1. Limit surface
    and moment function", Wear 143, 307-330, 1991.
    """

    support: Support  #: to whose centre, at rest, wrenches and twists refer
    #: mu_s times the height of the force above the support [m]
    tilt: float = 0.0

    def __post_init__(self) -> None:
        offsets = self.support.points - self.support.centre
        size = np.abs(self.support.points).max() + self.support.c
        if not np.abs(offsets[self.support.loads > 0.0]).max() > ONE_PLACE * size:
            raise ValueError(
                'support: expected loads in more than one place, got all at '
                f'{self.support.centre} m'
            )
        if not (math.isfinite(self.tilt) and self.tilt >= 0.0):
            raise ValueError(f'tilt: expected a finite length of 0 or more [m], got {self.tilt}')
        if self.tilt > 0.0 and self.tilt > self.largest_tilt * (1.0 + ROUNDING):
            raise ValueError(
                f'tilt: expected at most {self.largest_tilt:.3g} m, up to where all points stay on '
                f'the ground, got {self.tilt} m'
            )

    @property
    def largest_tilt(self) -> float:
        """Tilt [m] with which a force of f_max in some direction takes all load off a point."""
        return float(1.0 / np.hypot(*self._tilting).max())

    @property
    def points(self) -> Array:
        """Rows x, y [m] about the centre and load of the support points, shape (3, N).

        With a tilt two more rows, the derivatives of the loads by the force (f_x, f_y).
        """
        x, y = (self.support.points - self.support.centre).T
        load = self.support.loads
        if self.tilt == 0.0:
            return np.array([x, y, load])  # each row in one piece of memory
        return np.array([x, y, load, *(load / self.support.f_max * self.tilt * self._tilting)])

    @property
    def _tilting(self) -> Array:
        """By which share loads grow where the centre of friction moves [1/m], shape (2, N).

        Of a point without load 0; not finite if all load is on one line.
        """
        load = self.support.loads
        offsets = np.where(load > 0.0, (self.support.points - self.support.centre).T, 0.0)
        moments = (offsets * load) @ offsets.T / load.sum()
        if not np.linalg.det(moments) > ONE_PLACE * np.trace(moments) ** 2:
            return np.full_like(offsets, np.inf)
        return np.linalg.solve(moments, offsets)

    def wrench(self, twist: npt.ArrayLike) -> Array:
        """Compute the wrench on the surface that keeps a motion going.

        Parameters
        ----------
        twist : array_like, shape (3,)
            Velocity (v_x, v_y, omega) [m/s, m/s, rad/s] of the centre of friction, not zero.

        Returns
        -------
        ndarray, shape (3,)
            Force and moment (f_x, f_y, m) [N, N, N m]: the sum of the frictions of all points. A
            point that stands still, whose friction may be any, counts as 0.

        Raises
        ------
        ValueError
            If the twist is zero: a resting object does not determine its wrench.
        """
        return summed_friction(self.points, twist)

    def twist(self, wrench: npt.ArrayLike) -> Array:
        """Compute the direction of motion under a wrench.

        Parameters
        ----------
        wrench : array_like, shape (3,)
            Force and moment (f_x, f_y, m) about the centre of friction, not zero; its magnitude
            does not matter.

        Returns
        -------
        ndarray, shape (3,)
            Velocity (v_x, v_y, omega), normal to the surface, scaled so that the wrench supplies
            the power 1.

        Raises
        ------
        ValueError
            If the wrench is zero or not finite.
        """
        f_x, f_y, m = (float(value) for value in np.asarray(wrench, dtype=float))
        force = math.hypot(f_x, f_y)
        if not (math.isfinite(force + m) and (force or m)):
            raise ValueError(f'wrench: expected a finite one that is not zero, got {wrench!r}')
        if abs(m) > self.support.c * force:
            return self._turning(f_x / m, f_y / m, math.copysign(1.0, m)) / abs(m)
        # As if the force acted at the point of its line that is nearest to the centre.
        e_x, e_y, arm = f_x / force, f_y / force, m / force
        x, y = arm * e_y, -arm * e_x
        slope, omega = exact_slipping(
            e_x, e_y, 0.0, arm / self.support.c**2, x, y, self.support.c, self.points
        )
        u_x, u_y = e_x - slope * e_y, e_y + slope * e_x
        return np.array([u_x + omega * y, u_y - omega * x, omega]) / force

    def level(self, wrench: npt.ArrayLike) -> float:
        """Compute how far out a wrench is: below 1 the object rests, at 1 it slides.

        Parameters
        ----------
        wrench : array_like, shape (3,)
            Applied force and moment (f_x, f_y, m) [N, N, N m] about the centre of friction.

        Returns
        -------
        float
            Square of the factor by which the surface must grow to hold the wrench, as the left
            side of (3) is for the ellipsoid.
        """
        if not np.any(np.asarray(wrench, dtype=float)):
            return 0.0
        twist = self.twist(wrench)
        return float(1.0 / (twist @ self.wrench(twist)) ** 2)

    def _turning(self, f_x: float, f_y: float, sense: float) -> Array:
        """Minimise the dissipation under the power 1 of the wrench (f_x, f_y, 1) times its sense.

        omega follows from (v_x, v_y); the dissipation is convex in these two. One root in v_y
        within one root in v_x.
        """
        points = self.points

        def gradient(v_x: float, v_y: float) -> tuple[float, ...]:
            omega = sense - f_x * v_x - f_y * v_y
            p_x, p_y, m, xx, xy, yy, xm, ym, mm, yx, mx, my = pushing_force(
                v_x, v_y, omega, 0.0, 0.0, points
            )
            return (
                p_x - f_x * m,
                p_y - f_y * m,
                xx - f_x * (xm + mx) + f_x * f_x * mm,
                xy - f_x * my - f_y * xm + f_x * f_y * mm,
                yy - f_y * (ym + my) + f_y * f_y * mm,
                yx - f_x * ym - f_y * mx + f_x * f_y * mm,
            )

        scale, size = self.support.c, self.support.f_max
        v_x, v_y = 0.0, 0.0
        lower, upper, before, found = -math.inf, math.inf, math.inf, False
        while not found:
            floor, ceiling, before_y, found_y = -math.inf, math.inf, math.inf, False
            while not found_y:
                g_x, g_y, h_xx, h_xy, h_yy, h_yx = gradient(v_x, v_y)
                floor, ceiling = (v_y, ceiling) if g_y < 0.0 else (floor, v_y)
                after, _, found_y = next_guess(
                    v_y, g_y, h_yy, before_y, floor, ceiling, scale, size
                )
                g_x += h_xy * (after - v_y)
                v_y, before_y = after, abs(g_y)
            slope = h_xx - h_xy * h_yx / h_yy if h_yy > 0.0 else h_xx
            lower, upper = (v_x, upper) if g_x < 0.0 else (lower, v_x)
            after, _, found = next_guess(v_x, g_x, slope, before, lower, upper, scale, size)
            v_x, before = after, abs(g_x)
        return np.array([v_x, v_y, sense - f_x * v_x - f_y * v_y])


LimitSurface = EllipsoidalLimitSurface | ExactLimitSurface


def summed_friction(points: Array, twist: npt.ArrayLike) -> Array:
    """Compute the wrench that the frictions of support points add up to.

    Parameters
    ----------
    points : ndarray, shape (3, N) or (5, N)
        Rows as of `ExactLimitSurface.points`.
    twist : array_like, shape (3,)
        Velocity (v_x, v_y, omega) [m/s, m/s, rad/s], not zero.

    Returns
    -------
    ndarray, shape (3,)
        Force and moment (f_x, f_y, m), as `ExactLimitSurface.wrench` returns them.

    Raises
    ------
    ValueError
        If the twist is zero.
    """
    v_x, v_y, omega = np.asarray(twist, dtype=float)
    if not (v_x or v_y or omega):
        raise ValueError(f'twist: expected a motion that is not zero, got {twist!r}')
    x, y, load, *growth = points
    u_x, u_y = v_x - omega * y, v_y + omega * x
    speed = np.hypot(u_x, u_y)
    fastest = math.hypot(v_x, v_y) + np.hypot(x, y).max() * abs(omega)
    moving = speed > STANDSTILL * fastest
    if growth:
        slowness = np.divide(1.0, speed, out=np.zeros_like(speed), where=moving)
        directions = slowness * [u_x, u_y]
        by_force = directions @ np.transpose(growth)
        load = load + np.linalg.solve(np.eye(2) - by_force, directions @ load) @ growth
    friction = np.divide(load, speed, out=np.zeros_like(speed), where=moving)
    return np.array([friction @ u_x, friction @ u_y, friction @ (x * u_y - y * u_x)])
