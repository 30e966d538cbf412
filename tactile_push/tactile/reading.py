# Copyright 2026 The tactile_push authors
#
# Licensed under the Apache License, Version 2.0 (the "License");
# you may not use this file except in compliance with the License.
# You may obtain a copy of the License at
#
#     http://www.apache.org/licenses/LICENSE-2.0
#
# Unless required by applicable law or agreed to in writing, software
# distributed under the License is distributed on an "AS IS" BASIS,
# WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
# See the License for the specific language governing permissions and
# limitations under the License.
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
