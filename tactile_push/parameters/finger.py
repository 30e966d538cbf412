# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The finger's two links as parameters, for the nodes that need to know where the finger is."""

from types import SimpleNamespace

from tactile_push.parameters.parameter import Parameter
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
