# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What a replay reads from a bag and its messages, and what it hands on."""

from collections.abc import Collection
from typing import NamedTuple

from tactile_push.bags import BagError, BagReader, Message
from tactile_push.control import Tick
from tactile_push.interface import TOPICS, fingers
from tactile_push.pipeline import Fields, Output, Stamp

Written = Message | tuple[Output, int]
"""A message to copy, or a new one with its log time [ns]."""


class Replayed(NamedTuple):
    """A tick as it comes out now, None where that is not known, beside the recorded one."""

    stamp: Stamp
    log_time: int
    tick: Tick | None
    recorded: Tick | None


def nanoseconds(stamp: Stamp) -> int:
    """Return the time of a stamp [ns]."""
    return stamp[0] * 10**9 + stamp[1]


def only(names: Collection[str], fields: Fields) -> Fields:
    """Return the fields of a JointState without the numbers of other names."""
    pairs = zip(fields['name'], fields['position'], strict=True)
    kept = {name: position for name, position in pairs if name in names}
    return {**fields, 'name': list(kept), 'position': list(kept.values())}


def fingers_of(
    bag: BagReader, having: Collection[str], needed: Collection[str]
) -> dict[str, set[str]]:
    """Return the topics with messages of each finger that has one of some topics, by namespace.

    Raises BagError if a needed topic has another type than the package's.
    """
    found = fingers((name for name in bag.topics if bag.counts[name]), having)
    for namespace, topics in found.items():
        for topic in sorted(topics.intersection(needed)):
            expected, got = TOPICS[topic].type_name, bag.topics[f'{namespace}/{topic}'].type_name
            if got != expected:
                raise BagError(f'{bag.path}: {namespace}/{topic}: expected {expected}, got {got}')
    return found
