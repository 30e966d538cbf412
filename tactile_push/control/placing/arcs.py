# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""A push as a few arcs: a command each, and the belt on which it is given.

It is an array of the commands cot(phi) and, after them, the lengths in units of `LENGTH`.
"""

from tactile_push.mechanics.compiled import Array, compiled

ARCS = 4
UNKNOWNS = 2 * ARCS
LENGTH = 0.1  # [m]
NOTHING = 1e-12  # a length that is rounding of 0 [`LENGTH`]


@compiled
def rest_of(push: Array, way: float, rest: Array) -> None:
    """Write what is left of a push after a piece of belt [m].

    For an arc that is over the longest of the others becomes two.
    """
    rest[:] = push
    left = way / LENGTH
    while left > 0.0 or rest[ARCS] == 0.0:
        used = min(left, rest[ARCS])
        rest[ARCS] -= used
        left -= used
        if rest[ARCS] > NOTHING:
            break
        rest[ARCS] = 0.0
        longest = 1
        for i in range(2, ARCS):
            if rest[ARCS + i] > rest[ARCS + longest]:
                longest = i
        if rest[ARCS + longest] == 0.0:
            break
        for i in range(longest):
            rest[i] = rest[i + 1]
            rest[ARCS + i] = rest[ARCS + i + 1]
        rest[ARCS + longest - 1] /= 2.0
        rest[ARCS + longest] /= 2.0
