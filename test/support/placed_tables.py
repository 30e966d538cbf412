# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What a bag of three goals says, as columns: placed, missed and given up for another one."""

import math

import numpy as np

from tactile_push.control.placing.stages import REASONS, STAGES, VERDICTS

# When each goal is taken and ends, and what it is [s, s, m, rad].
PLACED, MISSED, PREEMPTED = GOALS = (
    (2.0, 12.0, -0.05, 0.1),
    (14.0, 20.0, -0.06, -0.2),
    (21.0, 23.0, -0.07, 0.0),
)
LAST = (23.0, 25.0, -0.04, 0.3)  # still served at the end
LIFTED = 12.04, 14.5  # the finger is up
BELT, V_Y = 0.3, 0.005
OFF = 0.0002, -0.001  # of the object that is placed [m, rad]
R = 0.0135


def states():
    """Return the columns of `place/state`."""
    rows = []
    for k in range(250):
        t = 0.1 * k
        row = {'time': t, 'stage': 'no goal', 'goals': 0.0, 'reachable': 'unknown', 'reason': ''}
        row |= dict.fromkeys(('goal_x', 'goal_theta', 'd', 'belt_left', 'x_miss', 'theta_miss'))
        for number, (start, end, x, theta) in enumerate((*GOALS, LAST), 1):
            if t < start - 1e-9:
                break
            left = BELT - V_Y * (min(t, end) - start)
            row |= {'goals': float(number), 'goal_x': x, 'goal_theta': theta, 'belt_left': left}
            stage = 'lifted' if t < start + 0.45 else 'learning' if t < start + 0.95 else 'placing'
            row |= {'stage': stage, 'd': 0.001 * number}
            if stage == 'lifted':  # as the goal before has left it
                row['belt_left'] = 0.1
            # Before d is known it may look otherwise.
            row |= {'reachable': 'unknown', 'reason': '', 'x_miss': None, 'theta_miss': None}
            if t > start + 0.65:
                row |= {'reachable': 'out of reach', 'reason': 'contact'}
            if t > start + 0.95:
                row |= {'x_miss': 1e-4 * number, 'theta_miss': -1e-3}
                row |= {'reachable': 'with reserve', 'reason': ''}
            if number == 2 and t > start + 0.95:
                row |= {'reachable': 'out of reach', 'reason': 'friction'}
            if t > end - 1e-9:
                row['stage'] = {1: 'released', 2: 'missed'}.get(number, 'placing')
        rows.append(row)
    codes = {'stage': STAGES, 'reachable': VERDICTS, 'reason': REASONS}
    columns = {
        name: np.array(
            [codes[name].index(row[name]) if name in codes else row[name] for row in rows],
            dtype=float,
        )
        for name in rows[0]
    }
    columns['reach_reason'] = columns.pop('reason')
    return columns


def truth():
    """Return the columns of `ground_truth/state` and of `ground_truth/object_pose`.

    The finger goes straight ahead at x = -0.06, and the object keeps its place on it while the
    finger is down.
    """
    time = 0.02 * np.arange(1250)
    lifted = (time >= LIFTED[0]) & (time < LIFTED[1])
    object_x = np.where(time < LIFTED[1], PLACED[2] + OFF[0], -0.055)
    theta = np.where(time < LIFTED[1], PLACED[3] + OFF[1], 0.2)
    behind = np.where(lifted, V_Y * (time - LIFTED[0]), 0.0)
    state = {
        'time': time,
        'lifted': lifted.astype(float),
        'object_x': object_x,
        'edge_angle': theta,
        'belt_travel': V_Y * time,
        'd': np.where(lifted, math.nan, 0.0012),
    }
    pose = {'time': time, 'x': object_x + 0.06, 'y': 0.037 - behind, 'yaw': theta - 0.5}
    return state, pose
