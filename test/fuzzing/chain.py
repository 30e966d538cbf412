# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The way of the device's bytes to the finger's velocity, without ROS, and what must hold on it."""

import math
import tracemalloc
from collections.abc import Callable, Iterable

from tactile_push.control import Limits, PushControl, PushLaw
from tactile_push.devices import SentenceStream
from tactile_push.tactile import ContactFinder, ReadingRejectedError

READ_PERIOD = 0.02  # [s]
CONTROL_PERIOD = 0.1  # [s]
READS_PER_TICK = 5
WARM_UP = 100_000  # after so many bytes or a tenth of them, memory no longer grows [byte]
MOST_GROWTH = 100_000  # of memory afterwards [byte]
MOST_AT_ONCE = 1_000_000  # while one read is worked on [byte]
ROUNDING = 1e-12  # [m/s]


class FuzzError(Exception):
    """Something did not hold; the message says what."""


class Chain:
    """Stream, contact finder and control, one read of the device after the other.

    Attributes
    ----------
    reads, readings, contacts, ticks, moving : int
        What has passed so far; `moving` are the ticks with a velocity other than 0.
    """

    def __init__(self) -> None:
        self._stream = SentenceStream()
        self._finder = ContactFinder(0.0135, joint_state_timeout=0.1)
        self._control = PushControl(PushLaw(0.05, 5.0, -0.17), 0.005, CONTROL_PERIOD, Limits())
        self._control.activate(0.0)
        self._v_x = 0.0
        self.reads = self.readings = self.contacts = self.ticks = self.moving = 0

    def read(self, data: bytes) -> None:
        """Take what the device gave at one read, and tick when it is time.

        Parameters
        ----------
        data : bytes
            What the device gave.

        Raises
        ------
        FuzzError
            If a command or a contact is not finite, or a command is a kick.
        """
        self.reads += 1
        now = self.reads * READ_PERIOD
        self._finder.joints(now, (math.pi / 2.0, -math.pi / 2.0))
        for reading in self._stream.feed(data):
            self.readings += 1
            stamp = now + self.readings * 1e-9
            try:
                contact = self._finder.contact(reading, stamp)
            except ReadingRejectedError:
                continue
            if not all(map(math.isfinite, (contact.theta, contact.x, contact.y))):
                raise FuzzError(f'{contact} from {reading}')
            self.contacts += 1
            self._control.feel(contact.theta, stamp)
        if self.reads % READS_PER_TICK == 0:
            self._tick(now)

    def _tick(self, now: float) -> None:
        tick = self._control.tick(now, CONTROL_PERIOD)
        self.ticks += 1
        v_x = 0.0 if tick.v_x is None else tick.v_x
        limits = self._control.limits
        if not abs(v_x) <= limits.max_speed:
            raise FuzzError(f'command of {v_x} m/s')
        step = abs(v_x - self._v_x)
        if v_x != 0.0 and step > limits.max_acceleration * CONTROL_PERIOD + ROUNDING:
            raise FuzzError(f'step of {step} m/s')
        self.moving += v_x != 0.0
        self._v_x = v_x


def run(
    pieces: Iterable[bytes],
    total: int,
    progress: Callable[[int], None] = lambda done: None,
) -> tuple[Chain, int]:
    """Send bytes through the chain and watch its memory.

    Parameters
    ----------
    pieces : iterable of bytes
        Reads of the device, at least `total` bytes.
    total : int
        How many bytes to send [byte].
    progress : callable, optional
        Told the number of bytes sent.

    Returns
    -------
    Chain
        What they passed.
    int
        How much memory grew after the warm-up [byte].

    Raises
    ------
    FuzzError
        If something does not hold.
    """
    chain, done, baseline = Chain(), 0, 0
    tracemalloc.start()
    try:
        for piece in pieces:
            chain.read(piece)
            done += len(piece)
            progress(done)
            if not baseline and done >= max(total / 10, WARM_UP):
                baseline, _ = tracemalloc.get_traced_memory()
                tracemalloc.reset_peak()
            if done >= total:
                break
        end, peak = tracemalloc.get_traced_memory()
        baseline = baseline or end
    finally:
        tracemalloc.stop()
    for growth, most in ((end - baseline, MOST_GROWTH), (peak - baseline, MOST_AT_ONCE)):
        if growth > most:
            raise FuzzError(f'memory grew by {growth / 1000:.0f} kB, more than {most / 1000:.0f}')
    return chain, end - baseline
