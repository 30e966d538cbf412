# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Control periods for a bag that does not tell when the controller ticked, or had none."""

from collections.abc import Iterator
from functools import partial

from tactile_push.parameters.push_controller import (
    PushControllerParameters,
    make_control,
    make_finger,
)
from tactile_push.pipeline import Control, Stamp
from tactile_push.pipeline.stamps import seconds_since
from tactile_push.replay.messages import Replayed, nanoseconds


class OwnTicks:
    """Runs the law at its own rate on the contacts' stamps, from the first contact on."""

    def __init__(self, values: PushControllerParameters, epoch: int) -> None:
        self._seconds = partial(seconds_since, epoch)
        push, finger = make_control(values), make_finger(values)
        self.step = Control(push, finger, values.joint_names, self._seconds)
        self.uses_joint_states = values.use_joint_states
        self._begin: int | None = None  # of the first period [ns]
        self._ticks = 0

    def feel(self, theta: float | None, stamp: Stamp, log_time: int) -> Iterator[Replayed]:
        """Take a reading, None without a contact, and yield the ticks that were due before it."""
        at = nanoseconds(stamp)
        if self._begin is None:
            if theta is None:
                return
            self._begin = at
            self.step.push.activate(self._seconds(*stamp))
        while (due := self._begin + round(self._ticks * self.step.push.period * 1e9)) < at:
            self._ticks += 1
            due_stamp = divmod(due, 10**9)
            yield Replayed(due_stamp, log_time, self.step.tick(due_stamp), None)
        if theta is not None:
            self.step.contact(stamp, theta)

    def finish(self) -> Iterator[Replayed]:
        """Yield the ticks that still wait: none, for each waits for the next reading."""
        yield from ()
