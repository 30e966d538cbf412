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
"""Where on the edge the finger is, once the object translates (Section III, eq. (17))."""

import math


def contact_of_translation(theta: float, phi: float, l: float) -> float:
    """Give the contact d of an object that translates, eq. (17).

    The ray of pushing passes through the centre of mass. The paper's two branches are the same
    function, -l / tan(phi - theta), since the tangent repeats after pi; straight pushes give 0.

    Parameters
    ----------
    theta : float
        Sensed angle of the pushed edge [rad].
    phi : float
        Push angle [rad], 0 < phi - theta < pi.
    l : float
        Distance from the edge to the centre of mass [m].

    Returns
    -------
    float
        d [m].

    Raises
    ------
    ValueError
        If the finger does not move into the object.
    """
    beta = phi - theta
    if not 0.0 < beta < math.pi:
        raise ValueError(f'phi - theta: expected an angle between 0 and pi rad, got {beta}')
    return -l * math.cos(beta) / math.sin(beta)
