# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Surveys of bags that are cut off; those of whole bags are tested with `tactile_push info`."""

import itertools

from support.bag_damage import CHUNKS, WHOLE, WRITTEN, write
from tactile_push.bags import BagReader
from tactile_push.bags.survey import survey


def test_bag_cut_off_anywhere_in_its_first_chunks_is_surveyed(tmp_path):
    end = CHUNKS[1][1]
    for cut in range(end + 1):
        with BagReader(write(tmp_path / 'file.mcap', WHOLE[:cut]), lambda line: None) as reader:
            found = survey(reader)
        assert found.messages == sum(len(chunk[2]) for chunk in CHUNKS[:2] if chunk[1] <= cut)
        assert found.files[0].size == cut
        assert found.files[0].compression == ('zstd' if cut >= CHUNKS[0][1] else '')


def test_interval_of_the_messages_is_that_of_the_bag(tmp_path):
    with BagReader(write(tmp_path / 'file.mcap', WHOLE)) as reader:
        found = survey(reader)
    assert found.messages == len(WRITTEN) == sum(topic.messages for topic in found.topics)
    for topic in found.topics:
        times = [time for name, time, *_ in WRITTEN if name == topic.name]
        gaps = [after - before for before, after in itertools.pairwise(times)]
        assert topic.largest_gap == max(gaps) / 1e9
        assert topic.out_of_order is None
