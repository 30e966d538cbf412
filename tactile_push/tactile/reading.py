# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What the sensor says at one moment."""

import math
from dataclasses import dataclass


class NotUntouchedError(ValueError):
    """What was measured is not known to be that of an untouched tip; the message says why."""


@dataclass(frozen=True)
class Reading:
    """One reading of the hemispherical sensor (Section V.A)."""

    azimuth: float  #: angle about the pole [rad], in (-pi, pi]; NaN without contact
    elevation: float  #: angle from the equator [rad], in [0, pi/2]; NaN without contact
    normal_force: float = math.nan  #: along the normal [N]; NaN where it is not measured

    @property
    def in_contact(self) -> bool:
        """Whether the sensor feels a contact."""
        return not (math.isnan(self.azimuth) and math.isnan(self.elevation))


NO_CONTACT = Reading(math.nan, math.nan)
