# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""How points share a weight: what statics leaves open, springs under the points decide.

The loads must add up to the weight and balance about the centre of mass. On three points that is
all. On more of them the object sinks and tilts on springs, whose forces are linear in the place and
never pull. Of all loads that balance these have the least sum of squares over stiffness.
"""

import math

import numpy as np

from tactile_push.mechanics.compiled import Array

BESIDE = 1e-6  # distance that counts as none, of the support's reach
BALANCED = 2e-9  # what may be left of weight and moments, of the weight and times the reach
STEPS = 100
DEEPEST = 1e12  # compression, of the mean one, where a weight just beside the support would end
DAMPING = 1e-12  # of Newton's matrix, where all points that bear are on one line


def spring_loads(points: Array, stiffness: Array, centre_of_mass: tuple[float, float]) -> Array:
    """Return the shares of a weight that springs under an object bear.

    Parameters
    ----------
    points : ndarray, shape (N, 2)
        Places of the springs [m].
    stiffness : ndarray, shape (N,)
        Their stiffness, in any unit; those of 0 bear nothing.
    centre_of_mass : tuple of float
        Centre of mass (x, y) [m].

    Returns
    -------
    ndarray, shape (N,)
        Shares of the weight, 1 together.

    Raises
    ------
    ValueError
        If the centre of mass is not finite or lies beside all springs: the object tips over.
    """
    bearing = stiffness > 0.0
    _check_balance(points[bearing], centre_of_mass)
    offsets = points - centre_of_mass
    away = np.hypot(offsets[:, 0], offsets[:, 1])
    reach = float(away[bearing].max())
    weights = stiffness / stiffness.sum()
    if not reach > 0.0:
        return weights
    # Compression of a spring: how far the object sinks and how it tilts, three numbers. Loads that
    # balance are where the energy of the springs less that of the weight is least, and it is
    # convex: damped Newton's method, whose pieces are quadratic.
    arms = np.column_stack([np.ones(len(points)), offsets / reach])
    weight = np.array([1.0, 0.0, 0.0])
    sunk = weight
    for _ in range(STEPS):
        pressed = np.maximum(arms @ sunk, 0.0)
        left = weight - (weights * pressed) @ arms
        if np.abs(left).max() <= BALANCED:
            return weights * pressed
        if np.abs(sunk).max() > DEEPEST:
            break
        touching = arms[pressed > 0.0]
        matrix = (weights[pressed > 0.0] * touching.T) @ touching
        step = np.linalg.solve(matrix + DAMPING * np.eye(3), left)
        sunk = sunk + _length(arms, weights, sunk, step) * step
    # By rounding just beside a point at the support's edge, which then bears everything.
    nearest = away == away[bearing].min()
    return np.where(nearest & bearing, weights, 0.0) / weights[nearest & bearing].sum()


def _length(arms: Array, weights: Array, sunk: Array, step: Array) -> float:
    """Return how far to go along a step: to where the energy is least, between its kinks."""
    now, change = arms @ sunk, arms @ step
    kinks = -now[change != 0.0] / change[change != 0.0]
    ends = np.append(np.unique(kinks[(kinks > 0.0) & np.isfinite(kinks)]), math.inf)
    start = 0.0
    for end in ends:
        middle = start + 1.0 if math.isinf(end) else (start + end) / 2.0
        touching = now + middle * change > 0.0
        slope = weights[touching] @ (now[touching] * change[touching]) - step[0]
        growth = weights[touching] @ change[touching] ** 2
        if growth > 0.0 and slope + end * growth >= 0.0:
            return float(max(-slope / growth, start))
        start = end
    return 1.0


def _check_balance(points: Array, centre_of_mass: tuple[float, float]) -> None:
    """Refuse a centre of mass with no support on one side of it, in whatever direction."""
    if not np.isfinite(centre_of_mass).all():
        raise ValueError(f'centre_of_mass: expected a finite point [m], got {centre_of_mass}')
    offset = points - centre_of_mass
    reach = np.hypot(offset[:, 0], offset[:, 1])
    far = reach > BESIDE * reach.max()
    if not far.all():
        return  # it rests on one of the points
    angles = np.sort(np.arctan2(offset[:, 1], offset[:, 0]))
    gaps = np.diff(angles, append=angles[0] + 2.0 * math.pi)
    widest = int(np.argmax(gaps))
    if gaps[widest] > math.pi + 1e-9:
        side = math.degrees(angles[widest] + gaps[widest] / 2.0) % 360.0
        raise ValueError(
            f'centre_of_mass: expected a point over the support, got {centre_of_mass} m, which '
            f'has no support on its side at {side:.0f} degrees'
        )
