# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Checks of what nodes say: times, rates, frames, joints, parameters and their health."""

import math
from collections.abc import Iterator
from statistics import median

from tactile_push.doctor.finding import MISSING, RIGHT, WRONG, Finding
from tactile_push.doctor.snapshot import Snapshot
from tactile_push.interface import (
    ACTIVE_SENSING,
    CLOCK,
    COMMAND,
    CONTACT,
    CONTROLLER_STATE,
    FINGER_BASE,
    FINGER_DISK,
    JOINT_STATES,
    OBJECT_POSE,
    PUSH,
    PUSH_CONTROLLER,
    SERVO_STATE,
    TACTILE,
    TOPICS,
)
from tactile_push.parameters import PARAMETERS, PushControllerParameters, shared

AZIMUTH, ELEVATION = TOPICS[TACTILE].field_names[:2]
FRAMES = {CONTACT: FINGER_DISK, COMMAND: FINGER_BASE, OBJECT_POSE: FINGER_DISK}
READINGS_A_PERIOD = 2.0  # so that the next one corrects an outlier
SLACK = 0.25  # share by which a rate may be off; picked: a busy machine loses some to the doctor
FINGER_LAG = 'finger_lag'  # which a controller with law (18) does without
# Parameters that have to be the same for every node that declares them.
COMMON = {*(vars(shared).keys() - {'autostart'}), 'contact_timeout', 'control_rate'}


def clocks_agree(seen: Snapshot) -> Iterator[Finding]:
    """Ask whether all nodes use the same time, and whether there is one."""
    simulated = {
        node: bool(values.get('use_sim_time'))
        for node, values in seen.parameters.items()
        if node not in TOPICS[CLOCK].givers
    }
    clocks = seen.publishers.get(CLOCK, ())
    if len(clocks) > 1:
        names = ', '.join(one.node for one in clocks)
        yield Finding(WRONG, CLOCK, f'{len(clocks)} nodes publish it: {names}', 'end all but one')
    if clocks and not all(simulated.values()):
        real = ', '.join(node for node, follows in simulated.items() if not follows)
        yield Finding(
            *(WRONG, CLOCK, f'time is simulated, and {real} does not follow it'),
            'start it with use_sim_time:=true, or end the simulation',
        )
    elif any(simulated.values()) and not clocks:
        follows = ', '.join(node for node, follows in simulated.items() if follows)
        yield Finding(
            *(MISSING, CLOCK, f'{follows} waits for simulated time, which nobody publishes'),
            'start the simulation, or the node without use_sim_time',
        )
    elif clocks and not all(heard.seconds > 0.0 for heard in seen.heard.values()):
        yield Finding(
            *(WRONG, CLOCK, 'the simulated time stands'),
            f'let {clocks[0].node} run on, or start it again',
        )
    elif simulated:
        yield Finding(
            RIGHT, CLOCK, 'all nodes use ' + ('simulated time' if clocks else 'real time')
        )


def messages_come(seen: Snapshot) -> Iterator[Finding]:
    """Ask how often readings, joint states and control periods come, and how old they are."""
    p = push_values(seen)
    least = {
        TACTILE: READINGS_A_PERIOD * p.control_rate,
        JOINT_STATES: READINGS_A_PERIOD * p.control_rate,
        CONTROLLER_STATE: p.control_rate,
        SERVO_STATE: p.control_rate,  # it answers each command
    }
    for topic, rate in least.items():
        heard = seen.heard.get(topic)
        if heard is None or not seen.publishers.get(topic) or not heard.seconds > 0.0:
            continue
        if heard.rate < (1.0 - SLACK) * rate:
            words = f'{heard.rate:.1f} messages a second, expected {rate:g} or more'
            remedy = f'publish it more often, or lower control_rate of {PUSH_CONTROLLER}'
            yield Finding(WRONG, topic, words, remedy)
            continue
        yield Finding(RIGHT, topic, f'{heard.rate:.1f} messages a second')
        age = median(heard.ages)
        if not abs(age) < p.contact_timeout and CLOCK not in seen.publishers:
            way = 'old' if age > 0.0 else 'ahead of the clock'
            yield Finding(
                *(WRONG, topic, f'stamps are {abs(age):.2f} s {way}'),
                'synchronise the clocks of the machines (NTP, PTP), or stamp when measured',
            )


