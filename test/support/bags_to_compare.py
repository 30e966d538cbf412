# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Topics of bags that are compared."""

from support.bag_making import encode, joint_state

JOINT_STATE = 'sensor_msgs/msg/JointState'
CLOCK = 'rosgraph_msgs/msg/Clock'
STATE = '/push_controller/state'
PERIOD = 100_000_000  # [ns]
LATE = 3_000_000  # between a stamp and its log time [ns]


def states(count=5, start=0, change=None, **more):
    """Return states with a stamp each 0.1 s; `change` gives other values by their number."""
    messages = []
    for k in range(start, start + count):
        values = {'theta': 0.1 * k, 'phi': 1.5, **more, **((change or {}).get(k, {}))}
        messages.append((k * PERIOD + LATE, joint_state(k * PERIOD, **values)))
    return JOINT_STATE, messages


def clocks(*times):
    fields = [
        {'clock': dict(zip(('sec', 'nanosec'), divmod(t, 10**9), strict=True))} for t in times
    ]
    return CLOCK, [(t, encode(CLOCK, **field)) for t, field in zip(times, fields, strict=True)]
