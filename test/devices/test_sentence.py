# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
r"""The wire format against sentences made by hand and against broken ones.

A sentence is `$PTACT,<sequence>,A,<azimuth>,<elevation>,<force>*hh\r\n` with angles in degrees,
or `$PTACT,<sequence>,V,,,*hh\r\n` without contact; hh is the XOR of the bytes between `$` and `*`.
"""

import math
from functools import reduce
from operator import xor

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from tactile_push.devices import Sentence, SentenceError, checksum, decode, encode
from tactile_push.tactile import NO_CONTACT, Reading

PROPERTY = settings(derandomize=True, deadline=None, max_examples=100)
LONGEST = 82  # NMEA 0183, `$` and line end included
RESOLUTION = math.radians(0.00005)  # half of the last printed digit [rad]


def sentence_of(body):
    """Frame a body as NMEA 0183 does."""
    return b'$' + body + b'*%02X\r\n' % reduce(xor, body, 0)


def same(one, other):
    """Tell whether two sentences agree, NaN being equal to NaN."""
    return one.sequence == other.sequence and all(
        a == b or (math.isnan(a) and math.isnan(b))
        for a, b in (
            (one.reading.azimuth, other.reading.azimuth),
            (one.reading.elevation, other.reading.elevation),
            (one.reading.normal_force, other.reading.normal_force),
        )
    )


sequences = st.integers(0, 65535)
contacts = st.builds(
    Reading,
    st.floats(-math.pi, math.pi),
    st.floats(0.0, math.pi / 2.0),
    st.one_of(st.just(math.nan), st.floats(-1000.0, 1000.0)),
)


def test_checksum_of_the_example_that_every_nmea_text_gives():
    body = b'GPGGA,123519,4807.038,N,01131.000,E,1,08,0.9,545.4,M,46.9,M,,'
    assert checksum(body) == 0x47


def test_checksum_is_the_xor_of_the_bytes():
    assert checksum(b'') == 0
    assert checksum(b'\x0f') == 0x0F
    assert checksum(b'\xf0\x0f\x01') == 0xFE


def test_sentence_made_by_hand_with_force():
    body = b'PTACT,7,A,180.0000,70.0000,1.250'
    value = 0
    for byte in body:
        value ^= byte
    line = b'$PTACT,7,A,180.0000,70.0000,1.250*' + f'{value:02X}'.encode() + b'\r\n'
    decoded = decode(line)
    assert decoded.sequence == 7
    assert decoded.reading.azimuth == math.pi
    assert decoded.reading.elevation == pytest.approx(70.0 * math.pi / 180.0)
    assert decoded.reading.normal_force == 1.25
    assert encode(Sentence(7, Reading(math.pi, math.radians(70.0), 1.25))) == line


def test_sentence_made_by_hand_without_force():
    line = sentence_of(b'PTACT,65535,A,-90.5000,45.0000,')
    decoded = decode(line)
    assert decoded.sequence == 65535
    assert decoded.reading.azimuth == pytest.approx(math.radians(-90.5))
    assert decoded.reading.elevation == pytest.approx(math.pi / 4.0)
    assert math.isnan(decoded.reading.normal_force)
    assert encode(Sentence(65535, Reading(math.radians(-90.5), math.pi / 4.0))) == line


def test_sentence_made_by_hand_without_contact():
    # P ^ T ^ A ^ C ^ T = 0x50 ^ 0x41 ^ 0x43 = 0x52; five commas leave one, 0x2C; '0' is 0x30 and
    # 'V' 0x56: 0x52 ^ 0x2C ^ 0x30 ^ 0x56 = 0x18.
    line = b'$PTACT,0,V,,,*18\r\n'
    assert decode(line) == Sentence(0, NO_CONTACT)
    assert encode(Sentence(0, NO_CONTACT)) == line


@pytest.mark.parametrize('end', [b'', b'\n', b'\r', b'\r\n'])
def test_line_end_does_not_matter(end):
    assert decode(b'$PTACT,0,V,,,*18' + end).sequence == 0


def test_checksum_digits_may_be_small():
    # 0x1A: as above, with '2' for '0'.
    assert decode(b'$PTACT,2,V,,,*1A\r\n').sequence == 2
    assert decode(b'$PTACT,2,V,,,*1a\r\n').sequence == 2


def test_numbers_need_not_have_a_fraction_or_may_have_a_sign():
    reading = decode(sentence_of(b'PTACT,3,A,+10,5.5,-2')).reading
    assert math.degrees(reading.azimuth) == pytest.approx(10.0)
    assert math.degrees(reading.elevation) == pytest.approx(5.5)
    assert reading.normal_force == -2.0


