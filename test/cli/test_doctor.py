# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The words of `tactile_push doctor`, and what it prints of what was seen."""

import io
import json
import math
import sys
from contextlib import contextmanager
from types import SimpleNamespace

import pytest

from support.finger_seen import WELL
from tactile_push.doctor import Snapshot
from tactile_push.interface import CONTACT_GEOMETRY, TACTILE


@pytest.fixture
def seen(monkeypatch):
    """Let the doctor see what the test says; return where it looked."""
    looked = []

    def let(snapshot):
        def look(namespace):
            looked.append(namespace)
            if isinstance(snapshot, BaseException):
                raise snapshot
            return snapshot

        monkeypatch.setitem(sys.modules, 'tactile_push.doctor.looking', SimpleNamespace(look=look))
        monkeypatch.setattr('tactile_push.cli.ros_is_missing', lambda who: False)
        return looked

    return let


def test_what_is_missing_stands_on_lines_with_the_remedy(command, seen):
    looked = seen(Snapshot(()))
    status, out, err = command('doctor', '--namespace', 'left/')
    assert (status, err) == (1, '')
    assert looked == ['/left']
    lines = out.splitlines()
    assert lines[0] == (
        'missing contact_geometry: does not run, or hangs; ros2 run tactile_push contact_geometry'
    )
    assert len(lines) == 3
    assert TACTILE in lines[2]


def test_json_has_the_findings(command, seen):
    seen(Snapshot(()))
    status, out, _ = command('doctor', '--json')
    assert status == 1
    found = json.loads(out)['findings']
    assert found[0] == {
        'verdict': 'missing',
        'subject': CONTACT_GEOMETRY,
        'words': 'does not run, or hangs',
        'remedy': f'ros2 run tactile_push {CONTACT_GEOMETRY}',
    }


def test_nothing_wrong_is_status_0(command, seen, monkeypatch):
    seen(Snapshot(()))
    monkeypatch.setattr('tactile_push.doctor.findings', lambda snapshot: [])
    assert command('doctor') == (0, '', '')


def test_interrupt_is_silent(command, seen):
    seen(KeyboardInterrupt())
    assert command('doctor') == (130, '', '')


class Terminal(io.StringIO):
    def isatty(self):
        return True


TOUCHED = ((0.1, 1.2), (3.0, 1.1), (1.5, 1.2), (math.nan, math.nan))


@pytest.fixture
def touched(seen, monkeypatch):
    """Let the doctor feel four touches, at which a terminal says so many words."""

    def let(words):
        seen(WELL)

        @contextmanager
        def hearing_readings(namespace):
            readings = iter(TOUCHED)
            yield lambda: [next(readings)] * 5

        sys.modules['tactile_push.doctor.looking'].hearing_readings = hearing_readings
        monkeypatch.setattr(sys, 'stdin', words)

    return let


def test_touches_are_asked_for_one_after_the_other(command, touched):
    touched(Terminal('\n' * 4))
    status, out, err = command('doctor', '--touches')
    assert status == 0
    places = ('left', 'right', 'above', 'nothing')
    assert [place in asked for place, asked in zip(places, err.split(': '), strict=False)] == [
        True
    ] * 4
    assert out.splitlines()[-2].startswith('right   azimuth: ')


@pytest.mark.parametrize(
    ('words', 'expected'),
    [
        (io.StringIO('\n' * 4), '--touches: expected a terminal on standard input'),
        (Terminal('\n'), '--touches: expected Enter, got the end of the input'),
    ],
)
def test_touches_need_somebody_at_a_terminal(command, touched, words, expected):
    touched(words)
    status, _, err = command('doctor', '--touches')
    assert status == 2
    assert err.splitlines()[-1].endswith(f'tactile_push doctor: {expected}')


def test_bad_namespace_is_refused_in_one_line(command):
    status, out, err = command('doctor', '--namespace', 'my finger')
    assert (status, out) == (2, '')
    assert err.count('\n') == 1
    assert '--namespace: expected a namespace such as left, got my finger' in err
