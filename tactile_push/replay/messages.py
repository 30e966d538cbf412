# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What a replay reads from decoded messages and what it hands on."""

from typing import Any, NamedTuple

from tactile_push.bags import Message
from tactile_push.control import Tick
from tactile_push.pipeline import Output, Stamp

Written = Message | tuple[Output, int]
"""A message to copy, or a new one with its log time [ns]."""


class Replayed(NamedTuple):
    """A tick as it comes out now, None where that is not known, beside the recorded one."""

    stamp: Stamp
    log_time: int
    tick: Tick | None
    recorded: Tick | None


def stamp_of(message: Any) -> Stamp:
    """Return the stamp of a decoded message with a header [s, ns]."""
    return message.header.stamp.sec, message.header.stamp.nanosec


def nanoseconds(stamp: Stamp) -> int:
    """Return the time of a stamp [ns]."""
    return stamp[0] * 10**9 + stamp[1]