@given(sequence=sequences, reading=contacts)
@example(sequence=0, reading=Reading(math.pi, math.pi / 2.0))
@example(sequence=0, reading=Reading(-1e-9, 1e-9, -1e-9))
@PROPERTY
def test_round_trip_of_a_contact_within_the_printed_digits(sequence, reading):
    line = encode(Sentence(sequence, reading))
    assert len(line) <= LONGEST
    assert line.endswith(b'\r\n')
    decoded = decode(line)
    assert decoded.sequence == sequence
    assert decoded.reading.azimuth == pytest.approx(reading.azimuth, abs=1.01 * RESOLUTION)
    assert decoded.reading.elevation == pytest.approx(reading.elevation, abs=1.01 * RESOLUTION)
    assert -math.pi <= decoded.reading.azimuth <= math.pi
    assert decoded.reading.elevation <= math.pi / 2.0
    if math.isnan(reading.normal_force):
        assert math.isnan(decoded.reading.normal_force)
    else:
        assert decoded.reading.normal_force == pytest.approx(reading.normal_force, abs=0.000501)


@given(sequence=sequences)
@PROPERTY
def test_round_trip_without_contact(sequence):
    line = encode(Sentence(sequence, NO_CONTACT))
    assert len(line) <= LONGEST
    assert decode(line) == Sentence(sequence, NO_CONTACT)


def test_sequence_starts_over_after_65535():
    assert encode(Sentence(65536, NO_CONTACT)) == encode(Sentence(0, NO_CONTACT))
    assert encode(Sentence(65543, NO_CONTACT)) == encode(Sentence(7, NO_CONTACT))


def test_longest_sentence_that_is_read_has_82_bytes():
    number = b'+123456789.123456789'
    line = sentence_of(b','.join([b'PTACT', b'65535', b'A', number, number, number]))
    assert len(line) == LONGEST
    assert decode(line).reading.normal_force == pytest.approx(123456789.123456789)


@pytest.mark.parametrize(
    'line',
    [
        encode(Sentence(60123, Reading(math.radians(-123.4567), math.radians(67.8901), 12.345))),
        sentence_of(b'PTACT,0,A,180.0000,90.0000,'),
        b'$PTACT,0,V,,,*18\r\n',
    ],
    ids=['force', 'no force', 'no contact'],
)
def test_every_change_of_a_single_byte_is_caught_or_harmless(line):
    original = decode(line)
    rejected = harmless = 0
    for position, right in enumerate(line):
        for wrong in set(range(256)) - {right}:
            damaged = line[:position] + bytes([wrong]) + line[position + 1 :]
            try:
                decoded = decode(damaged)
            except SentenceError:
                rejected += 1
            else:
                harmless += 1
                assert same(decoded, original), damaged
    assert rejected + harmless == 255 * len(line)
    # A letter of the checksum may change its case, and a line end into another; no more than that.
    assert harmless <= 2 + 2
    changed_in_body = 0
    body = line[1:-5]
    for position, right in enumerate(body):
        for wrong in set(range(256)) - {right}:
            damaged = body[:position] + bytes([wrong]) + body[position + 1 :]
            changed_in_body += checksum(damaged) != checksum(body)
    assert changed_in_body == 255 * len(body)


@pytest.mark.parametrize(
    ('line', 'reason'),
    [
        (b'', 'no sentence'),
        (b'$', 'no sentence'),
        (b'*00', 'no sentence'),
        (b'$00', 'no sentence'),
        (b'$*0', 'no sentence'),
        (b'PTACT,0,V,,,*18', 'no sentence'),
        (b' $PTACT,0,V,,,*18', 'no sentence'),
        (b'$PTACT,0,V,,,*18 ', 'no sentence'),
        (b'$PTACT,0,V,,,', 'no sentence'),
        (b'$PTACT,0,V,,,*1', 'no sentence'),
        (b'$PTACT,0,V,,,*1G', 'no sentence'),
        (b'$PTACT,0,V,,,* 8', 'no sentence'),
        (b'$PTACT,0,V,,,*+8', 'no sentence'),
        (b'$PTACT,0,V,,,*19', 'wrong checksum'),
        (b'$*00', 'unknown sentence'),
    ],
)
def test_line_that_is_no_sentence_is_rejected_with_its_reason(line, reason):
    with pytest.raises(SentenceError, match=f'^{reason}$'):
        decode(line)