def messages_are_in_order(seen: Snapshot) -> Iterator[Finding]:
    """Ask whether messages name the frames that they are in, and a reading its angles."""
    for topic, frame in FRAMES.items():
        heard = seen.heard.get(topic)
        if heard is None or not heard.count:
            continue
        if heard.frames == {frame}:
            yield Finding(RIGHT, topic, f'is in {frame}')
        else:
            named = ', '.join(sorted(name or 'no frame' for name in heard.frames))
            yield Finding(WRONG, topic, f'names {named}', f'publish it in {frame}')
    heard = seen.heard.get(TACTILE)
    if heard is not None and heard.count:
        lacking = [name for name in (AZIMUTH, ELEVATION) if name not in heard.names]
        if lacking:
            words = f'lacks {", ".join(lacking)}'
            yield Finding(WRONG, TACTILE, words, 'publish azimuth and elevation under these names')


def joints_are_there(seen: Snapshot) -> Iterator[Finding]:
    """Ask whether the joint states have the joints that the nodes look for."""
    heard = seen.heard.get(JOINT_STATES)
    if heard is None or not heard.count:
        return
    for node, values in seen.parameters.items():
        names = values.get('joint_names')
        if names is None or values.get('use_joint_states') is False:
            continue
        lacking = [name for name in names if name not in heard.names]
        if lacking:
            yield Finding(
                *(WRONG, node, f'{JOINT_STATES} lacks {", ".join(lacking)}'),
                f'set joint_names to names of {", ".join(sorted(heard.names)) or "its joints"}',
            )
        else:
            yield Finding(RIGHT, node, f'finds its joints in {JOINT_STATES}')


def parameters_agree(seen: Snapshot) -> Iterator[Finding]:
    """Ask whether nodes that must know the same thing know the same."""
    known: dict[str, dict[str, object]] = {}
    for node, values in seen.parameters.items():
        for one in PARAMETERS[node].declared():
            used = values.get('law') != PUSH or one.name != FINGER_LAG
            if one.name in COMMON and one.name in values and used:
                known.setdefault(one.name, {})[node] = values[one.name]
    for name, by_node in known.items():
        if len(by_node) < 2:
            continue
        if len({repr(value) for value in by_node.values()}) > 1:
            said = ', '.join(f'{node} has {value}' for node, value in by_node.items())
            yield Finding(WRONG, name, said, 'start all nodes with the same value')
        else:
            yield Finding(RIGHT, name, f'is the same for {", ".join(by_node)}')


def nodes_are_well(seen: Snapshot) -> Iterator[Finding]:
    """Ask the nodes themselves."""
    untouched = touches_nothing(seen)
    for node, (level, message) in seen.health.items():
        waits = level == 1 and untouched and node in (PUSH_CONTROLLER, ACTIVE_SENSING)
        if level == 0 or waits:
            yield Finding(RIGHT, node, f'reports: {message}')
        else:
            yield Finding(WRONG, node, f'reports: {message}', 'see its values in /diagnostics')


def touches_nothing(seen: Snapshot) -> bool:
    """Return whether all readings say that the tip touches nothing.

    Parameters
    ----------
    seen : Snapshot
        What was seen.

    Returns
    -------
    bool
        False if there are no readings.
    """
    heard = seen.heard.get(TACTILE)
    elevations = [values.get(ELEVATION, 0.0) for values in heard.values] if heard else []
    return bool(elevations) and all(map(math.isnan, elevations))


def push_values(seen: Snapshot) -> PushControllerParameters:
    """Return the parameters of the controller, the defaults of those that it did not tell."""
    told = seen.parameters.get(PUSH_CONTROLLER, {})
    return PushControllerParameters.of(PushControllerParameters.taken(told))
