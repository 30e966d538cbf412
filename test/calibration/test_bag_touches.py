# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What is refused of a bag of touches, whatever the sensor."""

from pathlib import Path
from types import SimpleNamespace

import pytest

from tactile_push.calibration.bag_touches import (
    check_count,
    only_frame,
    only_topic,
    touches_in_order,
)


class Topic(SimpleNamespace):
    def trouble(self, fields):
        return f'{self.name}: no {", ".join(set(fields) - set(self.has))}' if self.has else ''


def bag(*topics):
    made = [Topic(name=name, type_name=kind, has=has) for name, kind, has in topics]
    return SimpleNamespace(topics={topic.name: topic for topic in made})


KINDS = {'A': {'x': 0, 'y': 0}, 'B': {}}


def test_topic_of_one_of_the_types_is_found():
    assert only_topic(bag(('/a', 'C', []), ('/b', 'B', [])), KINDS, 'things').name == '/b'


@pytest.mark.parametrize(
    ('topics', 'words'),
    [
        ([('/a', 'C', [])], 'expected one topic of things, got none'),
        ([('/a', 'A', []), ('/b', 'B', [])], 'expected one topic of things, got /a, /b'),
        ([('/a', 'A', ['x'])], '/a: no y'),
    ],
)
def test_bag_without_the_one_topic_is_refused(topics, words):
    with pytest.raises(ValueError, match=f'^{words}$'):
        only_topic(bag(*topics), KINDS, 'things')


def test_lines_without_a_touch_are_none(tmp_path):
    table = tmp_path / 'touches.csv'
    table.write_text('azimuth_deg,elevation_deg\n0,90\n,\n10,80\n')
    assert len(touches_in_order(table)) == 2


def test_table_has_as_many_touches_as_the_bag():
    check_count(Path('t.csv'), [None, None], 2)
    with pytest.raises(ValueError, match=r't\.csv: expected 3 touches as in the bag, got 2'):
        check_count(Path('t.csv'), [None, None], 3)


def test_messages_are_of_one_sensor():
    assert only_frame({'left'}) == 'left'
    assert only_frame(set()) == ''
    with pytest.raises(ValueError, match='expected messages in one frame, got left, right'):
        only_frame({'right', 'left'})
