# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Messages in chunks count all or not at all, others up to the first that is damaged."""

import random

from support.bag_damage import WRITTEN, changed, read, write
from support.bag_files import mcap_bytes


def test_bag_without_chunks_is_read_up_to_its_last_whole_message(tmp_path):
    whole = mcap_bytes(WRITTEN, use_chunking=False)
    ends = [whole.index(data) + len(data) for *_, data in WRITTEN]
    for cut in random.Random(3).sample(range(len(whole)), 300):
        found, warnings = read(write(tmp_path / 'file.mcap', whole[:cut]))
        assert len(found) == sum(end <= cut for end in ends)
        assert found == WRITTEN[: len(found)]
        assert len(warnings) == 1


def test_bag_without_chunks_is_read_up_to_the_first_damage(tmp_path):
    whole = mcap_bytes(WRITTEN, use_chunking=False)
    # The channel of a message stands behind its opcode and length.
    place = whole.index(WRITTEN[70][-1]) - 22 - 9
    data = changed(whole, place + 9, 77)
    found, (line,) = read(write(tmp_path / 'file.mcap', data))
    assert found == WRITTEN[:70]
    assert f'damaged at byte {place} (a message of an unknown channel 77)' in line
