# Copyright 2026 The tactile_push authors
#
# Licensed under the Apache License, Version 2.0 (the "License");
# you may not use this file except in compliance with the License.
# You may obtain a copy of the License at
#
#     http://www.apache.org/licenses/LICENSE-2.0
#
# Unless required by applicable law or agreed to in writing, software
# distributed under the License is distributed on an "AS IS" BASIS,
# WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
# See the License for the specific language governing permissions and
# limitations under the License.
"""From the device's bytes to readings, whatever the bytes are."""

from collections import Counter

from tactile_push.tactile.reading import Reading
from tactile_push.tactile.sentence import (
    LONGEST_SENTENCE,
    SEQUENCE_MODULUS,
    SentenceError,
    decode,
)


class SentenceStream:
    """Cuts a stream of bytes into sentences and counts what is wrong with them.

    A sentence may come in pieces or many at a time. Only what follows the last `$` of a line can
    become a sentence, and only if it is no longer than one can be; the rest is thrown away at
    once, so memory is bounded.

    Attributes
    ----------
    received : int
        Valid sentences so far.
    dropped : collections.Counter
        Lines dropped so far, by reason.
    lost : int
        Readings missing from the sequence so far.
    repeated : int
        Sentences so far whose number was that of the sentence before; they are not passed on.
    restarts : int
        Times so far that the sequence went back: the sensor started anew.
    """

    def __init__(self) -> None:
        self.received = 0
        self.dropped: Counter[str] = Counter()
        self.lost = 0
        self.repeated = 0
        self.restarts = 0
        self._pending = b''
        self._thrown_away = 0
        self._sequence: int | None = None

    def restart(self) -> None:
        """Forget a half line and the last sequence number: the device was opened anew."""
        self._pending = b''
        self._thrown_away = 0
        self._sequence = None

    def feed(self, data: bytes) -> list[Reading]:
        r"""Take bytes as they come and give the readings that they complete.

        Parameters
        ----------
        data : bytes
            Any number of bytes.

        Returns
        -------
        list of Reading
            Oldest first.
        """
        *lines, pending = (self._pending + data).split(b'\n')
        readings = [reading for line in lines if (reading := self._take(line)) is not None]
        start = pending.rfind(b'$')
        self._pending = pending[start:] if start >= 0 else b''
        if len(self._pending) > LONGEST_SENTENCE:
            self._pending = b''
        before = self._thrown_away
        self._thrown_away += len(pending) - len(self._pending)
        if before <= LONGEST_SENTENCE < self._thrown_away:
            self.dropped['no line end'] += 1
        return readings

    def _take(self, line: bytes) -> Reading | None:
        start = line.rfind(b'$')
        if start < 0:
            if 0 < len(line.rstrip(b'\r')) + self._thrown_away <= LONGEST_SENTENCE:
                self.dropped['no sentence'] += 1
            self._thrown_away = 0
            return None
        self._thrown_away = 0
        try:
            sentence = decode(line[start:])
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
        return sentence.reading
