# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Numbers that may be fitted to pushes, and what they say of an object's friction.

Each number is of the size of 1 and what it says changes smoothly with it. The spread of a load is
told by c as a share of the largest one: by the spread itself c does not change at the rim.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from itertools import product
from typing import NamedTuple

import numpy as np

from tactile_push.identification.predicting import Physics
from tactile_push.mechanics import ExactLimitSurface, Outline, Support
from tactile_push.mechanics.compiled import Array
from tactile_push.mechanics.quadrature import area_and_centroid
from tactile_push.mechanics.spread import largest_spread, mean_distance, spread_at

POINTS = 200  # that stand for a support
HOME = 0.1  # standard deviation of the centre of friction from the centroid [c, uniform]
NOMINAL_MU_C = 0.25  # of a prediction with nothing fitted
MOST_TILT = 0.5  # [c]


class Unknown(NamedTuple):
    """A number that is fitted."""

    lower: float  #: bound
    upper: float  #: bound
    starts: tuple[float, ...]  #: from which the best one is taken to begin with
    #: of differences; as it is not small, they see past the kinks where a contact begins to slip
    step: float = 0.02
    prior: float = math.inf  #: standard deviation from 0


FRICTION_ANGLE = Unknown(0.0, 1.5, (0.1, 0.25, 0.4))  # [rad]; mu_c is its tangent
SHARE_OF_C = Unknown(0.1, 1.0, (0.4, 0.65, 0.9))  # of the largest
OFFSET = Unknown(-5.0, 5.0, (0.0,), 0.2, 1.0)  # of the centre of friction [HOME]


@dataclass(frozen=True)
class Model:
    """Numbers that are fitted, and what they say."""

    unknowns: tuple[Unknown, ...]
    #: of the numbers; ValueError if the object would tip over
    physics: Callable[[Array], Physics]
    #: what they say in the units of people and files, by name
    values: Callable[[Physics], dict[str, float]]

    @property
    def starts(self) -> list[Array]:
        """Numbers from which the best ones are taken to begin with."""
        return [np.array(point) for point in product(*(one.starts for one in self.unknowns))]


def nominal(outline: Outline) -> Physics:
    """Return what is assumed of an object when nothing is fitted.

    Parameters
    ----------
    outline : Outline
        Its outline.

    Returns
    -------
    Physics
        Uniform pressure and `NOMINAL_MU_C`.
    """
    return Physics(Support.uniform(outline, POINTS), NOMINAL_MU_C)


def unknown_support(outline: Outline, centre: bool = True) -> Model:
    """Return the model of an object whose support is not known.

    Parameters
    ----------
    outline : Outline
        Its outline.
    centre : bool, optional
        Whether the centre of friction may be elsewhere than at the centroid. The pressure is tilted
        so that it lies there.

    Returns
    -------
    Model
        With `c` [m], `mu_c` and, if it is asked for, `x` and `y` of the centre of friction from the
        centroid [m].
    """
    _, home = area_and_centroid(outline)
    about = outline.about(*home)
    largest = mean_distance(about, largest_spread(outline))
    length = HOME * mean_distance(about, 1.0)

    def physics(numbers: Array) -> Physics:
        share, angle, *offset = numbers.tolist()
        spread = spread_at(about, share * largest)
        support = Support.spread(outline, spread, POINTS)
        if offset:
            x, y = (at + length * by for at, by in zip(support.centre, offset, strict=True))
            support = support.carrying((x, y))
        return Physics(support, math.tan(angle), spread=spread)

    def values(physics: Physics) -> dict[str, float]:
        x, y = (float(at - of) for at, of in zip(physics.support.centre, home, strict=True))
        found = {'c': physics.support.c, 'mu_c': physics.mu_c}
        return {**found, 'x': x, 'y': y} if centre else found

    offset = (OFFSET, OFFSET) if centre else ()
    return Model((SHARE_OF_C, FRICTION_ANGLE, *offset), physics, values)


def known_support(support: Support, tilt: bool = False) -> Model:
    """Return the model of an object whose support is known.

    Parameters
    ----------
    support : Support
        The support.
    tilt : bool, optional
        Whether the push may be above the support, as far as no point lifts off.

    Returns
    -------
    Model
        With `mu_c` and, if it is asked for, `tilt` [m].
    """
    most = min(ExactLimitSurface(support).largest_tilt / support.c, MOST_TILT) if tilt else 0.0

    def physics(numbers: Array) -> Physics:
        angle, *height = numbers.tolist()
        return Physics(support, math.tan(angle), support.c * height[0] if height else 0.0)

    def values(physics: Physics) -> dict[str, float]:
        found = {'mu_c': physics.mu_c}
        return {**found, 'tilt': physics.tilt} if most > 0.0 else found

    height = (Unknown(0.0, most, (0.0, most / 4.0), min(0.02, most / 4.0)),) if most > 0.0 else ()
    return Model((FRICTION_ANGLE, *height), physics, values)
