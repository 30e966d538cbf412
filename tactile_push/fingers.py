# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Which topics of a bag are those of the package, by name and type together."""

from collections.abc import Collection

from tactile_push.bags import BagReader
from tactile_push.interface import TOPICS, fingers, own_name


def fingers_in(bag: BagReader, having: Collection[str]) -> dict[str, set[str]]:
    """Return the topics with messages of each finger that has one of some topics, by namespace."""
    filled = {name: topic.type_name for name, topic in bag.topics.items() if bag.counts[name]}
    return fingers(filled, having)


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
