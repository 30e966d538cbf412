# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Bytes in pieces of any size, with noise and losses, against the readings that they hold."""

import math
import random
from collections import Counter
from itertools import accumulate, pairwise

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from tactile_push.devices import Sentence, SentenceError, SentenceStream, decode, encode
from tactile_push.tactile import NO_CONTACT, Reading

PROPERTY = settings(derandomize=True, deadline=None, max_examples=60)
LONGEST = 82


def line(sequence, degrees=None):
    """Return a sentence; its elevation tells it from the others."""
    if degrees is None:
        return encode(Sentence(sequence, NO_CONTACT))
    return encode(Sentence(sequence, Reading(0.0, math.radians(degrees))))


def degrees_of(readings):
    """Return elevations in whole degrees, None without contact."""
    return [round(math.degrees(r.elevation)) if r.in_contact else None for r in readings]


def feed_all(stream, pieces):
    """Feed piece after piece and return all readings."""
    return [reading for piece in pieces for reading in stream.feed(piece)]


def test_readings_come_in_order_when_several_sentences_come_at_once():
    stream = SentenceStream()
    assert degrees_of(stream.feed(line(0, 10) + line(1) + line(2, 30))) == [10, None, 30]
    assert stream.received == 3
    assert stream.lost == stream.repeated == stream.restarts == 0
    assert not stream.dropped


def test_reading_comes_with_the_byte_that_ends_its_line():
    stream = SentenceStream()
    sentence = line(0, 10)
    for byte in sentence[:-1]:
        assert stream.feed(bytes([byte])) == []
    assert degrees_of(stream.feed(sentence[-1:])) == [10]


def test_nothing_comes_of_nothing():
    stream = SentenceStream()
    assert stream.feed(b'') == []
    assert stream.feed(b'\r\n\n\r\r\n') == []
    assert stream.received == 0
    assert not stream.dropped


noise = st.binary(max_size=150).map(lambda data: data.replace(b'$', b'#'))
sentences = st.builds(line, st.integers(0, 65535), st.one_of(st.none(), st.integers(0, 90)))


@st.composite
def damaged(draw):
    """Draw a sentence with a part cut out, doubled or replaced."""
    whole = draw(sentences)
    start, end = sorted(draw(st.tuples(*[st.integers(0, len(whole))] * 2)))
    part = draw(st.one_of(st.just(b''), st.just(whole[start:end] * 2), st.binary(max_size=4)))
    return whole[:start] + part + whole[end:]


marks = st.lists(
    st.sampled_from([b'$', b'*', b',', b'\r', b'\n', b'A' * 70, b'\r' * 90]), max_size=6
)
texts = st.lists(
    st.one_of(sentences, damaged(), st.binary(max_size=150), noise, marks.map(b''.join)),
    max_size=12,
).map(b''.join)
everything = settings(derandomize=True, deadline=None, max_examples=300)


def cut(text, cuts):
    """Cut a text at places that may lie behind its end."""
    bounds = [0, *sorted(min(place, len(text)) for place in cuts), len(text)]
    return [text[a:b] for a, b in pairwise(bounds)]


def sentences_and_drops(text):
    """Return what the format says of a text, found byte by byte: valid sentences and drops."""
    valid, drops, segment = [], Counter(), b''

    def finish(segment, ended):
        segment = segment.lstrip(b'\r')
        if len(segment) >= LONGEST or (segment and not ended):
            drops['no line end'] += 1
        elif segment:
            try:
                valid.append(decode(segment))
            except SentenceError as error:
                drops[str(error)] += 1

    for value in text:
        byte = bytes([value])
        if byte in b'$\n':
            finish(segment, byte == b'\n')
            segment = b''
        segment += byte.strip(b'\n')
    if len(segment.lstrip(b'\r')) >= LONGEST:  # what is shorter may go on
        finish(segment, True)
    return valid, drops


def counts(stream):
    """Return all counts of a stream."""
    return (
        stream.received,
        stream.lost,
        stream.repeated,
        stream.late,
        stream.restarts,
        stream.dropped,
    )


