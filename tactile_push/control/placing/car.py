# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The pushed object as a car that is steered over the belt's way.

docs/placing.md derives it.
"""

import math

BISECTIONS = 60  # halve an angle up to pi to rounding


def leaf(d: float, theta: float, psi: float, r: float) -> float:
    """Return what a contact that sticks keeps, d + r (theta - psi).

    Parameters
    ----------
    d, theta, psi : float
        Contact along the edge [m], angle of the edge and of the tip's pole [rad], the latter pi/2
        straight ahead.
    r : float
        Effective radius of the finger's disk [m].

    Returns
    -------
    float
        The d that the contact has at theta = 0 with the pole straight ahead [m].
    """
    return d + r * (theta - (psi - math.pi / 2.0))


def held_angle(k: float, l: float, r: float) -> float:
    """Return the angle at which an object is carried straight ahead, d + l tan(theta) = 0.

    Parameters
    ----------
    k : float
        The leaf, as `leaf` gives it for the tip's present direction [m].
    l, r : float
        Distance from the edge to the centre of mass, and effective radius of the disk [m]. For
        l < r there may be three such angles, of which this is one.

    Returns
    -------
    float
        theta [rad].
    """
    low, high = -math.pi / 2.0, math.pi / 2.0
    for _ in range(BISECTIONS):
        middle = (low + high) / 2.0
        if k - r * middle + l * math.tan(middle) < 0.0:
            low = middle
        else:
            high = middle
    return (low + high) / 2.0


def shortest_belt(shift: float, wheelbase: float, steepest: float) -> float:
    """Return the shortest belt on which an object is shifted that goes straight ahead again.

    The contact sticks and does not roll, r = 0: the ray from the contact through the centre of mass
    points straight ahead at the start and at the end.

    Parameters
    ----------
    shift : float
        How far across the belt [m].
    wheelbase : float
        L = (c^2 + d^2 + l^2) / sqrt(d^2 + l^2) [m].
    steepest : float
        Largest |cot(phi)|, positive.

    Returns
    -------
    float
        Length of the belt [m].
    """
    root = math.hypot(1.0, steepest)
    unit = wheelbase / root
    # exp(-turn) of the largest turn is `last` and a bit: at `last` there is no way back.
    last = root - steepest
    low, high = math.log(math.ulp(0.0)), 0.0  # of the bit's logarithm, as a share of 1 - last
    out = back = 0.0
    for _ in range(BISECTIONS):
        logarithm = (low + high) / 2.0
        bit = (1.0 - last) * math.exp(logarithm)
        w = last + bit
        rest = (1.0 + steepest + root) / (w + steepest + root)
        back = -unit * (logarithm + math.log(rest))
        rest = (1.0 / w - last) / (1.0 / w + steepest + root) / (1.0 - last)
        out = unit * math.log(rest * (1.0 + steepest + root))
        if steepest * (back - out) < abs(shift):
            high = logarithm
        else:
            low = logarithm
    return out + back
