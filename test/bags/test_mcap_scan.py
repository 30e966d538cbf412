# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Bags without an index: cut off anywhere, or damaged, they are read up to there with a warning."""

import random

import pytest
from mcap.writer import CompressionType

from support.bag_damage import (
    CHUNKS,
    WHOLE,
    WRITTEN,
    changed,
    chunks_of,
    read,
    read_up_to,
    sound_before,
    write,
)
from support.bag_files import SECOND, mcap_bytes


def test_the_bag_has_what_the_tests_are_about():
    assert len(CHUNKS) > 10
    assert [message for *_, messages in CHUNKS for message in messages] == WRITTEN


def test_bag_cut_off_at_every_byte_of_its_last_chunk(tmp_path):
    start, end, messages = CHUNKS[-1]
    before = sound_before(start)
    for cut in range(start, end):
        found, warnings = read(write(tmp_path / 'file.mcap', WHOLE[:cut]))
        assert found == before
        (line,) = warnings
        assert 'cut off' in line
        if cut > start:
            assert f' {cut - start} bytes' in line
    # Once the beginning of the chunk is there, it is known how long it was.
    seconds = (messages[-1][1] - before[-1][1]) / SECOND
    assert f'about {seconds:.3f} s at the end cannot be read' in line


@pytest.mark.slow
def test_bag_cut_off_behind_its_last_chunk_lacks_nothing(tmp_path):
    for cut in (*range(CHUNKS[-1][1], len(WHOLE), 10), len(WHOLE) - 1):
        found, warnings = read(write(tmp_path / 'file.mcap', WHOLE[:cut]))
        assert found == WRITTEN
        assert len(warnings) == 1
    assert 'no message is missing' in warnings[0]


@pytest.mark.slow
def test_bag_cut_off_at_a_thousand_random_places(tmp_path):
    places = random.Random(1)
    for cut in (places.randrange(len(WHOLE)) for _ in range(1000)):
        found, warnings = read(write(tmp_path / 'file.mcap', WHOLE[:cut]))
        assert found == sound_before(cut)
        assert len(warnings) == 1


@pytest.mark.parametrize('compression', [CompressionType.NONE, CompressionType.LZ4])
def test_bag_of_another_compression_cut_off(tmp_path, compression):
    whole = mcap_bytes(WRITTEN, compression=compression)
    chunks = chunks_of(whole)
    for cut in random.Random(2).sample(range(len(whole)), 200):
        found, warnings = read(write(tmp_path / 'file.mcap', whole[:cut]))
        assert found == [
            message for _, end, messages in chunks if end <= cut for message in messages
        ]
        assert len(warnings) == 1


@pytest.mark.parametrize('number', [0, 5, len(CHUNKS) - 1])
def test_unclosed_bag_is_read_up_to_a_chunk_with_a_wrong_byte(tmp_path, number):
    start, end, _ = CHUNKS[number]
    data = changed(WHOLE, end - 3)[: CHUNKS[-1][1]]
    read_up_to(tmp_path / 'file.mcap', data, start)


def test_unclosed_bag_is_read_up_to_a_hole(tmp_path):
    start, end = CHUNKS[3][1], CHUNKS[5][1] - 7
    data = WHOLE[:start] + bytes(end - start) + WHOLE[end : CHUNKS[-1][1]]
    read_up_to(tmp_path / 'file.mcap', data, start)


@pytest.mark.parametrize('place', range(9))
def test_unclosed_bag_is_read_up_to_a_wrong_opcode_or_length(tmp_path, place):
    start = CHUNKS[3][0]
    data = changed(WHOLE, start + place)[: CHUNKS[-1][1]]
    read_up_to(tmp_path / 'file.mcap', data, start)