@pytest.mark.slow
@given(text=texts, cuts=st.lists(st.integers(0, 1500), max_size=12))
@example(text=b'x' * 100 + line(0, 10), cuts=[95])
@example(text=b'$' + b'x' * 80 + b'\r\n' + line(0, 10), cuts=[81, 82])
@example(text=b'$' * 200, cuts=[100])
@example(text=b'\r' * 200 + line(0, 10), cuts=[100])
@everything
def test_any_bytes_in_any_pieces_give_what_the_format_says(text, cuts):
    valid, drops = sentences_and_drops(text)
    numbers = [sentence.sequence for sentence in valid]
    news = [
        sentence.reading
        for sentence, before in zip(valid, [None, *numbers], strict=False)
        if sentence.sequence != before
    ]
    steps = [(b - a) % 65536 for a, b in pairwise(numbers)]
    expected = (
        len(valid),
        sum(step - 1 for step in steps if 1 <= step <= 32768),
        steps.count(0),
        0,
        sum(step > 32768 for step in steps),
        drops,
    )
    for pieces in ([text], cut(text, cuts), [bytes([byte]) for byte in text]):
        stream = SentenceStream()
        readings = []
        for piece in pieces:
            readings += stream.feed(piece)
            assert len(stream._pending) < LONGEST
        assert degrees_of(readings) == degrees_of(news)
        assert counts(stream) == expected


@given(
    degrees=st.lists(st.integers(0, 90), min_size=1, max_size=10),
    garbage=noise,
    cuts=st.lists(st.integers(0, 600), max_size=10),
    freshness=st.lists(st.booleans(), min_size=11, max_size=11),
)
@example(degrees=[10], garbage=b'', cuts=[5], freshness=[False, *[True] * 10])
@example(degrees=[10], garbage=b'', cuts=[5, 9], freshness=[True, False, *[True] * 9])
@example(degrees=[10, 20], garbage=b'', cuts=[30], freshness=[False, *[True] * 10])
@example(degrees=[10], garbage=b'', cuts=[2, 2], freshness=[True, False, *[True] * 9])
@PROPERTY
def test_sentence_with_a_late_byte_is_late_and_no_other(degrees, garbage, cuts, freshness):
    lines = [line(number, angle) for number, angle in enumerate(degrees)]
    text = garbage + b'\n' + b''.join(lines)
    pieces = cut(text, cuts)
    fresh = [flag for piece, flag in zip(pieces, freshness, strict=False) for _ in piece]
    ends = list(accumulate([len(garbage) + 1, *map(len, lines)]))
    on_time = [all(fresh[a:b]) for a, b in pairwise(ends)]
    stream = SentenceStream()
    readings = [
        reading
        for piece, flag in zip(pieces, freshness, strict=False)
        for reading in stream.feed(piece, flag)
    ]
    assert degrees_of(readings) == [d for d, flag in zip(degrees, on_time, strict=True) if flag]
    assert stream.late == on_time.count(False)
    assert (stream.received, stream.lost, stream.repeated) == (len(degrees), 0, 0)


def test_sentence_after_a_late_half_of_another_is_on_time():
    stream = SentenceStream()
    assert stream.feed(line(0, 10)[:9], fresh=False) == []
    assert degrees_of(stream.feed(line(1, 20))) == [20]
    assert (stream.late, stream.dropped) == (0, {'no line end': 1})


def test_late_sentence_sent_again_is_repeated_and_never_new():
    stream = SentenceStream()
    assert stream.feed(line(4, 10), fresh=False) == []
    assert stream.feed(line(4, 10)) == []
    assert degrees_of(stream.feed(line(6, 20))) == [20]
    assert (stream.received, stream.late, stream.repeated, stream.lost) == (3, 1, 1, 1)


@given(
    garbage=st.lists(noise, min_size=3, max_size=3),
    size=st.sampled_from([1, 7, 64, 4096]),
)
@example(garbage=[b'', b'x' * 200, b''], size=64)
@PROPERTY
def test_garbage_between_sentences_costs_none_of_them(garbage, size):
    text = garbage[0] + line(0, 10) + garbage[1] + line(1, 20) + garbage[2] + line(2, 30)
    stream = SentenceStream()
    pieces = [text[start : start + size] for start in range(0, len(text), size)]
    assert degrees_of(feed_all(stream, pieces)) == [10, 20, 30]
    assert (stream.received, stream.lost) == (3, 0)


def test_sentence_cut_short_costs_itself_only():
    stream = SentenceStream()
    text = line(0, 10) + line(1, 20)[:12] + line(2, 30)
    assert degrees_of(stream.feed(text)) == [10, 30]
    assert stream.lost == 1


@pytest.mark.parametrize('wrong', [*range(0, 256, 5), 13, 36, 42])
def test_one_damaged_byte_costs_one_sentence_at_the_most_its_neighbour_too(wrong):
    good = [line(0, 10), line(1, 20), line(2, 30)]
    for position in range(len(good[1])):
        damaged = good[1][:position] + bytes([wrong]) + good[1][position + 1 :]
        stream = SentenceStream()
        readings = degrees_of(stream.feed(good[0] + damaged + good[2]))
        assert readings in ([10, 20, 30], [10, 30]), (position, wrong)
        assert stream.received + stream.lost == 3


