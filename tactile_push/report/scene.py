# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What the view from above shows beside the run: the finger and the object."""

import math
import typing
from collections.abc import Mapping

import numpy as np
import numpy.typing as npt

from tactile_push.interface import CONTACT, TRUE_POSE, TRUE_STATE
from tactile_push.paper import FINGER_RADIUS
from tactile_push.parameters import ActiveSensingParameters, SimPlantParameters
from tactile_push.parameters.sim_plant import rig_config
from tactile_push.report.columns import Table
from tactile_push.report.data import Scene
from tactile_push.report.shown import MILLIMETRES, numbers

if typing.TYPE_CHECKING:
    from tactile_push.simulation import RigConfig

SPACING = 0.001  # of points on round outlines [m]: the paper's disk looks round
NEAR = 0.001  # between contacts and a paper's outline [m]; block and disk differ by more
CORNERS = 180  # of a circle: looks round
TRIED = 50  # contacts, spread over the run; picked


def scene_of(plant: Mapping[str, object] | None, tables: Mapping[str, Table]) -> Scene:
    """Return what was pushed by what, without an object if that is not known.

    If the bag has no parameters of a plant, an object with a pose is taken for the paper's
    block or disk if the contacts lie on its outline.
    """
    radius = _radius(tables)
    if plant is not None:
        try:
            config = rig_config(SimPlantParameters.of(plant))
        except ValueError:  # of another version
            return Scene(radius)
        return Scene(config.radius, _outline(config), config.mu_c)
    from tactile_push.simulation import paper_block, paper_disk  # which loads the compiler

    for config in (paper_block(), paper_disk()):
        if _fits(config, radius, tables):
            return Scene(radius, _outline(config))
    return Scene(radius)


def told_scene(p: ActiveSensingParameters) -> Scene:
    """Return what active sensing was told of the object, and of the finger."""
    corners = p.corners
    if p.disk_radius > 0.0:
        angles = np.linspace(0.0, 2.0 * math.pi, CORNERS, endpoint=False)
        circle = p.disk_radius * np.stack([np.cos(angles), np.sin(angles)], axis=1)
        corners = [(x, y) for x, y in circle.tolist()]
    return Scene(p.finger_radius, corners)


def scene_content(scene: Scene) -> dict[str, object]:
    """Return a scene as the view's script takes it, in millimetres."""
    mu_c = scene.mu_c
    return {
        'radius': scene.radius * MILLIMETRES,
        'outline': [numbers(MILLIMETRES * np.array(point), 3) for point in scene.outline],
        'mu_c': 'infinite' if mu_c == math.inf else mu_c,
    }


def _outline(config: 'RigConfig') -> list[tuple[float, float]]:
    return [(x, y) for x, y in config.slider.outline.points(SPACING).tolist()]


def _radius(tables: Mapping[str, Table]) -> float:
    contact = tables.get(CONTACT)
    found = math.nan if contact is None else np.median(np.hypot(contact['x'], contact['y']))
    return float(found) if found > 0.0 else FINGER_RADIUS


def _fits(config: 'RigConfig', radius: float, tables: Mapping[str, Table]) -> bool:
    """Return whether the contacts lie on the outline."""
    truth, pose = tables.get(TRUE_STATE, {}), tables.get(TRUE_POSE, {})
    if 'theta' not in truth or not pose:
        return False
    theta = np.interp(pose['time'], truth['time'], truth['theta'])
    touching = np.flatnonzero(np.isfinite(theta))
    some = touching[:: max(1, len(touching) // TRIED)]
    normal = theta[some] + math.pi / 2.0
    x = radius * np.cos(normal) - pose['x'][some]
    y = radius * np.sin(normal) - pose['y'][some]
    cos, sin = np.cos(pose['yaw'][some]), np.sin(pose['yaw'][some])
    contacts = np.stack([cos * x + sin * y, cos * y - sin * x], axis=1)
    return len(some) > 0 and bool((_distances(contacts, _outline(config)) < NEAR).all())


def _distances(points: npt.NDArray[np.float64], outline: npt.ArrayLike) -> npt.NDArray[np.float64]:
    """Return how far points are from a closed outline of straight edges [m]."""
    starts = np.asarray(outline)
    edges = np.roll(starts, -1, axis=0) - starts
    from_start = points[:, np.newaxis] - starts
    part = np.clip((from_start * edges).sum(-1) / (edges**2).sum(-1), 0.0, 1.0)
    return np.linalg.norm(from_start - part[..., np.newaxis] * edges, axis=-1).min(axis=1)
