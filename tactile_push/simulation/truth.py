# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What only the simulator knows, as numbers by the names of `ground_truth/state`."""

import math
from typing import TYPE_CHECKING

from tactile_push.simulation.rig import Rig

if TYPE_CHECKING:
    from tactile_push.simulation.mujoco_rig import MujocoRig


def true_values(rig: 'Rig | MujocoRig', v_x_commanded: float) -> dict[str, float]:
    """Return the truth about a rig.

    Parameters
    ----------
    rig, v_x_commanded : Rig or MujocoRig, float
        The rig, and the velocity across the belt that its finger was commanded [m/s].

    Returns
    -------
    dict of str to float
        The numbers of `ground_truth/state`, in SI units.
    """
    return {
        'theta': rig.theta if rig.touching else math.nan,
        'd': rig.d if rig.touching else math.nan,
        'phi': rig.phi,
        'mode': float(rig.mode),
        'v_x': rig.v_x,
        'v_x_commanded': v_x_commanded,
        'finger_x': rig.finger_x,
        'psi': rig.psi,
        'belt_speed': rig.v_y,
        'belt_travel': rig.belt_travel,
        'object_x': rig.finger_pose.x + rig.object_in_finger_disk.x,
        'edge_angle': rig.theta,
        'lifted': float(rig.lifted),
        'along': rig.along,
    }
