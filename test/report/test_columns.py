# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Columns of what a bag says: whose, when, and of which type."""

import math

import pytest

from support.bag_copies import with_topics
from support.foreign_topics import BOOL, NAMESAKES, OTHERS
from support.pushed_bag import (
    JOINTS,
    POSE,
    R,
    diagnostics,
    joint_state,
    pose,
    run_of,
    write_bag,
    written,
)
from tactile_push.bags import BagError, BagReader
from tactile_push.report import messages_shown, read_run


def test_stamps_of_another_clock_give_way_to_the_time_of_recording(tmp_path):
    contact = pose(-1e6, 0.0, R, 0.0)
    run = run_of(
        written(
            tmp_path / 'bag',
            ('/contact', POSE, 0.0, contact),
            ('/contact', POSE, 5.0, pose(4.9, 0.0, R, 0.0)),
            ('/contact', POSE, 6.0, contact),
        )
    )
    assert run.series['theta'].time == pytest.approx([0.0, 4.9, 6.0])


def test_stamps_that_go_back_are_put_in_order(tmp_path):
    run = run_of(
        written(
            tmp_path / 'bag',
            ('/contact', POSE, 0.0, pose(1.0, 0.0, R, 0.2)),
            ('/contact', POSE, 0.1, pose(0.5, 0.0, R, 0.1)),
        )
    )
    assert run.series['theta'].values == pytest.approx([0.1, 0.2])


def test_states_of_an_older_version_lack_what_they_lack(tmp_path):
    run = run_of(
        written(
            tmp_path / 'bag',
            ('/push_controller/state', JOINTS, 0.0, joint_state(0.0, theta=0.1)),
            ('/push_controller/state', JOINTS, 0.1, joint_state(0.1, theta=0.1, phi=1.5)),
        )
    )
    assert run.series['phi'].values == pytest.approx([math.nan, 1.5], nan_ok=True)
    assert 'silence' not in run.series
    assert run.states == ()


def test_status_of_every_level(tmp_path):
    kind = 'diagnostic_msgs/msg/DiagnosticArray'
    levels = (b'\x00', b'\x01', b'\x02', b'\x03')
    rows = [
        ('/diagnostics', kind, float(k), diagnostics(float(k), 'node', level, f'level {k}'))
        for k, level in enumerate(levels)
    ]
    tactile = ('/tactile', JOINTS, 9.0, joint_state(9.0, azimuth=0.0, elevation=1.0))
    run = run_of(written(tmp_path / 'bag', *rows, tactile))
    assert [(e.text, e.level, e.start, e.end) for e in run.episodes] == [
        ('level 1', 'warning', 1.0, 2.0),
        ('level 2', 'error', 2.0, 3.0),
        ('level 3', 'error', 3.0, 5.0),
    ]


def test_second_finger_is_left_out_with_a_word(tmp_path):
    state = joint_state(0.0, theta=0.1, phi=1.5)
    contact = pose(0.0, 0.0, R, 0.0)
    run = run_of(
        written(
            tmp_path / 'bag',
            ('/right/contact', POSE, 0.0, contact),
            ('/left/contact', POSE, 0.0, contact),
            ('/left/push_controller/state', JOINTS, 0.0, state),
        )
    )
    assert run.series['phi'].values.tolist() == [1.5]
    assert run.warnings == ['not shown: the topics in /right']


def test_bag_of_something_else_is_refused(tmp_path):
    data = joint_state(0.0, wheel=1.0)
    folder = written(tmp_path / 'bag', ('/wheels', JOINTS, 0.0, data))
    with pytest.raises(BagError, match=r'bag: nothing to report, expected messages on push_'):
        run_of(folder)


def test_topic_of_another_type_is_refused(tmp_path):
    data = joint_state(0.0, theta=1.0)
    folder = written(tmp_path / 'bag', ('/contact', JOINTS, 0.0, data))
    with pytest.raises(BagError, match=rf'/contact \(expected {POSE}, got {JOINTS}\)'):
        run_of(folder)


def run_and_warnings(folder):
    """Return what a report makes of a bag, and what it warns of."""
    warnings = []
    with BagReader(folder, warnings.append) as bag:
        assert messages_shown(bag) <= sum(bag.counts.values())
        run = read_run(bag)
    return run, warnings + run.warnings


def test_diagnostics_of_another_type_are_left_alone(tmp_path):
    contact = ('/contact', POSE, 0.0, pose(0.0, 0.0, R, 0.0))
    bag = written(tmp_path / 'bag', contact, ('/diagnostics', BOOL[0], 0.0, BOOL[-1]))
    run, (line,) = run_and_warnings(bag)
    assert len(run.series['theta'].values) == 1
    assert '/diagnostics (expected diagnostic_msgs/msg/DiagnosticArray, got std_msgs/' in line


def test_foreign_topics_are_left_alone_and_named_once(tmp_path):
    bag = write_bag(tmp_path / 'bag')
    expected = run_of(bag)
    mixed = with_topics(bag, tmp_path / 'mixed', *NAMESAKES, *OTHERS)
    run, (line,) = run_and_warnings(mixed)
    assert set(run.series) == set(expected.series)
    assert [e.text for e in run.episodes if e.lane == 'controller'] == ['stopped: contact silent']
    assert line.startswith(f'{mixed}: left alone: /glove/tactile (expected sensor_msgs/msg/Joint')
    assert '/hand/contact (expected' in line and '/web/contact (expected' in line
