# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Files that rosbag2 has compressed, cut off; errors about files of any name."""

import random

import pytest
import zstandard
from mcap.writer import CompressionType

from support.bag_damage import read, write
from support.bag_files import mcap_bytes, some_messages
from tactile_push.bags import BagError


@pytest.mark.slow
def test_compressed_file_cut_off(tmp_path):
    written = some_messages(10_000)
    mcap = mcap_bytes(written, chunk_size=2_000, compression=CompressionType.NONE)
    whole = zstandard.compress(mcap)
    lengths = set()
    for cut in random.Random(4).sample(range(20, len(whole)), 30):
        found, warnings = read(write(tmp_path / 'file.mcap.zstd', whole[:cut]))
        assert found == written[: len(found)]
        # zstd's last block has the index.
        assert len(found) == len(written) or len(warnings) == 1
        lengths.add(len(found))
    assert len(lengths) > 2


@pytest.mark.parametrize(
    ('text', 'line'),
    [
        ('/tmp/θ: cut off', '/tmp/θ: cut off'),
        ('two\nlines\r', r'two\nlines\r'),
        ('\x1b[2J', r'\x1b[2J'),
        ('\u2028\u202e', r'\u2028\u202e'),
        ('\udcff', r'\udcff'),
    ],
)
def test_error_is_a_line_whatever_the_bag_calls_things(text, line):
    assert str(BagError(text)) == line
