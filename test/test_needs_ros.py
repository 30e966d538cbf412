# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
import sys

import pytest

from tactile_push.needs_ros import ros_is_missing


def test_ros_that_is_installed_is_not_spoken_of(capsys):
    pytest.importorskip('rclpy')
    assert not ros_is_missing('tactile_push record')
    assert capsys.readouterr() == ('', '')


def test_who_needs_ros_says_how_to_get_it(capsys, monkeypatch):
    monkeypatch.setitem(sys.modules, 'rclpy', None)
    assert ros_is_missing('tactile_push record')
    assert capsys.readouterr() == (
        '',
        'tactile_push record: needs ROS 2: source a ROS 2 workspace, or on x86-64 Linux '
        "pip install 'tactile_push[ros]'\n",
    )
