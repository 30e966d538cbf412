# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""From the device's bytes to readings, whatever the bytes are."""

from collections import Counter

from tactile_push.devices.sentence import (
    LONGEST_SENTENCE,
    SEQUENCE_MODULUS,
    SentenceError,
    decode,
)
from tactile_push.tactile.reading import Reading


class SentenceStream:
    """Cuts a stream of bytes into segments, decodes them and counts what is wrong with them.

    A segment ends with a line end, and before the `$` that begins the next one. How the bytes are
    split into pieces makes no difference to readings or counts. Every segment that is not blank is
    counted once, in `received` or in `dropped`. What cannot become a sentence any more is thrown
    away at once, so fewer than 82 bytes are kept.

    Attributes
    ----------
    received : int
        Valid sentences so far.
    dropped : collections.Counter
        Segments dropped so far, by reason.
    lost : int
        Readings missing from the sequence so far.
    repeated : int
        Sentences so far whose number was that of the sentence before; they are not passed on.
    late : int
        Sentences so far that are of unknown age; they are not passed on.
    restarts : int
        Times so far that the sequence went back: the sensor started anew.
    """

    def __init__(self) -> None:
        self.received = 0
        self.dropped: Counter[str] = Counter()
        self.lost = 0
        self.repeated = 0
        self.late = 0
        self.restarts = 0
        self.restart()

    def restart(self) -> None:
        """Forget a half line and the last sequence number: the device was opened anew."""
        self._pending = b''
        self._pending_is_late = False
        self._in_overlong_segment = False
        self._sequence: int | None = None

    def feed(self, data: bytes, fresh: bool = True) -> list[Reading]:
        r"""Take bytes as they come and give the readings that they complete.

        Parameters
        ----------
        data : bytes
            Any number of bytes.
        fresh : bool, optional
            Whether they came just now. A sentence with a byte that did not is counted as late.

        Returns
        -------
        list of Reading
            Oldest first.
        """
        fresh = fresh or not data
        # A segment that begins before this place of the first line has late bytes.
        late_before = len(self._pending) if self._pending_is_late else 0
        *lines, rest = (self._pending + data).split(b'\n')
        readings = []
        for line in lines:
            segment = self._last_segment(line)
            late = not fresh or len(line) - len(segment) < late_before
            if segment and (reading := self._take(segment, late)) is not None:
                readings.append(reading)
            self._in_overlong_segment = False
            late_before = 0
        self._pending = self._last_segment(rest)
        self._pending_is_late = not fresh or len(rest) - len(self._pending) < late_before
        return readings

    def _last_segment(self, line: bytes) -> bytes:
        """Give the segment that a line ends with, if it can be a sentence, and count the others."""
        start = line.rfind(b'$')
        if start >= 0:
            begun = not self._in_overlong_segment and line[: line.find(b'$')].strip(b'\r') != b''
            if cut := line.count(b'$', 0, start) + begun:
                self.dropped['no line end'] += cut
            self._in_overlong_segment = False
            segment = line[start:]
        elif self._in_overlong_segment:
            return b''
        else:
            segment = line.lstrip(b'\r')
        if len(segment) >= LONGEST_SENTENCE:
            self.dropped['no line end'] += 1
            self._in_overlong_segment = True
            return b''
        return segment

    def _take(self, segment: bytes, late: bool) -> Reading | None:
        try:
            sentence = decode(segment)
        except SentenceError as error:
            self.dropped[str(error)] += 1
            return None
        self.received += 1
        if self._sequence is not None:
            step = (sentence.sequence - self._sequence) % SEQUENCE_MODULUS
            if step == 0:
                self.repeated += 1
                return None
            if step > SEQUENCE_MODULUS // 2:
                self.restarts += 1
            else:
                self.lost += step - 1
        self._sequence = sentence.sequence
        if late:
            self.late += 1
            return None
        return sentence.reading
