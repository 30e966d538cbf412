# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Topics and notes of bags of which is known what is in them."""

import json
import math

from support.bag_making import encode, joint_state

JOINT_STATE = 'sensor_msgs/msg/JointState'
CLOCK = 'rosgraph_msgs/msg/Clock'
STATE = '/push_controller/state'
BAND = math.radians(3.0)
PERIOD = 100_000_000  # [ns]
NOTES = {
    'tactile_push.version': '1.2.3',
    'tactile_push.parameters': json.dumps(
        {
            'sim_plant': {'object': 'block', 'edge_to_cm': 0.02375, 'disk_radius': 0.0285},
            'push_controller': {'kp': 0.05, 'joint_names': ['a', 'b'], 'max': math.inf},
            'left/sim_plant': {'object': 'disk', 'edge_to_cm': 0.02375, 'disk_radius': 0.0285},
        }
    ),
}


def clocks(*times):
    return CLOCK, [(time, encode(CLOCK)) for time in times]


def pushes(theta_desired, count=450, settled=192, late=0, **more):
    """Return the states of a push that is 4 degrees off until it settles exactly, and phi."""
    messages = []
    for k in range(count):
        theta = theta_desired + math.radians(4.0) * (k < settled)
        values = {'theta': theta, 'theta_desired': theta_desired, 'phi': math.radians(82.5)}
        values |= {'state': 2.0, 'stop_reason': 0.0, 'silence': 0.0, 'v_x': 0.001, **more}
        messages.append((late + k * PERIOD, joint_state(k * PERIOD, **values)))
    return JOINT_STATE, messages
