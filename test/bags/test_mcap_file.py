# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""MCAP files with wrong bytes anywhere."""

import os
import random
import re
import tracemalloc

import pytest
import zstandard
from hypothesis import given, settings
from hypothesis import strategies as st
from mcap.writer import CompressionType

from support.bag_damage import CHUNKS, WHOLE, WRITTEN, changed, read, write
from support.bag_files import SECOND, mcap_bytes
from tactile_push.bags import BagError, BagReader


@pytest.mark.parametrize('number', [0, 5, len(CHUNKS) - 1])
def test_chunk_with_a_wrong_byte_is_left_out_of_a_closed_bag(tmp_path, number):
    start, end, lost = CHUNKS[number]
    found, warnings = read(write(tmp_path / 'file.mcap', changed(WHOLE, end - 3)))
    assert found == [message for message in WRITTEN if message not in lost]
    (line,) = warnings
    assert f'at byte {start}' in line and f'{end - start} bytes' in line


def test_what_is_left_out_is_told_of_once(tmp_path):
    _, end, lost = CHUNKS[4]
    path = write(tmp_path / 'file.mcap', changed(WHOLE, end - 3))
    warnings = []
    with BagReader(path, warnings.append) as reader:
        assert warnings == []
        assert sum(reader.counts.values()) == len(WRITTEN)
        assert len(list(reader.messages())) == len(list(reader.messages()))
    (line,) = warnings
    times = [(message[1] - WRITTEN[0][1]) / SECOND for message in (lost[0], lost[-1])]
    assert f'from {times[0]:.3f} s to {times[1]:.3f} s' in line


@pytest.mark.parametrize('size', [0, 1, 7])
def test_file_of_less_than_its_first_bytes_is_an_empty_bag(tmp_path, size):
    found, warnings = read(write(tmp_path / 'file.mcap', WHOLE[:size]))
    assert found == []
    assert f'{size} bytes' in warnings[0]


def test_a_damaged_bag_stays_as_it_is(tmp_path):
    path = write(tmp_path / 'file.mcap', changed(WHOLE, CHUNKS[3][1] - 3)[:-20])
    os.chmod(path, 0o444)
    before = path.stat()
    read(path)
    assert path.read_bytes() == changed(WHOLE, CHUNKS[3][1] - 3)[:-20]
    after = path.stat()
    assert (after.st_mtime_ns, after.st_mode) == (before.st_mtime_ns, before.st_mode)
    assert list(tmp_path.iterdir()) == [path]


def try_to_read(path):
    """Return what `read` returns, and None if it refuses the bag in a line."""
    try:
        return read(path)
    except BagError as error:
        assert re.fullmatch('[^\n]+', str(error)) and str(path) in str(error)
        return None


@pytest.mark.slow
def test_one_wrong_byte_anywhere_is_never_silent_and_never_believed(tmp_path):
    for place in (*range(8), *random.Random(6).sample(range(8, len(WHOLE)), 1000)):
        result = try_to_read(write(tmp_path / 'file.mcap', changed(WHOLE, place)))
        if result is None:
            assert place < 8  # the file does not begin as MCAP files do
            continue
        found, warnings = result
        assert set(found) <= set(WRITTEN)
        assert found == sorted(found, key=lambda message: message[1])
        assert found == WRITTEN or warnings


KINDS = {
    'zstd': WHOLE,
    'lz4': mcap_bytes(WRITTEN, compression=CompressionType.LZ4),
    'none': mcap_bytes(WRITTEN, compression=CompressionType.NONE),
    'no checksums': mcap_bytes(WRITTEN, compression=CompressionType.NONE, enable_crcs=False),
    'no chunks': mcap_bytes(WRITTEN, use_chunking=False, enable_crcs=False),
    'file': zstandard.compress(WHOLE),
}

DAMAGE = st.tuples(
    st.sampled_from(['put', 'insert', 'delete', 'cut', 'copy']),
    st.floats(0, 1, exclude_max=True),
    st.binary(min_size=1, max_size=9) | st.sampled_from([b'\xff' * 8, bytes(8), b'\xff' * 4]),
    st.integers(1, 300),
)


def damaged(data, damages):
    """Return bytes after what has happened to them."""
    for what, where, new, size in damages:
        place = int(where * len(data))
        if what == 'put':
            data = data[:place] + new + data[place + len(new) :]
        elif what == 'insert':
            data = data[:place] + new + data[place:]
        elif what == 'delete':
            data = data[:place] + data[place + size :]
        elif what == 'cut':
            data = data[: max(place, 8)]
        else:
            data = data[:place] + data[place // 2 : place // 2 + size] + data[place:]
    return data


@pytest.mark.slow
@pytest.mark.parametrize('kind', KINDS)
@settings(deadline=None)
@given(st.lists(DAMAGE, min_size=1, max_size=4))
def test_any_damage_ends_in_messages_or_in_one_line(tmp_path_factory, kind, damages):
    folder = tmp_path_factory.getbasetemp()
    path = folder / ('fuzz.mcap.zstd' if kind == 'file' else 'fuzz.mcap')
    write(path, damaged(KINDS[kind], damages))
    tracemalloc.start()
    try:
        result = try_to_read(path)
        _, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert peak < 2e7
    if result is not None and kind in ('zstd', 'lz4', 'none', 'file'):
        assert set(result[0]) <= set(WRITTEN)
