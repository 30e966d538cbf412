# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""A bag of touches with its table, written as the touches come."""

import math
from collections.abc import Callable, Sequence
from functools import cached_property
from pathlib import Path
from typing import Protocol

from tactile_push.bags import BagWriter
from tactile_push.calibration.touch_table import AZIMUTH, ELEVATION, TABLE


class Message(Protocol):
    """A message as it came."""

    @property
    def received(self) -> int:
        """When it came [ns since the epoch]."""
        ...

    @property
    def sent(self) -> int:
        """When it was published [ns since the epoch]."""
        ...

    @property
    def data(self) -> bytes:
        """Its bytes."""
        ...


class KeptTouches:
    """Writes a bag of touches and, in its folder, the table of their places.

    The folder is made when there is something to keep. A bag that is not closed can be read.

    Parameters
    ----------
    folder : Path
        Folder of the bag, which must not exist yet.
    topic : str
        The only topic in it.
    begin : callable
        Adds the topic to a new bag.
    """

    def __init__(self, folder: Path, topic: str, begin: Callable[[BagWriter], None]) -> None:
        self._folder, self._topic, self._begin = folder, topic, begin

    @cached_property
    def _bag(self) -> BagWriter:
        bag = BagWriter(self._folder)
        self._begin(bag)
        (self._folder / TABLE).write_text(f'{AZIMUTH},{ELEVATION}\n')
        return bag

    def free(self, messages: Sequence[Message]) -> None:
        """Keep messages of the untouched tip.

        Parameters
        ----------
        messages : sequence of Message
            The messages; OSError if they cannot be written.
        """
        for message in messages:
            self._bag.write(self._topic, message.data, message.received, message.sent)
        self._bag.flush()

    def touch(self, place: tuple[float, float], messages: Sequence[Message]) -> None:
        """Keep messages of a touch, and its place.

        Parameters
        ----------
        place : tuple of float
            Azimuth and elevation [rad].
        messages : sequence of Message
            The messages; OSError if they cannot be written.
        """
        self.free(messages)
        with (self._folder / TABLE).open('a') as table:
            table.write(','.join(f'{math.degrees(angle):.6g}' for angle in place) + '\n')

    def close(self) -> None:
        """Finish the bag, if there is one."""
        if '_bag' in self.__dict__:
            self._bag.close()
