# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What a finger pushed and how far its edge is from the centre of mass, by the recorded parameters.

The simulator knows. Where there is none, it is what active sensing was told.
"""

import math
from collections.abc import Mapping
from typing import NamedTuple

from tactile_push.interface import ACTIVE_SENSING, PLANTS, POINTS, node_in
from tactile_push.paper import (
    BLOCK,
    BLOCK_EDGE,
    BLOCK_L,
    DISK,
    DISK_RADIUS,
    FINGER_RADIUS,
    OTHER,
    object_with,
)
from tactile_push.parameters import ActiveSensingParameters

# The parameters of a plant that are the sizes of an object, l last, and the paper's values.
SIZES = {
    BLOCK: {'edge_length': BLOCK_EDGE, 'edge_to_cm': BLOCK_L},
    DISK: {'disk_radius': DISK_RADIUS},
}
OUTLINE = {'vertices', 'disk_radius'}  # the parameters of `active_sensing` that tell the object
AT_CENTRE = POINTS[0]
ALIKE = 1e-3  # of lengths, in units of themselves


class Pushed(NamedTuple):
    """An object as far as it is known: `BLOCK`, `DISK` or `OTHER`, and l [m]; None is unknown."""

    object: str | None = None
    l: float | None = None
    remark: str = ''  # why l is not known, or what else nodes were told of it; empty if nothing
    # Of the contact from the point of the tip that follows the commands [m]: the radius if this is
    # the centre. The pole is near the contact.
    lever: float = FINGER_RADIUS


def pushed_object(parameters: Mapping[str, Mapping[str, object]], namespace: str) -> Pushed:
    """Return what the finger in a namespace pushed, by the parameters of its nodes."""
    plant, sensing = plant_in(namespace, parameters), node_in(namespace, ACTIVE_SENSING)
    pushed, l = plant_object(parameters.get(plant, {}))
    told, possible = _told_object(parameters.get(sensing, {}))
    words = ' or '.join(f'{one * 1e3:g}' for one in possible) + ' mm'
    remark = ''
    if l is None and len(possible) == 1:
        l = possible[0]
    elif l is None and possible:
        remark = f'l is not known: /{sensing} was not told which edge is pushed, so l is {words}'
    elif l is not None and possible and not any(_alike(l, one) for one in possible):
        remark = (
            f'l is {l * 1e3:g} mm by the parameters of /{plant} and {words} by those of /{sensing}'
        )
    lever = _lever(parameters.get(plant, {}) or parameters.get(sensing, {}))
    return Pushed(told if pushed is None else pushed, l, remark, lever)


def plant_in(namespace: str, parameters: Mapping[str, Mapping[str, object]]) -> str:
    """Return the name of a finger's simulated plant, by which its recorded parameters go."""
    names = [node_in(namespace, node) for node in PLANTS]
    return next((name for name in names if name in parameters), names[0])


def plant_object(plant: Mapping[str, object]) -> tuple[str | None, float | None]:
    """Return what the plant with these parameters pushes, and its l [m].

    The object is `BLOCK` or `DISK` if it has the paper's sizes, otherwise `OTHER`.
    """
    if 'object' not in plant:
        return None, None
    named = str(plant['object'])
    sizes = SIZES.get(named, {})
    given = {name: plant[name] for name in sizes if name in plant}
    l = given.get(list(sizes)[-1]) if sizes else None
    return (
        named if sizes and all(given[name] == sizes[name] for name in given) else OTHER,
        l if isinstance(l, float) and math.isfinite(l) and l > 0.0 else None,
    )


def _lever(finger: Mapping[str, object]) -> float:
    """Return the lever of a finger by the parameters of a node that was told of it [m]."""
    if finger.get('commanded_point', AT_CENTRE) != AT_CENTRE:
        return 0.0
    radius = finger.get('finger_radius')
    return radius if isinstance(radius, float) and math.isfinite(radius) else FINGER_RADIUS


def _told_object(sensing: Mapping[str, object]) -> tuple[str | None, list[float]]:
    """Return what active sensing was told of the object, and each l that this leaves possible."""
    if not OUTLINE & set(sensing):
        return None, []
    try:
        told = ActiveSensingParameters.of(sensing)
    except ValueError:  # of another version
        return None, []
    distances = sorted(told.distances)
    if not (distances and distances[0] > 0.0):
        return None, []
    possible = distances[:1]
    for distance in distances:
        if not _alike(distance, possible[-1]):
            possible.append(distance)
    return object_with(told.corners, told.disk_radius), possible


def _alike(one: float, other: float) -> bool:
    return math.isclose(one, other, rel_tol=ALIKE)