@pytest.mark.parametrize(
    'body',
    [
        b'GPGGA,123519,4807.038,N,01131.000,E,1,08,0.9,545.4,M,46.9,M,,',
        b'PTACT',
        b'PTACT,1',
        b'PTACT,1,V,,',
        b'PTACT,1,V,,,,',
        b'PTACT,1,A,1.0,2.0,3.0,4.0',
        b'ptact,1,V,,,',
        b'PTACT,65536,V,,,',
        b'PTACT,99999,V,,,',
        b'PTACT,100000,V,,,',
        b'PTACT,000001,V,,,',
        b'PTACT,-1,V,,,',
        b'PTACT,+1,V,,,',
        b'PTACT, 1,V,,,',
        b'PTACT,,V,,,',
        b'PTACT,1.0,V,,,',
        b'PTACT,0x1,V,,,',
        b'PTACT,1_0,V,,,',
        b'PTACT,\xd9\xa1,V,,,',
    ],
)
def test_sentence_of_another_kind_is_rejected(body):
    with pytest.raises(SentenceError, match='^unknown sentence$'):
        decode(sentence_of(body))


NO_NUMBERS = [
    b'nan',
    b'NaN',
    b'inf',
    b'-inf',
    b'Infinity',
    b'1e5',
    b'1E5',
    b'0x10',
    b'1_0',
    b' 1',
    b'1 ',
    b'1.',
    b'.5',
    b'--1',
    b'+-1',
    b'+',
    b'-',
    b'1.2.3',
    b'1,5'.replace(b',', b';'),
    b'1234567890',
    b'0.1234567890',
    b'\xd9\xa1',
    '１'.encode(),
    b'1\x00',
    b'1\n',
    b'one',
]


@pytest.mark.parametrize('number', NO_NUMBERS)
@pytest.mark.parametrize('field', [0, 1, 2], ids=['azimuth', 'elevation', 'force'])
def test_field_that_is_no_plain_decimal_number_is_rejected(number, field):
    numbers = [b'10.0', b'20.0', b'1.0']
    numbers[field] = number
    with pytest.raises(SentenceError, match='^unreadable fields$'):
        decode(sentence_of(b'PTACT,1,A,' + b','.join(numbers)))


@pytest.mark.parametrize(
    'fields',
    [
        b'A,,20.0,1.0',
        b'A,10.0,,1.0',
        b'A,,,',
        b'V,10.0,20.0,',
        b'V,,,1.0',
        b'V, ,,',
        b'a,10.0,20.0,',
        b',10.0,20.0,',
        b'B,10.0,20.0,1.0',
        b'AA,10.0,20.0,1.0',
    ],
)
def test_status_and_fields_have_to_go_together(fields):
    with pytest.raises(SentenceError, match='^unreadable fields$'):
        decode(sentence_of(b'PTACT,1,' + fields))


def test_angles_off_the_hemisphere_are_passed_on_for_the_geometry_to_judge():
    reading = decode(sentence_of(b'PTACT,1,A,270.0,-5.0,')).reading
    assert reading.azimuth == pytest.approx(1.5 * math.pi)
    assert reading.elevation == pytest.approx(math.radians(-5.0))


def accepts_safely(line):
    """Decode; give whether it was accepted, and see to it that what was accepted is usable."""
    try:
        sentence = decode(line)
    except SentenceError as error:
        assert 1 <= len(str(error).split()) <= 3
        return False
    assert 0 <= sentence.sequence <= 65535
    if sentence.reading.in_contact:
        assert math.isfinite(sentence.reading.azimuth)
        assert math.isfinite(sentence.reading.elevation)
        assert not math.isinf(sentence.reading.normal_force)
    return True


@given(line=st.binary(max_size=120))
@PROPERTY
def test_arbitrary_bytes_raise_nothing_but_a_sentence_error(line):
    accepts_safely(line)


@given(body=st.binary(max_size=60))
@PROPERTY
def test_arbitrary_bytes_with_a_right_checksum_raise_nothing_but_a_sentence_error(body):
    accepts_safely(sentence_of(body))


words = st.sampled_from([b'', b'nan', b'inf', b'1e9', b'-0', b'0.0', b'90.0000', b'9' * 9, b'7'])
near_sentences = st.builds(
    lambda sequence, status, fields: b','.join([b'PTACT', sequence, status, *fields]),
    st.one_of(words, st.integers(-10, 70000).map(lambda number: b'%d' % number)),
    st.sampled_from([b'A', b'A', b'A', b'V', b'']),
    st.lists(st.one_of(words, st.text('0123456789.+-eE', max_size=8).map(str.encode)), max_size=4),
)


@given(body=near_sentences)
@example(body=b'PTACT,1,A,90.0000,0.0,')
@settings(derandomize=True, deadline=None, max_examples=200)
def test_bytes_near_a_sentence_give_no_reading_that_is_not_finite(body):
    accepts_safely(sentence_of(body))


def test_the_check_above_does_accept_sentences():
    assert accepts_safely(sentence_of(b'PTACT,1,A,90.0000,0.0,'))
    assert not accepts_safely(sentence_of(b'PTACT,1,A,nan,0.0,'))
