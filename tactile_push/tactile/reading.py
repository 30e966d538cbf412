# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What the sensor says at one moment."""

import math
from dataclasses import dataclass


@dataclass(frozen=True)
class Reading:
    """One reading of the hemispherical sensor (Section V.A).

    Parameters
    ----------
    azimuth : float
        Angle about the pole [rad], in (-pi, pi]; NaN without contact.
    elevation : float
        Angle from the equator to the contact [rad], in [0, pi/2]; NaN without contact.
    normal_force : float
        Force along the normal [N]; NaN where it is not measured.
    """

    azimuth: float
    elevation: float
    normal_force: float = math.nan

    @property
    def in_contact(self) -> bool:
        """Whether the sensor feels a contact."""
        return not (math.isnan(self.azimuth) and math.isnan(self.elevation))


NO_CONTACT = Reading(math.nan, math.nan)
