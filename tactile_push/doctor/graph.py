# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Checks of nodes, publishers and subscriptions, one question each."""

from collections import Counter
from collections.abc import Iterator

from tactile_push.doctor.finding import MISSING, RIGHT, WRONG, Finding
from tactile_push.doctor.snapshot import Endpoint, Snapshot
from tactile_push.interface import (
    COMMAND,
    COMPRESSED_IMAGE,
    CONTACT,
    CONTACT_GEOMETRY,
    CONTROLLER_STATE,
    FINGER_SERVO,
    IMAGE,
    JOINT_VELOCITIES,
    LIVE_PAGE,
    NODES,
    PLACE_GOAL,
    PLANTS,
    PUSH_CONTROLLER,
    SERVO_COMMANDS,
    SERVO_STATE,
    TACTILE,
    TOPICS,
    WRENCH,
)
from tactile_push.parameters.sensor_kinds import SENSOR_KINDS

LOOP = (CONTACT_GEOMETRY, PUSH_CONTROLLER)  # without which no finger moves
SENSORS = tuple(kind.node for kind in SENSOR_KINDS.values())
# What two nodes must not publish at a time.
OF_ONE = (
    *(WRENCH, IMAGE, COMPRESSED_IMAGE, TACTILE, CONTACT, COMMAND),
    *(CONTROLLER_STATE, SERVO_COMMANDS, SERVO_STATE),
)
# What has to reach somebody who moves the finger.
MOVES = {
    COMMAND: f'start {FINGER_SERVO}, or the driver of your finger',
    SERVO_COMMANDS: 'start the velocity controller of the joints (ros2_control)',
}


def nodes_run(seen: Snapshot) -> Iterator[Finding]:
    """Ask whether each node that the loop needs runs, and once."""
    running = Counter(seen.nodes)
    for node in NODES:
        if running[node] > 1:
            yield Finding(
                *(WRONG, node, f'{running[node]} nodes have this name'),
                'end all but one, or give another finger a namespace',
            )
        elif running[node]:
            yield Finding(RIGHT, node, 'runs')
        elif node in LOOP:
            yield Finding(MISSING, node, 'does not run, or hangs', f'ros2 run tactile_push {node}')
    given_or_missed = {*seen.publishers, *seen.subscriptions}
    if TACTILE not in given_or_missed and not any(running[node] for node in SENSORS):
        yield Finding(
            *(MISSING, TACTILE, 'no sensor runs'),
            f'start {" or ".join(SENSORS)}, or let your sensor publish {TACTILE}',
        )


def nodes_answer(seen: Snapshot) -> Iterator[Finding]:
    """Ask whether each node that is there says anything at all."""
    for node in dict.fromkeys(seen.nodes):
        if not (node in seen.health or node in seen.parameters or node in seen.states):
            yield Finding(
                *(WRONG, node, 'reports nothing and answers nothing'),
                'start it again',
            )


def managed_nodes_are_active(seen: Snapshot) -> Iterator[Finding]:
    """Ask whether the managed nodes work."""
    for node, state in seen.states.items():
        if state == 'active':
            yield Finding(RIGHT, node, 'is active')
        else:
            step = {'inactive': 'activate', 'unconfigured': 'configure'}.get(state)
            remedy = f'ros2 lifecycle set {node} {step}' if step else 'start it again'
            yield Finding(WRONG, node, f'is {state}', remedy)


def inputs_have_a_giver(seen: Snapshot) -> Iterator[Finding]:
    """Ask whether somebody publishes what each running node takes, with the type that it takes."""
    for name, takers in seen.subscriptions.items():
        topic = TOPICS[name]
        needing = [one for one in takers if one.node in seen.nodes and _depends(one.node, name)]
        if not needing or name.startswith('/'):  # those of the whole graph are seen elsewhere
            continue
        given = seen.publishers.get(name, ())
        nodes = ', '.join(dict.fromkeys(one.node for one in needing))
        if not given:
            yield Finding(
                *(MISSING, name, f'nobody publishes what {nodes} needs'),
                f'start {" or ".join(topic.givers)}',
            )
        for one in given:
            if one.type_name != topic.type_name:
                yield Finding(
                    *(WRONG, name, f'{one.node} publishes {one.type_name}'),
                    f'publish {topic.type_name}',
                )


def qualities_match(seen: Snapshot) -> Iterator[Finding]:
    """Ask whether each subscription gets what its publishers offer."""
    for topic, takers in seen.subscriptions.items():
        for giver in seen.publishers.get(topic, ()):
            served = {one.node for one in takers if not _lacking(giver, one)}
            for taker in takers:
                if taker.node not in served:
                    words = f'{taker.node} hears nothing of {giver.node}: {_lacking(giver, taker)}'
                    yield Finding(WRONG, topic, words, 'let both use the same quality of service')


def one_publishes(seen: Snapshot) -> Iterator[Finding]:
    """Ask whether readings, contacts and commands come from one node each."""
    for topic in OF_ONE:
        givers = [one.node for one in seen.publishers.get(topic, ())]
        if len(givers) > 1:
            words = f'{len(givers)} publishers: {", ".join(givers)}'
            yield Finding(WRONG, topic, words, 'end all but one')
        elif givers and topic == COMMAND:
            yield Finding(RIGHT, topic, f'{givers[0]} alone commands it')


def finger_is_moved(seen: Snapshot) -> Iterator[Finding]:
    """Ask whether commands reach somebody who moves the finger."""
    for topic, remedy in MOVES.items():
        givers = {one.node for one in seen.publishers.get(topic, ())}
        if not givers:
            continue
        takers = [
            one.node
            for one in seen.subscriptions.get(topic, ())
            if one.node not in givers and _moves(seen, one.node, topic)
        ]
        if takers:
            yield Finding(RIGHT, topic, f'{", ".join(dict.fromkeys(takers))} takes it')
        else:
            yield Finding(MISSING, topic, 'nobody takes it and moves the finger', remedy)


def _depends(node: str, topic: str) -> bool:
    """Return whether a node of the package cannot work without what it takes."""
    needed = node in TOPICS[topic].takers and node not in (*PLANTS, LIVE_PAGE)
    return needed and topic != PLACE_GOAL  # which comes when somebody wants an object placed


def _moves(seen: Snapshot, node: str, topic: str) -> bool:
    """Return whether a node that hears commands moves the finger by them."""
    if node in PLANTS:
        by_joints = seen.parameters.get(node, {}).get('commands') == JOINT_VELOCITIES
        return by_joints == (topic == SERVO_COMMANDS)
    return node not in NODES or (node == FINGER_SERVO and topic == COMMAND)


def _lacking(giver: Endpoint, taker: Endpoint) -> str:
    """Return what a subscription asks for and a publisher does not offer, '' if nothing."""
    lacking = []
    if taker.reliable and not giver.reliable:
        lacking.append('it asks for reliable messages of a best-effort publisher')
    if taker.latched and not giver.latched:
        lacking.append('it asks for earlier messages, which the publisher does not keep')
    return ' and '.join(lacking)
