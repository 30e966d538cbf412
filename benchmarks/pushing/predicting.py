# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Predictions of measured pushes, and their errors."""

import cmath
import math
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from pushing.records import FORCE_SHARE, Pushes, Way
from tactile_push.mechanics import (
    FREE,
    SLIP_LEFT,
    STICK,
    Body,
    Pose,
    Slider,
    Support,
    clearance,
    contact_mode,
    friction_cone,
    sticking_twist,
    tangent_angle,
)
from tactile_push.mechanics.exact_motion import exact_sticking

TOUCH = 1e-9  # a gap up to this is a contact after a push [m]
FORCE_STEPS = 25  # of a push, after which the force is looked at


class Errors(NamedTuple):
    """Errors of predicted final poses, [m] and [rad], shape (N,) each."""

    position: np.ndarray
    angle: np.ndarray

    def figures(self) -> dict[str, float]:
        """Return mean and median in millimetres and degrees."""
        millimetres, degrees = 1000.0 * self.position, np.degrees(self.angle)
        return {
            'mean_mm': float(millimetres.mean()),
            'mean_deg': float(degrees.mean()),
            'median_mm': float(np.median(millimetres)),
            'median_deg': float(np.median(degrees)),
        }


def moved(pose: Pose, x: float, y: float) -> Pose:
    """Return the pose of a point of the object instead of its origin's."""
    sin, cos = math.sin(pose.angle), math.cos(pose.angle)
    return Pose(pose.x + cos * x - sin * y, pose.y + sin * x + cos * y, pose.angle)


@dataclass(frozen=True)
class Physics:
    """What is assumed of an object's friction."""

    support: Support
    mu_c: float
    tilt: float = 0.0  #: mu_s times the height of the push above the support [m]
    spread: float = math.nan  #: of the support, if it has one


def final_poses(pushes: Pushes, physics: Physics) -> list[Pose]:
    """Predict where every push ends."""
    slider = _slider(pushes, physics)
    x, y = physics.support.centre
    return [
        moved(slider.pushed(begin, start, stop, physics.mu_c, pushes.tip_radius), -x, -y)
        for begin, (start, stop) in _ways(pushes, slider, physics)
    ]


def predict(pushes: Pushes, physics: Physics) -> Errors:
    """Predict every push and compare the final poses."""
    position, angle = [], []
    for predicted, end in zip(final_poses(pushes, physics), pushes.ends, strict=True):
        position.append(math.hypot(predicted.x - end.x, predicted.y - end.y))
        angle.append(abs(math.remainder(predicted.angle - end.angle, 2.0 * math.pi)))
    return Errors(np.array(position), np.array(angle))


def force_errors(pushes: Pushes, physics: Physics) -> np.ndarray:
    """Return by what angle the predicted force points elsewhere than the measured one [rad].

    The predicted one is the mean direction in steps over the last part of the contact. A push that
    does not move the object is NaN.
    """
    slider = _slider(pushes, physics)
    body = slider.body(pushes.tip_radius)
    angles = []
    for (pose, (start, stop)), force in zip(
        _ways(pushes, slider, physics), pushes.forces, strict=True
    ):
        way = complex(stop[0] - start[0], stop[1] - start[1])
        found = []
        for a, b in pairwise(np.linspace(start, stop, FORCE_STEPS + 1)):
            pose = slider.pushed(pose, tuple(a), tuple(b), physics.mu_c, pushes.tip_radius)
            found += _force(body, pose, b, way / abs(way), physics.mu_c, pushes.tip_radius)
        mean = sum(found[len(found) - math.ceil(FORCE_SHARE * len(found)) :])
        angles.append(abs(cmath.phase(mean / complex(*force))) if mean else math.nan)
    return np.array(angles)


def _force(
    body: Body, pose: Pose, finger: np.ndarray, way: complex, mu_c: float, r: float
) -> list[complex]:
    """Return the direction of a finger's force; none if it does not push."""
    sigma, gap = clearance(pose, *finger, body.path, r)
    if gap > TOUCH:
        return []
    tangent = cmath.exp(1j * (pose.angle + tangent_angle(sigma, body.path)))
    contact = complex(*finger) + 1j * r * tangent - complex(pose.x, pose.y)
    v, at = way / tangent, contact / tangent  # along the edge and into the object
    turned = cmath.exp(1j * pose.angle)
    u, place = way / turned, contact / turned
    _, _, omega = sticking_twist(v.real, v.imag, at.real, at.imag, body.c)
    _, f_x, f_y, *_ = exact_sticking(
        u.real, u.imag, omega, place.real, place.imag, body.c, body.support
    )
    f = complex(f_x, f_y) * turned / tangent
    cos_alpha, sin_alpha = friction_cone(mu_c)
    mode = contact_mode(v.real, v.imag, f.real, f.imag, cos_alpha, sin_alpha)
    if mode == FREE:
        return []
    if mode != STICK:
        f = complex(-sin_alpha if mode == SLIP_LEFT else sin_alpha, cos_alpha)
    return [f / abs(f) * tangent]


def _slider(pushes: Pushes, physics: Physics) -> Slider:
    return Slider.on(pushes.outline, physics.support, exact=True, tilt=physics.tilt)


def _ways(pushes: Pushes, slider: Slider, physics: Physics) -> Iterator[tuple[Pose, Way]]:
    """Yield the start of the slider and the tip's way, moved out of the object."""
    x, y = physics.support.centre
    path = slider.outline.path(pushes.tip_radius)
    for begin, way in zip(pushes.starts, pushes.ways, strict=True):
        pose = moved(begin, x, y)
        sigma, gap = clearance(pose, *way[0], path, pushes.tip_radius)
        theta = pose.angle + tangent_angle(sigma, path)
        back = min(gap, 0.0)
        shift = -math.sin(theta) * back, math.cos(theta) * back
        start, stop = ((at[0] + shift[0], at[1] + shift[1]) for at in way)
        yield pose, (start, stop)
