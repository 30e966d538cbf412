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
"""An experiment without clocks and processes: the same rig, sensor geometry and law."""

import numpy as np

from tactile_push.control import PushLaw, finger_velocity
from tactile_push.simulation.rig import Rig, RigConfig
from tactile_push.simulation.rollout import Rollout, check_time
from tactile_push.tactile import ReadingRejectedError, contact_of_reading

UPRIGHT = 1e-9  # |cos(elevation) sin(azimuth)| of the simulated face, but for rounding


def experiment(config: RigConfig, law: PushLaw, steps: int, period: float = 0.1) -> Rollout:
    """Run the control law on the rig, through its sensor and its finger.

    Parameters
    ----------
    config : RigConfig
        The rig and where it starts.
    law : PushLaw
        The control law, fresh or reset: it goes on from where it is, and is changed.
    steps : int
        Number of control periods.
    period : float, optional
        Control period [s].

    Returns
    -------
    Rollout
        The trajectory, shorter than `steps` if contact is lost.
    """
    check_time(steps, period)
    rig = Rig(config)
    rows = []
    modes = []
    end = 'done'
    for k in range(steps + 1):
        try:
            contact = contact_of_reading(rig.reading(), rig.finger_pose.psi, config.radius, UPRIGHT)
        except ReadingRejectedError as rejected:
            end = str(rejected)
            break
        phi = law.update(contact.theta)
        rows.append((contact.theta, phi, rig.d, rig.object_pose.x, rig.object_pose.y))
        if k < steps:
            rig.step(finger_velocity(phi, config.belt_speed), period)
        modes.append(rig.mode)
    theta, phi, d, x, y = np.array(rows).T
    return Rollout(theta, phi, d, x, y, np.array(modes), end)
