# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Valid device input, and what lines, buffers and other devices make of it."""

import math
import random
from collections.abc import Iterator

from tactile_push.devices import Sentence, encode
from tactile_push.devices.sentence import checksum
from tactile_push.tactile import NO_CONTACT, Reading

MOST_READINGS = 8  # at a time
FIELDS = (
    b'',
    b'-',
    b'nan',
    b'inf',
    b'1e308',
    b'-0',
    b'9' * 40,
    b'+12.5',
    b'180.0',
    b'90.1',
    b'\xff',
)


def valid(draw: random.Random, sequence: int) -> bytes:
    """Return some readings of an edge that turns slowly, as a sensor sends them."""
    sentences = []
    for number in range(sequence, sequence + draw.randint(1, MOST_READINGS)):
        from_pole = math.radians(20.0) * math.sin(number / 200.0)
        force = draw.choice((math.nan, draw.uniform(0.0, 9.0)))
        azimuth = 0.0 if from_pole > 0.0 else math.pi
        reading = Reading(azimuth, math.pi / 2.0 - abs(from_pole), force)
        sentences.append(encode(Sentence(number, NO_CONTACT if draw.random() < 0.05 else reading)))
    return b''.join(sentences)


def _flip_bits(draw: random.Random, data: bytearray) -> None:
    for _ in range(draw.randint(1, 8)):
        data[draw.randrange(len(data))] ^= 1 << draw.randrange(8)


def _cut(draw: random.Random, data: bytearray) -> None:
    start = draw.randrange(len(data))
    del data[start : start + draw.randint(1, 40)]


def _splice(draw: random.Random, data: bytearray) -> None:
    start, place = draw.randrange(len(data)), draw.randrange(len(data))
    data[place:place] = data[start : start + draw.randint(1, 40)]


def _repeat(draw: random.Random, data: bytearray) -> None:
    data *= draw.randint(2, 4)


def _insert(draw: random.Random, data: bytearray) -> None:
    place = draw.randrange(len(data))
    data[place:place] = draw.randbytes(draw.randint(1, 30))


def _lengthen(draw: random.Random, data: bytearray) -> None:
    place = draw.randrange(len(data))
    data[place:place] = draw.choice((b'0', b'$', b',', b'\x00', b'x')) * draw.randint(80, 20_000)


def _replace_field(draw: random.Random, data: bytearray) -> None:
    """Write another field into one sentence and make its checksum right again."""
    lines = bytes(data).split(b'\r\n')
    index = draw.randrange(len(lines))
    body, star, _ = lines[index].removeprefix(b'$').partition(b'*')
    if star:
        fields = body.split(b',')
        fields[draw.randrange(len(fields))] = draw.choice(FIELDS)
        body = b','.join(fields)
        lines[index] = b'$%s*%02X' % (body, checksum(body))
        data[:] = b'\r\n'.join(lines)


def _forget_line_ends(draw: random.Random, data: bytearray) -> None:
    data[:] = data.replace(b'\n', draw.choice((b'', b'\r', b' ')))


MUTATIONS = (
    _flip_bits,
    _cut,
    _splice,
    _repeat,
    _insert,
    _replace_field,
    _forget_line_ends,
)
RARE = 0.01  # share of huge lines, which would be most of all bytes otherwise


def mutated_input(draw: random.Random) -> Iterator[bytes]:
    """Yield pieces of device input without end, most of them spoiled, of any length but 0.

    Parameters
    ----------
    draw : random.Random
        Decides what comes.

    Yields
    ------
    bytes
        What the device gives at one read.
    """
    sequence = 0
    while True:
        data = bytearray(valid(draw, sequence))
        sequence += MOST_READINGS if draw.random() < 0.9 else draw.choice((0, 3, 100, 40_000))
        for _ in range(draw.randint(0, 3)):
            if data:
                draw.choice(MUTATIONS)(draw, data)
        if data and draw.random() < RARE:
            _lengthen(draw, data)
        rest = bytes(data)
        while rest:
            length = draw.randint(1, max(1, len(rest)))
            yield rest[:length]
            rest = rest[length:]
