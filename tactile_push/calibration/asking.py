# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Asks a person for one touch after the other, and takes those that are held still."""

from collections import deque
from collections.abc import Callable, Sequence
from typing import Generic, Protocol, TypeVar

from tactile_push.calibration.coverage import in_words, suggested_touches
from tactile_push.calibration.steadiness import Sight, SteadyTouch
from tactile_push.tactile import NotUntouchedError, ReadingRejectedError

V = TypeVar('V')
M = TypeVar('M')
V_contra = TypeVar('V_contra', contravariant=True)
M_contra = TypeVar('M_contra', contravariant=True)
KEEP, SKIP, REPEAT, END = '\n', 's', 'r', 'q'

FREE = 'nothing may touch the tip: Enter when it is so, q ends'
TAKING = 'nothing may touch the tip: wait'
TOUCH = 'hold it still; s skips it, q ends'
TAKEN = 'Enter keeps it, r repeats it, s skips it, q ends'
LIFT = 'lift the finger; q ends'


class Sense(Protocol[V_contra]):
    """What a sensor's messages show of the tip."""

    LEAST: int  #: messages of a touch
    LEAST_FREE: int  #: messages of the untouched tip
    FREE_TIME: float  #: over which they are taken [s]
    HINT: str  #: how to touch

    def take_free(self, values: Sequence[V_contra]) -> None:
        """Take messages for those of the untouched tip; NotUntouchedError if they cannot be."""
        ...

    def sight(self, value: V_contra) -> Sight:
        """Return what a message shows; ReadingRejectedError if it shows nothing."""
        ...

    def words(self, values: Sequence[V_contra]) -> str:
        """Describe a touch."""
        ...


class Keep(Protocol[M_contra]):
    """Keeps messages."""

    def free(self, messages: Sequence[M_contra]) -> None:
        """Keep messages of the untouched tip."""
        ...

    def touch(self, place: tuple[float, float], messages: Sequence[M_contra]) -> None:
        """Keep messages of a touch."""
        ...


class Asking(Generic[V, M]):
    """Asks for the untouched tip, then for touches at one place after the other.

    A touch that is held still is taken. The person then keeps it, repeats it or skips the place.
    The next touch counts once the tip has been free.

    Parameters
    ----------
    sense : Sense
        Knows what messages show.
    keep : Keep
        Gets the messages of what was kept, in the order of bags of touches.
    say : callable
        Told a line for the person.
    """

    def __init__(self, sense: Sense[V], keep: Keep[M], say: Callable[[str], None]) -> None:
        self._sense, self._keep, self._say = sense, keep, say
        self._places = deque(suggested_touches())
        self._count = len(self._places)
        self._free: list[tuple[float, V, M]] = []
        self._steady: SteadyTouch[tuple[V, M]] = SteadyTouch(sense.LEAST)
        self._taken: list[tuple[V, M]] = []
        self.line = FREE  #: what the person can do now
        self.trouble = ''  #: why the last message showed nothing
        self.done = False  #: whether there is nothing more to ask

    @property
    def listens(self) -> bool:
        """Whether messages count now."""
        return not self.done and self.line not in (FREE, TAKEN)

    def key(self, key: str) -> None:
        """Take a key.

        Parameters
        ----------
        key : str
            Enter keeps, s skips, r repeats, q ends; others do nothing.
        """
        if key == END:
            self.done = True
        elif self.line == FREE and key == KEEP:
            self.line = TAKING
        elif self.line == TOUCH and key == SKIP:
            self._say('  skipped')
            self._places.popleft()
            self._ask()
        elif self.line == TAKEN and key in (KEEP, SKIP, REPEAT):
            self._decide(key)

    def message(self, time: float, value: V, message: M) -> None:
        """Take a message.

        Parameters
        ----------
        time : float
            When it came [s].
        value : object
            What the sensor measures.
        message : object
            What is kept of it.
        """
        if not self.listens:
            return
        self.trouble = ''
        if self.line == TAKING:
            self._take_free(time, value, message)
            return
        try:
            sight = self._sense.sight(value)
        except ReadingRejectedError as reason:
            self.trouble = str(reason)
            self._steady.restart()
            return
        if self.line == LIFT:
            if sight.free:
                self._keep.free([message])
                self._ask()
        elif taken := self._steady.take(time, sight, (value, message)):
            self._taken = taken
            self._say(f'  {self._sense.words([value for value, _ in taken])}')
            self.line = TAKEN

    def _take_free(self, time: float, value: V, message: M) -> None:
        if self._free and time < self._free[-1][0]:  # the clock was set
            self._free.clear()
        self._free.append((time, value, message))
        first = self._free[0][0]
        if len(self._free) < self._sense.LEAST_FREE or time - first < self._sense.FREE_TIME:
            return
        taken, self._free = self._free, []
        try:
            self._sense.take_free([value for _, value, _ in taken])
        except NotUntouchedError as reason:
            self._say(f'  {reason}')
            self.line = FREE
            return
        self._keep.free([message for _, _, message in taken])
        self._say(f'  taken; {self._sense.HINT}')
        self._ask()

    def _decide(self, key: str) -> None:
        words = {KEEP: 'kept', SKIP: 'skipped', REPEAT: 'once more'}[key]
        self._say(f'  {words}')
        if key == KEEP:
            self._keep.touch(self._places[0], [message for _, message in self._taken])
        if key != REPEAT:
            self._places.popleft()
        self._taken = []
        self._steady.restart()
        self.done = not self._places
        self.line = LIFT

    def _ask(self) -> None:
        self.done = not self._places
        if not self.done:
            number = self._count - len(self._places) + 1
            self._say(f'touch {number} of {self._count}: {in_words(*self._places[0])}')
            self.line = TOUCH
