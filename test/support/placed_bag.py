# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""A bag of three goals; what it says is in `placed_tables`."""

from support.placed_tables import states, truth
from support.pushed_bag import JOINTS, POSE, START, joint_state, pose
from tactile_push.bags import BagWriter


def rows(columns):
    """Yield time and values of each row of a table."""
    for k, time in enumerate(columns['time'].tolist()):
        yield time, {name: column[k] for name, column in columns.items() if name != 'time'}


def placed_bag(folder, places=True):
    """Write the bag, with or without `place/state`, and return its folder."""
    state, poses = truth()
    messages = [(t, '/ground_truth/state', joint_state(t, **values)) for t, values in rows(state)]
    messages += [
        (t, '/ground_truth/object_pose', pose(t, *values.values())) for t, values in rows(poses)
    ]
    if places:
        messages += [(t, '/place/state', joint_state(t, **values)) for t, values in rows(states())]
    with BagWriter(folder) as bag:
        for topic in dict.fromkeys(topic for _, topic, _ in messages):
            bag.add_topic(topic, POSE if topic.endswith('pose') else JOINTS)
        for t, topic, data in sorted(messages):
            now = START + round(t * 1e9)
            bag.write(topic, data, now, now)
    return folder
