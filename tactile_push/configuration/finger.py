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
"""The finger's two links as parameters, for the nodes that need to know where the finger is."""

from types import SimpleNamespace

from tactile_push.configuration.parameter import Parameter
from tactile_push.tactile import PlanarFinger

LINKS = (
    Parameter(
        'proximal_length',
        0.06,
        'm',
        'distance between the moving joints of the finger',
        1e-3,
        1.0,
        read_only=True,
    ),
    Parameter(
        'distal_length',
        0.08,
        'm',
        'distance from the last joint to the centre of the disk',
        1e-3,
        1.0,
        read_only=True,
    ),
    Parameter(
        'mount_angle',
        1.5707963267948966,
        'rad',
        'angle of the finger at joint angles zero',
        -6.3,
        6.3,
        read_only=True,
    ),
)


def make_finger(p: SimpleNamespace) -> PlanarFinger:
    """Make the finger from the values of the parameters.

    Parameters
    ----------
    p : SimpleNamespace
        The values by name.

    Returns
    -------
    PlanarFinger
        Its two links.
    """
    return PlanarFinger(p.proximal_length, p.distal_length, p.mount_angle)
