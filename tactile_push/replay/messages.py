# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What a replay reads from a bag and its messages, and what it hands on."""

from collections.abc import Collection, Mapping
from typing import NamedTuple

from tactile_push.bags import BagReader, Message
from tactile_push.control import Tick
from tactile_push.fingers import is_own
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


def still_free(bag: BagReader, made: Mapping[str, str]) -> dict[str, str]:
    """Return the topics to be made, types by name, without names that something foreign has."""
    taken = {name for name in made if name in bag.topics and not is_own(bag, name)}
    return {name: type_name for name, type_name in made.items() if name not in taken}
