# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What the doctor sees of a finger that is well, and of one that is not."""

from dataclasses import replace

from tactile_push.doctor import RIGHT, Endpoint, Heard, Snapshot, findings
from tactile_push.interface import (
    COMMAND,
    CONTACT,
    CONTACT_GEOMETRY,
    CONTROLLER_STATE,
    FINGER_BASE,
    FINGER_DISK,
    JOINT_STATES,
    PUSH_CONTROLLER,
    SENSOR_DRIVER,
    TACTILE,
    TOPICS,
)

JOINTS = ['proximal_joint', 'distal_joint']
ANGLES = ({'azimuth': 0.0, 'elevation': 1.2},)
LOOP = (SENSOR_DRIVER, CONTACT_GEOMETRY, PUSH_CONTROLLER)


def ends(topic, *nodes, **other):
    kind = {'type_name': TOPICS[topic].type_name, 'reliable': True, **other}
    return tuple(Endpoint(node, **kind) for node in nodes)


WELL = Snapshot(
    nodes=LOOP,
    states={SENSOR_DRIVER: 'active', PUSH_CONTROLLER: 'active'},
    publishers={
        TACTILE: ends(TACTILE, SENSOR_DRIVER),
        JOINT_STATES: ends(JOINT_STATES, 'joint_state_broadcaster'),
        CONTACT: ends(CONTACT, CONTACT_GEOMETRY),
        COMMAND: ends(COMMAND, PUSH_CONTROLLER),
        CONTROLLER_STATE: ends(CONTROLLER_STATE, PUSH_CONTROLLER),
    },
    subscriptions={
        TACTILE: ends(TACTILE, CONTACT_GEOMETRY, reliable=False),
        JOINT_STATES: ends(JOINT_STATES, CONTACT_GEOMETRY, PUSH_CONTROLLER, reliable=False),
        CONTACT: ends(CONTACT, PUSH_CONTROLLER, reliable=False),
        COMMAND: ends(COMMAND, PUSH_CONTROLLER, 'own_finger'),
    },
    heard={
        TACTILE: Heard(150, 3.0, ages=(0.001, 0.002, 0.03), values=ANGLES),
        JOINT_STATES: Heard(150, 3.0, ages=(0.001,), values=(dict.fromkeys(JOINTS, 0.0),)),
        CONTACT: Heard(150, 3.0, frames=frozenset({FINGER_DISK})),
        COMMAND: Heard(30, 3.0, frames=frozenset({FINGER_BASE})),
        CONTROLLER_STATE: Heard(30, 3.0, ages=(0.001,)),
    },
    parameters={
        SENSOR_DRIVER: {'use_sim_time': False},
        CONTACT_GEOMETRY: {
            'use_sim_time': False,
            'finger_radius': 0.0135,
            'joint_names': JOINTS,
            'use_joint_states': True,
        },
        PUSH_CONTROLLER: {
            'use_sim_time': False,
            'finger_radius': 0.0135,
            'joint_names': JOINTS,
            'use_joint_states': True,
            'control_rate': 10.0,
            'contact_timeout': 0.3,
        },
    },
    health=dict.fromkeys(LOOP, (0, 'well')),
)


def changed(seen=WELL, **fields):
    """Return a snapshot with entries of some of its mappings replaced; None leaves one out."""
    new = {}
    for name, entries in fields.items():
        merged = {**getattr(seen, name), **entries}
        new[name] = {key: value for key, value in merged.items() if value is not None}
    return replace(seen, **new)


def faults(seen):
    return [finding for finding in findings(seen) if finding.verdict != RIGHT]