def test_lines_are_dropped_by_reason():
    stream = SentenceStream()
    stream.feed(b'$PTACT,0,V,,,*19\r\n')
    stream.feed(b'hello\r\n')
    stream.feed(b'$GPXXX*%02X\r\n' % (0x47 ^ 0x50 ^ 0x58))
    stream.feed(b'$PTACT,0,V,,,*18\r\n')
    assert stream.dropped == {'wrong checksum': 1, 'no sentence': 1, 'unknown sentence': 1}
    assert stream.received == 1


def test_memory_is_bounded_when_no_line_end_comes():
    noise = random.Random(0)
    stream = SentenceStream()
    for _ in range(256):
        block = bytes(noise.choice(b'abc$*,0123456789\r\xff') for _ in range(1024)) * 4
        assert stream.feed(block) == []
        assert len(stream._pending) < LONGEST
    assert stream.received == 0
    assert set(stream.dropped) == {'no line end'}
    assert degrees_of(stream.feed(b'\n' + line(0, 10))) == [10]


def test_memory_is_bounded_when_bytes_trickle_in():
    stream = SentenceStream()
    for _ in range(1000):
        stream.feed(b'x')
        assert len(stream._pending) < LONGEST
    assert stream.dropped == {'no line end': 1}


def test_longest_sentence_passes_in_single_bytes():
    number = b'+000000010.000000000'
    body = b','.join([b'PTACT', b'65535', b'A', number, number, number])
    value = 0
    for byte in body:
        value ^= byte
    text = b'$' + body + b'*%02X\r\n' % value
    assert len(text) == LONGEST
    stream = SentenceStream()
    assert degrees_of(feed_all(stream, [bytes([byte]) for byte in text])) == [10]
    assert not stream.dropped


def counts_after(*sequence_numbers):
    """Return (readings, lost, repeated, restarts) of a sequence of numbers."""
    stream = SentenceStream()
    readings = stream.feed(b''.join(line(number, 10) for number in sequence_numbers))
    assert stream.received == len(sequence_numbers)
    return len(readings), stream.lost, stream.repeated, stream.restarts


@pytest.mark.parametrize(
    ('sequence_numbers', 'counts'),
    [
        ([5, 6, 7], (3, 0, 0, 0)),
        ([5, 7], (2, 1, 0, 0)),
        ([5, 6, 9, 12], (4, 4, 0, 0)),
        ([5, 5], (1, 0, 1, 0)),
        ([5, 5, 5, 6], (2, 0, 2, 0)),
        ([65534, 65535, 0, 1], (4, 0, 0, 0)),
        ([65534, 1], (2, 2, 0, 0)),
        ([1000, 0, 1], (3, 0, 0, 1)),
        ([1000, 0, 3], (3, 2, 0, 1)),
        ([30000, 29999], (2, 0, 0, 1)),
        ([0, 1000], (2, 999, 0, 0)),
        ([0], (1, 0, 0, 0)),
        ([40000], (1, 0, 0, 0)),
    ],
)
def test_lost_repeated_wrapped_and_restarted_are_told_apart(sequence_numbers, counts):
    assert counts_after(*sequence_numbers) == counts


def test_restart_forgets_the_half_line_and_the_last_number():
    stream = SentenceStream()
    stream.feed(line(100, 10) + line(101, 20)[:20])
    stream.restart()
    assert degrees_of(stream.feed(line(105, 30))) == [30]
    assert stream.lost == 0
    assert not stream.dropped


def test_restart_in_the_middle_of_a_sentence_drops_its_rest_only():
    stream = SentenceStream()
    stream.restart()
    assert degrees_of(stream.feed(line(7, 20)[10:] + line(8, 30))) == [30]
    assert stream.dropped == {'no sentence': 1}


def test_restart_forgets_that_a_line_was_too_long():
    stream = SentenceStream()
    stream.feed(b'x' * 200)
    stream.restart()
    assert degrees_of(stream.feed(line(0, 10))) == [10]


def test_restart_keeps_the_counts():
    stream = SentenceStream()
    stream.feed(line(0, 10) + line(2, 10) + line(2, 10) + b'x\n')
    stream.restart()
    assert (stream.received, stream.lost, stream.repeated) == (3, 1, 1)
    assert stream.dropped.total() == 1
