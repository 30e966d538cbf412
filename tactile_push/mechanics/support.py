# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Support of an object: where it rests, and so its m_max and f_max, eqs. (1) and (2).

A load is the greatest friction that a point of the support can give, mu_s times the normal force
there. Where mu_s or the pressure is uneven, the centre of friction, the loads' mean position, takes
the place of the centre of mass.
"""

import math
import reprlib
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from tactile_push.mechanics.compiled import Array
from tactile_push.mechanics.outline import Outline
from tactile_push.mechanics.quadrature import (
    area_and_centroid,
    boundary,
    cells,
    distances,
    integrals,
    spaced,
)
from tactile_push.mechanics.spread import (
    largest_spread,
    mean_distance,
    standing_points,
)
from tactile_push.mechanics.statics import spring_loads

COUNT = 400  # points that stand for a support; a push sums over them, m_max does not need them


@dataclass(frozen=True, eq=False)
class Support:
    """Loads on the ground.

    Made by `at_points`, `corners`, `rim`, `uniform`, `circle`, `spread` or `density`; `carrying`
    gives it the loads under a centre of mass. Where points only stand for a continuous support,
    `m_max` is that of the continuous one.

    References
    ----------
    K. M. Lynch, H. Maekawa and K. Tanie, "Manipulation and active sensing by pushing using
    tactile feedback", IROS 1992, eqs. (1) and (2).
    """

    points: Array  #: points that stand for the support in an exact limit surface [m], shape (N, 2)
    loads: Array  #: greatest friction of each point [N], shape (N,)
    centre: tuple[float, float]  #: centre of friction (x, y) [m]
    f_max: float  #: greatest frictional force [N], eq. (2)
    m_max: float  #: greatest frictional moment about the centre [N m], eq. (1)

    @property
    def c(self) -> float:
        """The ratio m_max / f_max [m] of eqs. (4) and (5)."""
        return self.m_max / self.f_max

    def carrying(self, centre_of_mass: tuple[float, float]) -> 'Support':
        """Let the support carry a weight, under an even mu_s.

        Up to three points that are not on one line have no other loads than these, by statics. More
        points bear as springs do on which the object sinks and tilts, each as stiff as its present
        load: with loads that are alike, these are the loads of least squares. A point that would
        have to pull bears nothing.

        Parameters
        ----------
        centre_of_mass : tuple of float
            Centre of mass (x, y) [m]; it becomes the centre of friction.

        Returns
        -------
        Support
            The support with other loads, their sum as before. That the points only stand for a
            continuous support changes m_max by the same factor as before.

        Raises
        ------
        ValueError
            If the centre of mass lies beside all support: the object tips over.
        """
        loads = self.f_max * spring_loads(self.points, self.loads, centre_of_mass)
        moments = [
            float(load @ np.hypot(*(self.points - centre).T))
            for load, centre in ((self.loads, self.centre), (loads, centre_of_mass))
        ]
        m_max = moments[1] * (self.m_max / moments[0] if moments[0] > 0.0 else 1.0)
        x, y = map(float, centre_of_mass)
        return Support(self.points, loads, (x, y), self.f_max, m_max)

    @classmethod
    def at_points(cls, points: npt.ArrayLike, loads: npt.ArrayLike | None = None) -> 'Support':
        """Rest the object on points, with loads that are known.

        Where the centre of mass is known instead, `carrying` has its loads.

        Parameters
        ----------
        points : array_like, shape (N, 2)
            Support points [m].
        loads : array_like, shape (N,), optional
            Greatest friction of each point [N], or its share in any unit; by default all alike and
            1 together.

        Returns
        -------
        Support
            The support.

        Raises
        ------
        ValueError
            If the shapes do not fit, a number is not finite, a load is negative or all are zero.
        """
        p = np.asarray(points, dtype=float)
        if p.ndim != 2 or p.shape[1] != 2 or len(p) == 0 or not np.isfinite(p).all():
            raise ValueError(
                f'points: expected finite points of shape (N, 2), got {reprlib.repr(points)}'
            )
        w = np.full(len(p), 1.0 / len(p)) if loads is None else np.asarray(loads, dtype=float)
        total = len(w) * float(w.max(initial=0.0)) if w.ndim == 1 else math.nan  # or more
        if w.shape != (len(p),) or not ((w >= 0.0).all() and 0.0 < total < math.inf):
            raise ValueError(
                f'loads: expected {len(p)} loads of 0 or more, not all 0, got {reprlib.repr(loads)}'
            )
        x, y = w @ p / w.sum()
        m_max = w @ np.hypot(p[:, 0] - x, p[:, 1] - y)
        return cls(p, w, (float(x), float(y)), float(w.sum()), float(m_max))

    @classmethod
    def corners(cls, outline: Outline) -> 'Support':
        """Rest the object on the corners of its outline, all alike.

        Parameters
        ----------
        outline : Outline
            A polygon.

        Returns
        -------
        Support
            The support; f_max is 1.

        Raises
        ------
        ValueError
            If the outline has no corners.
        """
        corners = outline.pieces[outline.pieces[:, 3] == 0.0, :2]
        if len(corners) == 0:
            raise ValueError('outline: expected a polygon, got an outline without corners')
        return cls.at_points(corners)

    @classmethod
    def rim(cls, outline: Outline, count: int = COUNT) -> 'Support':
        """Rest the object on its rim, evenly along the outline.

        Parameters
        ----------
        outline : Outline
            The outline.
        count : int, optional
            Number of points, roughly, that stand for the rim.

        Returns
        -------
        Support
            The support; f_max is 1.
        """
        _positive('count', count)
        b, _, ds = boundary(outline)
        centre = ds @ b / ds.sum()
        m_max = distances(outline.about(*centre), 0) / outline.length
        points, _, ds = spaced(outline, count)
        return cls._standing_for(points, ds / ds.sum(), centre, m_max)

    @classmethod
    def uniform(cls, outline: Outline, count: int = COUNT) -> 'Support':
        """Spread the load evenly over the area of the outline.

        Parameters
        ----------
        outline : Outline
            The outline.
        count : int, optional
            Number of points, roughly, that stand for the area.

        Returns
        -------
        Support
            The support; f_max is 1.
        """
        _positive('count', count)
        area, centre = area_and_centroid(outline)
        m_max = distances(outline.about(*centre), 1) / 3.0 / area
        points, areas = cells(outline, area / count)
        return cls._standing_for(points, areas / areas.sum(), centre, m_max)

    @classmethod
    def circle(cls, radius: float, x: float = 0.0, y: float = 0.0, count: int = COUNT) -> 'Support':
        """Spread the load evenly over a circle: c is 2/3 of its radius.

        Parameters
        ----------
        radius : float
            Radius of the circle [m], positive.
        x, y : float, optional
            Its centre [m].
        count : int, optional
            Number of points, roughly, that stand for the area.

        Returns
        -------
        Support
            The support; f_max is 1.

        Raises
        ------
        ValueError
            If the radius is not positive and finite.
        """
        even = cls.uniform(Outline.circle(radius), count)
        return cls._standing_for(
            even.points + np.array([x, y]), even.loads, np.array([x, y]), 2.0 * radius / 3.0
        )

    @classmethod
    def spread(cls, outline: Outline, spread: float, count: int = COUNT) -> 'Support':
        """Spread the load between the centroid and the corners, by one number.

        0 is all load in the centroid, 1 an even pressure, 2 a load on the rim and 3 on
        the corners; c grows all the way. On the rim each part of it bears what an even pressure
        gives to the rays that end there, and a corner half of what the edges beside it do; the
        centre of friction is the centroid. `rim` and `corners` are other supports: even along the
        rim, and alike on all corners. An outline without corners spreads its load up to 2.

        Parameters
        ----------
        outline : Outline
            The outline.
        spread : float
            How far the load is spread, from 0 to 3, or to 2 without corners.
        count : int, optional
            Number of points, roughly, that stand for the area; from the rim on the square root of
            it times 3.5 stand for the edges.

        Returns
        -------
        Support
            The support; f_max is 1.

        Raises
        ------
        ValueError
            If the spread is out of its range.
        """
        _positive('count', count)
        most = largest_spread(outline)
        if not 0.0 <= spread <= most:
            raise ValueError(f'spread: expected a number from 0 to {most:g}, got {spread}')
        _, centre = area_and_centroid(outline)
        m_max = mean_distance(outline.about(*centre), spread)
        return cls._standing_for(*standing_points(outline, spread, count), centre, m_max)

    @classmethod
    def density(
        cls, outline: Outline, density: Callable[[Array, Array], Array], count: int = COUNT
    ) -> 'Support':
        """Spread the load over the outline by a density.

        Parameters
        ----------
        outline : Outline
            The outline.
        density : callable
            Friction over area, mu_s p(x, y) [N/m^2], 0 or more. Called with arrays of x and y [m],
            it returns an array of the same shape.
        count : int, optional
            Number of points, roughly, that stand for the area.

        Returns
        -------
        Support
            The support.

        Raises
        ------
        ValueError
            If the density is negative or not finite somewhere, zero everywhere, or too wild for
            its integral to converge.
        """
        _positive('count', count)

        def checked(x: Array, y: Array) -> Array:
            value = np.broadcast_to(np.asarray(density(x, y), dtype=float), x.shape)
            if not (np.isfinite(value) & (value >= 0.0)).all():
                raise ValueError(
                    'density: expected finite values of 0 or more on the outline, got '
                    f'{value.min()} to {value.max()}'
                )
            return value

        area, centroid = area_and_centroid(outline)
        f_max, x, y = integrals(outline, centroid, checked, lambda x, y: (1.0, x, y))
        if not f_max > 0.0:
            raise ValueError('density: expected one that is not zero everywhere')
        centre = np.array([x, y]) / f_max
        _, m_max = integrals(
            outline, centre, checked, lambda x, y: (1.0, np.hypot(x - centre[0], y - centre[1]))
        )
        points, areas = cells(outline, area / count)
        loads = checked(points[:, 0], points[:, 1]) * areas
        points, loads = points[loads > 0.0], loads[loads > 0.0]
        if len(points) == 0:
            raise ValueError(f'count: expected enough points to meet the density, got {count}')
        return cls._standing_for(points, loads * (f_max / loads.sum()), centre, m_max)

    @classmethod
    def _standing_for(cls, points: Array, loads: Array, centre: Array, m_max: float) -> 'Support':
        """Make a continuous support; its points are moved by what their mean is off the centre."""
        points = points + (centre - loads @ points / loads.sum())
        x, y = centre
        return cls(points, loads, (float(x), float(y)), float(loads.sum()), float(m_max))


def _positive(name: str, value: int) -> None:
    if not value >= 1:
        raise ValueError(f'{name}: expected a whole number of 1 or more, got {value}')
