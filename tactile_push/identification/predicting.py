# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Predictions of measured pushes, and how far the measurements are from them."""

import cmath
import math
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from tactile_push.identification.records import Place, Push, Pushes, Way
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
from tactile_push.mechanics.compiled import Array
from tactile_push.mechanics.exact_motion import exact_sticking

TOUCH = 1e-9  # a gap up to this is a contact after a push [m]
FORCE_STEPS = 25  # of a push, after which the force is looked at
FORCE_SHARE = 0.6  # of the time in contact, its end, over which a measured force is the mean


@dataclass(frozen=True)
class Physics:
    """What is assumed of an object's friction."""

    support: Support
    mu_c: float
    tilt: float = 0.0  #: mu_s times the height of the push above the support [m]
    spread: float = math.nan  #: of the support, if it has one


class Errors(NamedTuple):
    """How far measured ends of pushes are from predicted ones."""

    position: Array  #: [m], shape (N,)
    angle: Array  #: [rad], shape (N,)
    force: Array  #: between directions [rad], shape (N,); NaN where there is none

    def figures(self) -> dict[str, float]:
        """Return mean and median in millimetres and degrees, by name."""
        force = np.degrees(self.force[np.isfinite(self.force)])
        found = {'mm': 1000.0 * self.position, 'deg': np.degrees(self.angle), 'force_deg': force}
        return {
            f'{name}_{unit}': float(of(values))
            for name, of in (('mean', np.mean), ('median', np.median))
            for unit, values in found.items()
            if len(values)
        }


def moved(pose: Pose, x: float, y: float) -> Pose:
    """Return the pose of a point of the object instead of its origin's.

    Parameters
    ----------
    pose : Pose
        Pose of the object.
    x, y : float
        The point in the object's frame [m].

    Returns
    -------
    Pose
        That of the point, with the object's angle.
    """
    sin, cos = math.sin(pose.angle), math.cos(pose.angle)
    return Pose(pose.x + cos * x - sin * y, pose.y + sin * x + cos * y, pose.angle)


def residuals(pushes: Pushes, physics: Physics, forces: bool = True) -> Array:
    """Predict every push and take what was measured from it.

    Parameters
    ----------
    pushes : Pushes
        The pushes. Where the measured start overlaps with the finger, the finger's way is moved out
        of the object along the contact normal.
    physics : Physics
        What is assumed.
    forces : bool, optional
        Whether to predict the directions of measured forces, too, which takes longer.

    Returns
    -------
    ndarray, shape (N, 4)
        Of the final pose x, y [m] and angle [rad], of the force's direction [rad]. That is NaN if
        no force was measured or none is predicted.
    """
    slider = Slider.on(pushes.outline, physics.support, exact=True, tilt=physics.tilt)
    x, y = physics.support.centre
    rows = []
    for push, pose, way in _ways(pushes, slider, physics):
        force = math.nan
        if forces and push.force is not None:
            pose, force = _pushed_with_force(slider, pose, way, push, physics.mu_c)
        else:
            turn = push.turn / (len(way) - 1)
            for a, b in pairwise(way):
                pose = slider.pushed(pose, a, b, physics.mu_c, push.tip_radius, turn)
        end = moved(pose, -x, -y)
        angle = math.remainder(end.angle - push.end.angle, 2.0 * math.pi)
        rows.append((end.x - push.end.x, end.y - push.end.y, angle, force))
    return np.array(rows).reshape(-1, 4)


def errors_of(residual: Array) -> Errors:
    """Return the sizes of residuals.

    Parameters
    ----------
    residual : ndarray, shape (N, 4)
        As `residuals` returns them.

    Returns
    -------
    Errors
        Distances and angles.
    """
    x, y, angle, force = residual.T
    return Errors(np.hypot(x, y), np.abs(angle), np.abs(force))


def _pushed_with_force(
    slider: Slider, pose: Pose, way: Way, push: Push, mu_c: float
) -> tuple[Pose, float]:
    """Return where a push ends, and by what angle its force points elsewhere than measured.

    The predicted one is the mean direction in steps over the last part of the contact.
    """
    assert push.force is not None
    body, radius = slider.body(push.tip_radius), push.tip_radius
    turn = push.turn / FORCE_STEPS
    start, stop = way[0], way[-1]
    along = complex(stop[0] - start[0], stop[1] - start[1])
    found = []
    if along:
        for a, b in pairwise(np.linspace(start, stop, FORCE_STEPS + 1).tolist()):
            pose = slider.pushed(pose, (a[0], a[1]), (b[0], b[1]), mu_c, radius, turn)
            found += _force(body, pose, (b[0], b[1]), along / abs(along), mu_c, radius)
    mean = sum(found[len(found) - math.ceil(FORCE_SHARE * len(found)) :])
    measured = complex(*push.force)
    return pose, cmath.phase(mean / measured) if mean and measured else math.nan


def _force(
    body: Body, pose: Pose, finger: Place, way: complex, mu_c: float, r: float
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


def _ways(pushes: Pushes, slider: Slider, physics: Physics) -> Iterator[tuple[Push, Pose, Way]]:
    """Yield pushes with the start of the slider and the tip's way, moved out of the object."""
    paths = {push.tip_radius: slider.outline.path(push.tip_radius) for push in pushes.pushes}
    for push in pushes.pushes:
        path, pose = paths[push.tip_radius], moved(push.begin, *physics.support.centre)
        sigma, gap = clearance(pose, *push.way[0], path, push.tip_radius)
        theta = pose.angle + tangent_angle(sigma, path)
        back = min(gap, 0.0)
        shift = -math.sin(theta) * back, math.cos(theta) * back
        yield push, pose, tuple((x + shift[0], y + shift[1]) for x, y in push.way)
