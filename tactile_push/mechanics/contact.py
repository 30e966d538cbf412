# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The finger's disk against a convex outline: where it touches and how far away it is.

While the disk rolls and slips around the object, its centre moves on a path of its own: the
outline's parallel curve at the disk's radius r, which is smooth even around corners. The length
sigma along this path, counterclockwise around the object, is the contact's one coordinate. Along
an edge it changes as the paper's d does; around a corner it goes on while the contact stays there.

A path is an array of pieces, a row each with the columns below; a last row closes it: the first
one after a full turn. `Outline.path` makes it. Poses of an object are those of its centre of mass.
"""

import math

from tactile_push.mechanics.body import Pose
from tactile_push.mechanics.compiled import Array, compiled, equation

SIGMA = 0  # where the piece starts [m]
LENGTH = 1  # of the piece [m]
CURVATURE = 2  # of the path [1/m]: 0 along an edge, 1/r around a corner, 1/(R + r) along an arc
TAU = 3  # angle of the tangent at the piece's start, in the object's frame [rad]
T_X, T_Y = 4, 5  # the same tangent as a unit vector
D_START, L_START = 6, 7  # the paper's d and l of the contact at the piece's start [m]
COLUMNS = 8

TOUCH = 1e-12  # a gap up to this is a contact [m]
SMALL_ANGLE = 0.25  # below it a few terms of the series are exact [rad]


@equation
def rotated(x: float, y: float, angle: float) -> tuple[float, float]:
    """Rotate a vector, fast when the angle is small, as it is within a push."""
    if abs(angle) < SMALL_ANGLE:
        q = angle * angle
        sin = angle * (
            1.0 - q * (1 / 6 - q * (1 / 120 - q * (1 / 5040 - q * (1 / 362880 - q / 39916800))))
        )
        cos = 1.0 - q * (1 / 2 - q * (1 / 24 - q * (1 / 720 - q * (1 / 40320 - q / 3628800))))
    else:
        sin, cos = math.sin(angle), math.cos(angle)
    return cos * x - sin * y, sin * x + cos * y


@compiled
def piece_at(sigma: float, path: Array) -> int:
    """Return the row of the path on which a contact lies; sigma may be any number of turns."""
    first, last = 0, len(path) - 1
    around = path[last, SIGMA]
    if not 0.0 <= sigma < around:
        sigma -= math.floor(sigma / around) * around
    while last - first > 1:
        middle = (first + last) >> 1
        if sigma < path[middle, SIGMA]:
            last = middle
        else:
            first = middle
    return first


@equation
def contact(sigma: float, piece: int, path: Array, r: float) -> tuple[float, float, float, float]:
    """Compute the contact's geometry: its tangent and the paper's d and l.

    Parameters
    ----------
    sigma : float
        Position along the path [m].
    piece : int
        The piece on which the contact is supposed to lie; another one is looked for if it does
        not.
    path : ndarray, shape (M + 1, 8)
        Pieces of the path.
    r : float
        Radius of the finger's disk [m].

    Returns
    -------
    t_x, t_y : float
        Unit tangent t in the object's frame; the normal n is (-t_y, t_x).
    d, l : float
        The contact relative to the centre of mass is d t - l n [m].
    """
    s = sigma - path[piece, SIGMA]
    if not 0.0 <= s < path[piece, LENGTH]:
        piece = piece_at(sigma, path)
        s = sigma - path[piece, SIGMA]
        s -= math.floor(sigma / path[-1, SIGMA]) * path[-1, SIGMA]
    t_x, t_y, d, l = path[piece, T_X], path[piece, T_Y], path[piece, D_START], path[piece, L_START]
    curvature = path[piece, CURVATURE]
    if curvature == 0.0:
        return t_x, t_y, d + s, l
    # The tangent turns about the arc's centre, which lies `rise` above the centre of mass, along n.
    rise = 1.0 / curvature - r - l
    half_cos, half_sin = rotated(1.0, 0.0, curvature * s / 2.0)
    sin, sag = 2.0 * half_sin * half_cos, 2.0 * half_sin * half_sin
    cos = 1.0 - sag
    d, l = d * cos + rise * sin, l + d * sin + rise * sag
    return cos * t_x - sin * t_y, sin * t_x + cos * t_y, d, l


@equation
def tangent_angle(sigma: float, path: Array) -> float:
    """Return the angle of the tangent at a contact.

    Parameters
    ----------
    sigma : float
        Position along the path [m].
    path : ndarray, shape (M + 1, 8)
        Pieces of the path.

    Returns
    -------
    float
        Angle in the object's frame [rad]; it grows by 2 pi a turn.
    """
    piece, around = piece_at(sigma, path), path[-1, SIGMA]
    turns = 0.0 if 0.0 <= sigma < around else math.floor(sigma / around)
    s = sigma - turns * around - path[piece, SIGMA]
    return path[piece, TAU] + turns * 2.0 * math.pi + path[piece, CURVATURE] * s


@equation
def reach(theta: float, d: float, l: float, r: float) -> tuple[float, float]:
    """Compute the way from the centre of mass to the centre of the disk that touches [m]."""
    return rotated(d, -l - r, theta)


@compiled
def clearance(pose: Pose, x_f: float, y_f: float, path: Array, r: float) -> tuple[float, float]:
    """Find where the finger's disk is nearest to an object.

    Parameters
    ----------
    pose : Pose
        Pose of the object.
    x_f, y_f : float
        Centre of the finger's disk [m].
    path : ndarray, shape (M + 1, 8)
        Pieces of the path.
    r : float
        Radius of the finger's disk [m].

    Returns
    -------
    sigma : float
        The nearest position along the path [m].
    gap : float
        Distance between disk and outline [m]; negative where they overlap.
    """
    p_x, p_y = rotated(x_f - pose.x, y_f - pose.y, -pose.angle)
    sigma, gap = 0.0, math.inf
    for piece in range(len(path) - 1):
        curvature, length = path[piece, CURVATURE], path[piece, LENGTH]
        t_x, t_y = path[piece, T_X], path[piece, T_Y]
        # The disk's centre seen from where the path's piece starts, along t and along -n.
        along = t_x * p_x + t_y * p_y - path[piece, D_START]
        outward = t_y * p_x - t_x * p_y - path[piece, L_START] - r
        if curvature == 0.0:
            s = min(max(along, 0.0), length)
            distance = math.copysign(math.hypot(along - s, outward), outward)
        else:
            # In terms that stay exact when the arc is nearly straight.
            bent = curvature * outward + 1.0
            half = length * curvature / 2.0
            turn = math.atan2(curvature * along, bent)
            # Beyond the ends of the piece, the nearer end.
            turn -= 2.0 * math.pi * math.floor((turn - half) / (2.0 * math.pi) + 0.5)
            distance = ((along * along + outward * outward) * curvature + 2.0 * outward) / (
                math.hypot(curvature * along, bent) + 1.0
            )
            if not 0.0 <= turn <= 2.0 * half:
                turn = min(max(turn, 0.0), 2.0 * half)
                end_x = math.sin(turn) / curvature
                end_y = -2.0 * math.sin(turn / 2.0) ** 2 / curvature
                distance = math.copysign(math.hypot(along - end_x, outward - end_y), distance)
            s = turn / curvature
        if abs(distance) < abs(gap):
            sigma, gap = path[piece, SIGMA] + s, distance
    return sigma, gap
