# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Where on the edge the finger is, once the object translates (Section III, eq. (17))."""

import math
from collections.abc import Sequence
from statistics import NormalDist


def contact_of_translation(theta: float, phi: float, l: float) -> float:
    """Compute the contact d of an object that translates, eq. (17).

    The ray of pushing passes through the centre of mass. The paper's two branches are the same
    function, -l / tan(phi - theta), since the tangent repeats after pi; straight pushes give 0.

    Parameters
    ----------
    theta : float
        Sensed angle of the pushed edge [rad].
    phi : float
        Push angle [rad], 0 < phi - theta < pi.
    l : float
        Distance from the edge to the centre of mass [m].

    Returns
    -------
    float
        d [m].

    Raises
    ------
    ValueError
        If the finger does not move into the object.

    References
    ----------
    K. M. Lynch, H. Maekawa and K. Tanie, "Manipulation and active sensing by pushing using
    tactile feedback", IROS 1992, eq. (17).
    """
    beta = phi - theta
    if not 0.0 < beta < math.pi:
        raise ValueError(f'phi - theta: expected an angle between 0 and pi rad, got {beta}')
    return -l * math.cos(beta) / math.sin(beta)


def surface_direction(theta: float, phi: float, turning: float, lever: float) -> float:
    """Compute the direction in which the finger's surface moves at the contact.

    This is the phi of (17). Of a tip that turns while it moves it is not the push angle, because
    the surface passes the point that follows the commands.

    Parameters
    ----------
    theta : float
        Angle of the pushed edge [rad].
    phi : float
        Direction of the commanded point relative to the support [rad], 0 < phi < pi.
    turning : float
        By how much the tip turns for each metre across the belt, dpsi/dx [rad/m].
    lever : float
        Distance of the contact from the commanded point, along the normal [m].

    Returns
    -------
    float
        Direction relative to the support [rad].
    """
    across = math.cos(phi)
    passing = lever * turning * across
    return math.atan2(math.sin(phi) - passing * math.sin(theta), across - passing * math.cos(theta))


def bounds_of_translation(
    theta: tuple[float, float], phi: tuple[float, float], l: float
) -> tuple[float, float]:
    """Bound the contact d of an object that translates, from ranges of theta and phi.

    (17) grows with phi - theta all the way from 0 to pi, through pi/2 too, so the ends of the
    ranges give those of d. The paper takes the range of phi - theta itself, which is no wider:
    pass it as `phi` with 0 for both of `theta`.

    Parameters
    ----------
    theta : tuple of float
        Least and most angle of the edge while the object translates [rad].
    phi : tuple of float
        Least and most push angle meanwhile [rad].
    l : float
        Distance from the edge to the centre of mass [m].

    Returns
    -------
    lower, upper : float
        Bounds of d [m].

    Raises
    ------
    ValueError
        If a range is reversed, or the finger may not move into the object.
    """
    for name, (least, most) in (('theta', theta), ('phi', phi)):
        if not least <= most:
            raise ValueError(f'{name}: expected the least angle first, got {least}, {most} rad')
    return (
        contact_of_translation(theta[1], phi[0], l),
        contact_of_translation(theta[0], phi[1], l),
    )


def translates(theta: Sequence[float], way: float, noise: float, error: float, turn: float) -> bool:
    """Decide whether an object translates, with a stated probability of error.

    No data show that something does not turn at all: it is called translating if it turns by less
    than `turn` a metre. A straight line is fitted to the readings; the answer is yes if the whole
    two-sided confidence interval of its slope is within the bound, so that an object that turns
    evenly by more is called translating with a probability of `error` / 2 at the most.

    Parameters
    ----------
    theta : sequence of float, length 3 or more
        Readings of the edge's angle at even distances [rad].
    way : float
        Length of the pushes from the first to the last [m], positive.
    noise : float
        Standard deviation of a reading [rad], positive.
    error : float
        Probability outside the confidence interval, between 0 and 1.
    turn : float
        Bound on the turning rate [rad/m], positive.

    Returns
    -------
    bool
        Whether it translates.

    Raises
    ------
    ValueError
        If a number is out of its range.
    """
    if len(theta) < 3 or not all(map(math.isfinite, theta)):
        raise ValueError(f'theta: expected three or more finite angles [rad], got {theta!r}')
    for name, value in (('way', way), ('noise', noise), ('turn', turn)):
        if not (math.isfinite(value) and value > 0.0):
            raise ValueError(f'{name}: expected a positive finite number, got {value}')
    if not 0.0 < error < 1.0:
        raise ValueError(f'error: expected a probability between 0 and 1, got {error}')
    last = len(theta) - 1
    places = [way * (k / last - 0.5) for k in range(last + 1)]
    square = sum(place * place for place in places)
    slope = sum(place * angle for place, angle in zip(places, theta, strict=True)) / square
    half = NormalDist().inv_cdf(1.0 - error / 2.0) * noise / math.sqrt(square)
    return abs(slope) + half <= turn


def centre_on_ray(theta: float, d: float, l: float, r: float) -> tuple[float, float]:
    """Compute the centre of mass in the frame of the finger's disk.

    While the object translates, it lies on the ray of pushing that leaves the contact.

    Parameters
    ----------
    theta : float
        Angle of the edge [rad].
    d : float
        Contact along the edge, for instance by (17) [m].
    l : float
        Distance from the edge to the centre of mass [m].
    r : float
        Radius of the finger's disk [m].

    Returns
    -------
    x, y : float
        From the centre of the disk [m].
    """
    cos, sin = math.cos(theta), math.sin(theta)
    return -d * cos - (l + r) * sin, -d * sin + (l + r) * cos
