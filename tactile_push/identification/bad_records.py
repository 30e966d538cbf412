# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Records of pushes that cannot be, and those that do not belong to the others."""

import math
from itertools import pairwise

import numpy as np

from tactile_push.identification.records import Bad, Push, Pushes
from tactile_push.mechanics import clearance
from tactile_push.mechanics.compiled import Array

APART = 0.003  # gap that is more than an error of measured poses [m]
MOVED = 0.003  # motion of the object that is more than that [m]
CLOSEST = 1e-5  # [m]; no camera sees poses better
LOOKS = 50  # places on a straight part of a tip's way that are looked at
CHANCE = 0.01  # that the worst of all records is this bad though it belongs to them


def untouched(pushes: Pushes) -> list[int]:
    """Return which pushes move an object that the tip never comes near.

    Parameters
    ----------
    pushes : Pushes
        The pushes.

    Returns
    -------
    list of int
        Their indices.
    """
    length = pushes.outline.length / math.tau
    found = []
    for k, push in enumerate(pushes.pushes):
        turn = math.remainder(push.end.angle - push.begin.angle, math.tau)
        way = math.dist(push.begin[:2], push.end[:2])
        if max(way, length * abs(turn)) > MOVED and _gap(pushes, push) > APART:
            found.append(k)
    return found


def _gap(pushes: Pushes, push: Push) -> float:
    """Return how close the tip comes to the object where that was at the start [m]."""
    path = pushes.outline.path(push.tip_radius)
    return min(
        float(clearance(push.begin, x, y, path, push.tip_radius)[1])
        for part in pairwise(push.way)
        for x, y in np.linspace(*part, LOOKS).tolist()
    )


def most_of(sizes: Array) -> float:
    """Return how large a residual may be that belongs to the others.

    Those of good records have tails that fall as an exponential at the slowest: half of what is
    beyond one size is beyond the median more than that.

    Parameters
    ----------
    sizes : ndarray, shape (N,)
        Sizes of the residuals [m].

    Returns
    -------
    float
        The size that one of N such residuals exceeds with the probability `CHANCE` only [m].
    """
    return max(float(np.median(sizes)), CLOSEST) * math.log2(len(sizes) / CHANCE)


def named(pushes: Pushes, found: list[int], reason: str) -> tuple[Bad, ...]:
    """Return pushes as bad records.

    Parameters
    ----------
    pushes : Pushes
        The pushes.
    found : list of int
        Indices of the bad ones.
    reason : str
        Why they are bad.

    Returns
    -------
    tuple of Bad
        The records.
    """
    return tuple(Bad(pushes.pushes[k].name, reason) for k in found)
