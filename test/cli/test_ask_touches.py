# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""How `tactile_push calibrate` asks for touches; on a real terminal it does in test/system."""

import os

import pytest

pytest.importorskip('rclpy')

from tactile_push.playing import terminal
from tactile_push.recording import hearing


@pytest.fixture
def keys(monkeypatch, tmp_path):
    """Return the keys that a person presses, on a terminal of which there is none."""
    pressed, shown = [], []

    class Terminal:
        answers = True

        def __init__(self, hold, release):
            pass

        def read_keys(self):
            return [pressed.pop(0)]

        def say(self, line):
            shown.append(line)

        show = say

        def close(self):
            shown.append('closed')

    class Hearing:
        type_name = ''

        def __init__(self, topic, types, depth):
            if topic == '1x':
                raise ValueError("expected the name of a topic, got '1x'")
            self.topic = f'/{topic}'

        def take(self):
            return []

        def add_topic(self, bag):
            raise AssertionError

        def close(self):
            shown.append('left')

    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(terminal, 'Terminal', Terminal)
    monkeypatch.setattr(hearing, 'Hearing', Hearing)
    yield pressed
    assert shown == [] or {'closed', 'left'} <= set(shown)
    assert list(tmp_path.iterdir()) == []


def test_end_of_the_input_is_refused(command, keys):
    keys += ['x', '\x04']
    assert command('calibrate', 'wrench') == (
        *(2, ''),
        'tactile_push calibrate: keys: expected Enter, s, r or q, got the end of the input\n',
    )


def test_end_without_a_touch_leaves_nothing(command, keys):
    keys += ['q']
    assert command('calibrate', 'wrench') == (1, '', 'tactile_push calibrate: no touches\n')


def test_bad_topic_is_refused(command, keys):
    status, _, err = command('calibrate', 'wrench', '--topic', '1x')
    assert status == 2
    assert err == "tactile_push calibrate: --topic: expected the name of a topic, got '1x'\n"


def test_without_ros_it_says_how_to_get_it(command, keys, monkeypatch):
    from tactile_push.cli import ask_touches

    monkeypatch.setattr(ask_touches, 'ros_is_missing', lambda who: True)
    assert command('calibrate', 'wrench') == (2, '', '')


def test_without_a_terminal_it_is_refused(command, monkeypatch):
    monkeypatch.setattr(os, 'isatty', lambda descriptor: False)
    assert command('calibrate', 'wrench') == (
        *(2, ''),
        'tactile_push calibrate: expected FOLDER|BAG, or a terminal on which to ask for touches\n',
    )
