# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Which topics of a bag are those of the package, and what is read of their messages.

A topic is the package's if its name and its type are. If it is, its definition must have the fields
that are read.
"""

from collections.abc import Collection

from tactile_push.bags import BagError, BagReader
from tactile_push.bags.fields import FLAG, NUMBER, TEXT, WHOLE
from tactile_push.interface import (
    DIAGNOSTICS,
    JOINT_STATE_TYPE,
    PARAMETER_EVENTS,
    POSE_TYPE,
    TOPICS,
    TWIST_TYPE,
    UNCERTAIN_POSE_TYPE,
    fingers,
    own_name,
)

_STAMP = {'header.stamp.sec': WHOLE, 'header.stamp.nanosec': WHOLE}
_POSE = {
    **{f'position.{axis}': NUMBER for axis in 'xyz'},
    **{f'orientation.{part}': NUMBER for part in 'xyzw'},
}
_CHANGED = 'changed_parameters[].'
_VALUES = {'bool': FLAG, 'integer': WHOLE, 'double': NUMBER, 'string': TEXT}

# Kinds of the fields that the package reads or writes, by message type and path.
FIELDS = {
    JOINT_STATE_TYPE: {**_STAMP, 'name[]': TEXT, 'position[]': NUMBER},
    POSE_TYPE: {
        **_STAMP,
        'header.frame_id': TEXT,
        **{f'pose.{path}': kind for path, kind in _POSE.items()},
    },
    UNCERTAIN_POSE_TYPE: {**_STAMP, **{f'pose.pose.{path}': kind for path, kind in _POSE.items()}},
    TWIST_TYPE: {**_STAMP, 'twist.linear.x': NUMBER, 'twist.linear.y': NUMBER},
    TOPICS[DIAGNOSTICS].type_name: {
        **_STAMP,
        'status[].level': WHOLE,
        'status[].name': TEXT,
        'status[].message': TEXT,
    },
    TOPICS[PARAMETER_EVENTS].type_name: {
        'node': TEXT,
        f'{_CHANGED}name': TEXT,
        f'{_CHANGED}value.type': WHOLE,
        f'{_CHANGED}value.byte_array_value[]': WHOLE,
        **{f'{_CHANGED}value.{name}_value': kind for name, kind in _VALUES.items()},
        **{f'{_CHANGED}value.{name}_array_value[]': kind for name, kind in _VALUES.items()},
    },
}


def fingers_in(
    bag: BagReader, having: Collection[str], names: Collection[str], nothing: str
) -> dict[str, set[str]]:
    """Return the topics with messages of each finger that has one of some topics, by namespace.

    `names` are the package's names of all topics that are used. Warns of foreign topics with such a
    name. BagError says `nothing` if there is no finger, and what is wrong with the definition of a
    topic that is used.
    """
    filled = {name: topic.type_name for name, topic in bag.topics.items() if bag.counts[name]}
    found = fingers(filled, having)
    foreign = left_alone(bag, names)
    if not found:
        raise BagError(f'{bag.path}: {"; ".join(filter(None, [nothing, foreign]))}')
    used = [name for name in names if name[0] == '/']
    used += [f'{space}/{name}' for space in found for name in names if name[0] != '/']
    for topic in sorted(name for name in used if is_own(bag, name)):
        if trouble := definition_trouble(bag, topic):
            raise BagError(f'{bag.path}: {trouble}')
    if foreign:
        bag.warn(f'{bag.path}: {foreign}')
    return found


def definition_trouble(bag: BagReader, topic: str) -> str:
    """Say why the fields that the package reads cannot be read from a topic; '' if they can."""
    description = bag.topics[topic]
    return description.trouble(FIELDS.get(description.type_name, {}))


def is_own(bag: BagReader, topic: str) -> bool:
    """Return whether the bag has a topic and its type is the one that the package gives it."""
    own = own_name(topic)
    return own is not None and topic in bag.topics and not _is_foreign(bag, topic, own)


def left_alone(bag: BagReader, names: Collection[str]) -> str:
    """Return a clause that tells the topics named like the package's `names` but of another type.

    It is empty if there is none.
    """
    found = []
    for topic in sorted(bag.topics):
        own = own_name(topic)
        if own is not None and own in names and _is_foreign(bag, topic, own):
            got = bag.topics[topic].type_name or 'no type'
            found.append(f'{topic} (expected {TOPICS[own].type_name}, got {got})')
    return f'left alone: {", ".join(found)}' if found else ''


def _is_foreign(bag: BagReader, topic: str, own: str) -> bool:
    return bag.topics[topic].type_name != TOPICS[own].type_name
