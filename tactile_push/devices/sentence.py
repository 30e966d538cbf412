# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The sensor's wire format: one NMEA 0183 sentence a reading, see docs/wire_format.md."""

import math
import re
from dataclasses import dataclass

from tactile_push.tactile.reading import NO_CONTACT, Reading

SEQUENCE_MODULUS = 65536
LONGEST_SENTENCE = 82  # NMEA 0183, from `$` to the line end
_NUMBER = re.compile(rb'[+-]?[0-9]{1,9}(\.[0-9]{1,9})?')
_SEQUENCE = re.compile(rb'[0-9]{1,5}')
_CHECKSUM = re.compile(rb'[0-9A-Fa-f]{2}')


class SentenceError(ValueError):
    """A line that is no valid sentence; the message is the reason in two or three words."""


@dataclass(frozen=True)
class Sentence:
    """A reading and its number on the wire.

    Parameters
    ----------
    sequence : int
        Sequence number, 0 to 65535; it grows by one a reading and starts over after 65535.
    reading : Reading
        What the sensor said.
    """

    sequence: int
    reading: Reading


def checksum(body: bytes) -> int:
    """Give the XOR of all bytes between `$` and `*`.

    Parameters
    ----------
    body : bytes
        The bytes between the two signs.

    Returns
    -------
    int
        0 to 255.
    """
    value = 0
    for byte in body:
        value ^= byte
    return value


def encode(sentence: Sentence) -> bytes:
    r"""Write a sentence as the sensor sends it.

    Parameters
    ----------
    sentence : Sentence
        Reading and sequence number.

    Returns
    -------
    bytes
        `$PTACT,<sequence>,A,<azimuth>,<elevation>,<force>*hh\r\n` with angles in degrees and the
        force in newtons, empty if not measured; `$PTACT,<sequence>,V,,,*hh\r\n` without contact.
    """
    reading = sentence.reading
    if reading.in_contact:
        force = '' if math.isnan(reading.normal_force) else f'{reading.normal_force:.3f}'
        azimuth, elevation = math.degrees(reading.azimuth), math.degrees(reading.elevation)
        fields = f'A,{azimuth:.4f},{elevation:.4f},{force}'
    else:
        fields = 'V,,,'
    body = f'PTACT,{sentence.sequence % SEQUENCE_MODULUS},{fields}'.encode('ascii')
    return b'$%s*%02X\r\n' % (body, checksum(body))


def decode(line: bytes) -> Sentence:
    r"""Read a sentence.

    Parameters
    ----------
    line : bytes
        From `$` to the checksum; a line end may follow.

    Returns
    -------
    Sentence
        Reading in radians and newtons, and sequence number. Angles are passed on as they came,
        on the hemisphere or not.

    Raises
    ------
    SentenceError
        If it is not a sentence of this format with the right checksum.
    """
    line = line.rstrip(b'\r\n')
    if not line.startswith(b'$') or line[-3:-2] != b'*' or not _CHECKSUM.fullmatch(line[-2:]):
        raise SentenceError('no sentence')
    body = line[1:-3]
    if checksum(body) != int(line[-2:], 16):
        raise SentenceError('wrong checksum')
    fields = body.split(b',')
    if len(fields) != 6 or fields[0] != b'PTACT' or not _SEQUENCE.fullmatch(fields[1]):
        raise SentenceError('unknown sentence')
    sequence = int(fields[1])
    if sequence >= SEQUENCE_MODULUS:
        raise SentenceError('unknown sentence')
    if fields[2:] == [b'V', b'', b'', b'']:
        return Sentence(sequence, NO_CONTACT)
    azimuth, elevation, force = fields[3:]
    if (
        fields[2] != b'A'
        or not _NUMBER.fullmatch(azimuth)
        or not _NUMBER.fullmatch(elevation)
        or not (force == b'' or _NUMBER.fullmatch(force))
    ):
        raise SentenceError('unreadable fields')
    return Sentence(
        sequence,
        Reading(
            math.radians(float(azimuth)),
            math.radians(float(elevation)),
            float(force) if force else math.nan,
        ),
    )
