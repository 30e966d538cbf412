# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The centre of mass as the intersection of rays of pushing (Section III)."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from tactile_push.mechanics.compiled import Array

PARALLEL = 10.0  # rays cross at angles of more than so many standard deviations


@dataclass(frozen=True)
class Ray:
    """A ray of pushing: the line through the contact along which the object translates.

    Raises
    ------
    ValueError
        If a number is not finite or a standard deviation out of its range.
    """

    x: float  #: contact, in a frame fixed to the object [m]
    y: float  #: the same [m]
    angle: float  #: direction of pushing in that frame [rad]
    sigma_angle: float  #: standard deviation of the direction [rad], positive
    sigma_contact: float = 0.0  #: standard deviation of the contact across the ray [m]

    def __post_init__(self) -> None:
        for name in ('x', 'y', 'angle', 'sigma_angle', 'sigma_contact'):
            value = getattr(self, name)
            if not math.isfinite(value):
                raise ValueError(f'{name}: expected a finite number, got {value}')
        if not (self.sigma_angle > 0.0 and self.sigma_contact >= 0.0):
            raise ValueError(
                f'sigma_angle, sigma_contact: expected a positive and one of 0 or more, got '
                f'{self.sigma_angle}, {self.sigma_contact}'
            )


@dataclass(frozen=True, eq=False)
class Intersection:
    """Where rays of pushing meet."""

    x: float  # centre of mass in the frame of the rays [m]
    y: float
    covariance: Array  # of (x, y) [m^2], shape (2, 2)
    chi_squared: float  # sum of the squared normalised distances from the rays: N - 2 on average


class ParallelRaysError(ValueError):
    """The rays are too nearly parallel to determine where they meet."""


def intersect_rays(rays: Sequence[Ray]) -> Intersection:
    """Intersect two or more rays of pushing by weighted least squares.

    A ray at (x_i, y_i) with the direction a_i says sin(a_i) (x - x_i) - cos(a_i) (y - y_i) = 0, to
    within its contact's error and its angle's times the distance. That distance follows from
    the intersection, so the weights are found by iteration.

    Parameters
    ----------
    rays : sequence of Ray
        The rays, from contacts that differ.

    Returns
    -------
    Intersection
        The centre of mass.

    Raises
    ------
    ParallelRaysError
        If the rays are parallel to within ten standard deviations of the angles between them.
    ValueError
        If there are fewer than two rays.

    References
    ----------
    K. M. Lynch, H. Maekawa and K. Tanie, "Manipulation and active sensing by pushing using
    tactile feedback", IROS 1992, Section III.
    """
    if len(rays) < 2:
        raise ValueError(f'rays: expected two or more, got {len(rays)}')
    angle = np.array([ray.angle for ray in rays])
    sigma = np.array([ray.sigma_angle for ray in rays])
    between = np.abs(np.sin(angle[:, np.newaxis] - angle))
    if not (between > PARALLEL * np.hypot(sigma[:, np.newaxis], sigma)).any():
        raise ParallelRaysError(
            f'rays: expected some that cross, got angles that differ by '
            f'{math.degrees(math.asin(between.max())):.2f} degrees at the most'
        )
    contacts = np.array([(ray.x, ray.y) for ray in rays])
    across = np.stack([np.sin(angle), -np.cos(angle)], axis=1)
    offsets = (across * contacts).sum(axis=1)
    error = np.array([ray.sigma_contact for ray in rays])
    distance = np.ones(len(rays))
    for _ in range(20):
        weights = 1.0 / (error**2 + (sigma * distance) ** 2)
        information = (across.T * weights) @ across
        centre = np.linalg.solve(information, across.T @ (weights * offsets))
        distance = np.hypot(*(centre - contacts).T)
    residuals = across @ centre - offsets
    return Intersection(
        float(centre[0]),
        float(centre[1]),
        np.linalg.inv(information),
        float(weights @ residuals**2),
    )
