# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Which point of a turning disk follows the command, and how far the disk's centre then goes."""

import math

from tactile_push.mechanics.compiled import compiled

CENTRE, POLE, CONTACT = range(3)  # indices of `tactile_push.interface.POINTS`


@compiled
def added_way(point: int, before: float, after: float, theta: float, r: float) -> float:
    """Compute how much farther than the commanded point the disk's centre goes across the belt.

    A point of the disk at r (cos a, sin a) from its centre moves across the belt at
    v_x - r psi' sin(a). For the pole a is psi; for the contact it is the angle of the normal.

    Parameters
    ----------
    point : int
        `CENTRE`, `POLE` or `CONTACT`.
    before, after : float
        Angle psi of the disk at the start and at the end [rad].
    theta : float
        Angle of the pushed edge [rad], meanwhile the same.
    r : float
        Radius of the disk [m].

    Returns
    -------
    float
        The way [m]; 0 for the centre, and while the disk does not turn.
    """
    if point == POLE:
        return r * (math.cos(before) - math.cos(after))
    if point == CONTACT:
        return r * math.cos(theta) * (after - before)
    return 0.0
