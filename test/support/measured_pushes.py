# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Pushes as an experiment would write them down, made up with known numbers."""

import cmath
import math

import numpy as np

from tactile_push.identification.records import pushes_of
from tactile_push.mechanics import Outline, Pose, Slider
from tactile_push.simulation import read_json

RADIUS = 0.005  # of the tip
# The origin of the file's frame is far from the centroid (0.025, 0.0216).
VERTICES = [[0.0, 0.0], [0.06, 0.0], [0.05, 0.04], [0.0, 0.05]]
OUTLINE = Outline.polygon(VERTICES)


def placed(pose, x, y):
    """Give where a point of the object is, as a complex number."""
    return complex(pose[0], pose[1]) + cmath.exp(1j * pose[2]) * complex(x, y)


def measured(support, mu_c, start, tip_start, tip_end, tilt=0.0):
    """Push an object in a file's frame, as an experiment would write it down."""
    x, y = support.centre
    slider = Slider.on(OUTLINE, support, exact=True, tilt=tilt)
    middle = placed(start, x, y)
    moved = slider.pushed(
        Pose(middle.real, middle.imag, start[2]), tip_start, tip_end, mu_c, RADIUS
    )
    end = complex(moved.x, moved.y) - cmath.exp(1j * moved.angle) * complex(x, y)
    return {
        'tip_start': list(tip_start),
        'tip_end': list(tip_end),
        'object_start': list(start),
        'object_end': [end.real, end.imag, moved.angle],
    }


def ways(count, seed=1):
    """Give starts of the object and straight ways of the tip against one of its sides."""
    for start, (begin, end), _ in sided_ways(count, seed, (0.2, 0.8)):
        yield start, begin, end


def sided_ways(count, seed, share):
    """Give them with the number of the side; the ways begin over a share of it from to."""
    random = np.random.default_rng(seed)
    for _ in range(count):
        start = (*random.uniform(-0.3, 0.3, 2), random.uniform(-3.0, 3.0))
        side = random.integers(4)
        a, b = np.array(VERTICES[side]), np.array(VERTICES[(side + 1) % 4])
        outward = np.array([b[1] - a[1], a[0] - b[0]]) / np.hypot(*(b - a))
        along = (b - a) / np.hypot(*(b - a))
        begin = a + random.uniform(*share) * (b - a) + (RADIUS + 0.003) * outward
        end = begin - 0.02 * outward + random.uniform(-0.01, 0.01) * along
        tips = [placed(start, *point) for point in (begin, end)]
        yield start, [(tip.real, tip.imag) for tip in tips], side


def content(pushes, **more):
    return {
        'surface': 'made up',
        'outline': {'kind': 'polygon', 'vertices': VERTICES},
        'tip_radius': RADIUS,
        'pushes': pushes,
        **more,
    }


def pushes_in(file, known=None):
    """Read a file of pushes."""
    return pushes_of(read_json(file), file, known)


def deviation(one, other):
    """Give how far and by what angle final poses differ, [m] and [rad]."""
    ends = [np.array([push['object_end'] for push in pushes]) for pushes in (one, other)]
    offset = ends[0] - ends[1]
    turned = (offset[:, 2] + math.pi) % (2.0 * math.pi) - math.pi
    return np.hypot(offset[:, 0], offset[:, 1]), np.abs(turned)


def translation(overlap, length, yaw):
    """Push a square centred in its frame at its middle, head on, from inside it by some way."""
    start = (0.1, -0.2, yaw)
    begin = placed(start, 0.0, -0.02 - RADIUS + overlap)
    end = begin + cmath.exp(1j * yaw) * 1j * length
    moved = max(length - max(-overlap, 0.0), 0.0) * cmath.exp(1j * yaw) * 1j
    return {
        'tip_start': [begin.real, begin.imag],
        'tip_end': [end.real, end.imag],
        'object_start': list(start),
        'object_end': [start[0] + moved.real, start[1] + moved.imag, yaw],
    }


def integrated(support, mu_c, pushes, steps=15):
    """Return where pushes end by the balance of forces, without the package's mechanics.

    `pushes` are of `ways`, with the side that is pushed. About the contact the frictions under the
    object have no moment, which is where their power is least. The contact sticks if the force
    that it needs is in the friction cone; otherwise it slips as fast as brings it to the cone's
    edge. All pushes go on together, by the midpoint rule.
    """
    starts, tips, sides = (np.array(column) for column in zip(*pushes, strict=True))
    places, loads = support.points[:, 0] + 1j * support.points[:, 1], support.loads
    corners = np.array(VERTICES) @ [1.0, 1.0j]
    edge = np.roll(corners, -1)[sides] - corners[sides]
    inward, corner = 1j * edge / np.abs(edge), corners[sides]
    tip, velocity = tips[:, 0] @ [1.0, 1.0j], (tips[:, 1] - tips[:, 0]) @ [1.0, 1.0j]

    def turning_and_force(u, at):
        lower, upper = -200.0 * np.abs(u), 200.0 * np.abs(u)
        for _ in range(26):
            omega = (lower + upper) / 2.0
            v = u[:, np.newaxis] + 1j * omega[:, np.newaxis] * at
            v /= np.abs(v) + 1e-300
            grows = ((v.conj() * 1j * at).real * loads).sum(axis=1) > 0.0
            lower, upper = np.where(grows, lower, omega), np.where(grows, omega, upper)
        return omega, (v * loads).sum(axis=1)

    def rates(origin, angle, finger):
        turned = np.exp(1j * angle)
        normal = inward * turned
        contact = finger + RADIUS * normal
        at = origin[:, np.newaxis] + turned[:, np.newaxis] * places - contact[:, np.newaxis]
        _, force = turning_and_force(velocity, at)
        along = (force / normal).imag  # to the left
        sense = np.sign(along)
        sticks = np.abs(along) <= mu_c * (force / normal).real
        least, most = np.zeros(len(sense)), 4.0 * np.abs(velocity)
        for _ in range(22):
            slip = (least + most) / 2.0
            _, force = turning_and_force(velocity - sense * slip * 1j * normal, at)
            beyond = sense * (force / normal).imag > mu_c * (force / normal).real
            least, most = np.where(beyond, slip, least), np.where(beyond, most, slip)
        u = velocity - np.where(sticks, 0.0, sense * slip) * 1j * normal
        omega, _ = turning_and_force(u, at)
        return u - 1j * omega * (contact - origin), omega

    origin, angle = starts[:, :2] @ [1.0, 1.0j], starts[:, 2]
    normal = inward * np.exp(1j * angle)
    gap = ((origin + corner * np.exp(1j * angle) - tip) / normal).real - RADIUS
    touch = gap / (velocity / normal).real
    step = (1.0 - touch) / steps
    for k in range(steps):
        v, omega = rates(origin, angle, tip + velocity * (touch + k * step))
        halfway = tip + velocity * (touch + (k + 0.5) * step)
        v, omega = rates(origin + v * step / 2.0, angle + omega * step / 2.0, halfway)
        origin, angle = origin + v * step, angle + omega * step
    return np.stack([origin.real, origin.imag, angle], axis=-1)
