# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What is pushed by what, as the parameters of the running nodes tell."""

from collections.abc import Mapping
from typing import Any

from tactile_push.interface import ACTIVE_SENSING, node_in
from tactile_push.paper import FINGER_RADIUS
from tactile_push.parameters import ActiveSensingParameters
from tactile_push.parameters.recorded import usable_parameters
from tactile_push.report.data import Scene
from tactile_push.report.pushed import plant_in
from tactile_push.report.scene import scene_of, told_scene


def known_scene(parameters: Mapping[str, Mapping[str, Any]], namespace: str) -> Scene:
    """Return what the finger in a namespace pushes, without an object if no node knows it.

    A simulator knows. Where there is none, it is what active sensing was told.
    """
    usable, _ = usable_parameters(parameters)
    plant = usable.get(plant_in(namespace, usable))
    if plant is not None:
        return scene_of(plant, {})
    told = usable.get(node_in(namespace, ACTIVE_SENSING))
    return Scene(FINGER_RADIUS) if told is None else told_scene(ActiveSensingParameters.of(told))
