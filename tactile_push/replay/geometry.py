# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What `contact_geometry` did with a bag's readings."""

import math
from collections.abc import Mapping
from dataclasses import replace
from functools import partial
from typing import Any

from tactile_push.interface import GEOMETRY_STATE
from tactile_push.parameters.contact_geometry import (
    ContactGeometryParameters,
    make_finder,
    take_values,
)
from tactile_push.pipeline import Felt, Geometry, by_name
from tactile_push.pipeline.geometry import UNREADABLE
from tactile_push.pipeline.stamps import seconds_since, stamp_of
from tactile_push.tactile import REFUSALS


class ReplayedGeometry:
    """Finds the contacts of a bag's readings as the node did.

    What the node had heard of the joints when a reading came depends on how fast the messages
    travelled, which a bag does not tell. `contact_geometry/state` has the readings in the order in
    which the node took them, and for each how far the joints had turned. Without that topic,
    readings and joint states are taken in the bag's order.
    """

    def __init__(self, values: ContactGeometryParameters, epoch: int) -> None:
        self._values = values
        self.step = Geometry(make_finder(values), values.joint_names, partial(seconds_since, epoch))
        self._started = False

    def change(self, values: Mapping[str, Any]) -> None:
        """Take values of parameters that changed while the node ran."""
        self._values = replace(self._values, **values)
        take_values(self.step.finder, self._values)

    def tactile(self, message: Any) -> Felt:
        """Take a message of `tactile` and return what comes of the reading."""
        return self.step.tactile(stamp_of(message), message.name, message.position)

    def state(self, message: Any) -> Felt | None:
        """Take a message of `contact_geometry/state` and return what comes of the reading.

        It is None until the node accepted a reading in the bag: before, the node may have refused
        readings for something that happened before the recording.
        """
        values = by_name(message.name, message.position)
        try:
            refused = REFUSALS[int(values['refusal'])]
        except (KeyError, IndexError, ValueError):
            raise ValueError(
                f'{GEOMETRY_STATE}: refusal: expected 0 to {len(REFUSALS) - 1}, '
                f'got {values.get("refusal", "nothing")}'
            ) from None
        self._started = self._started or not refused
        if not self._started:
            return None
        angle = values.get('joint_angle', math.nan)
        names = () if refused == UNREADABLE else message.name
        felt = self.step.tactile(stamp_of(message), names, message.position, angle)
        if math.isnan(angle) and felt.refusal and refused:
            return felt._replace(refusal=refused)  # why the node knew of no joint angle
        return felt
