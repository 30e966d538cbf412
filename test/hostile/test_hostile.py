# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""A short walk; `python -m hostile` walks everywhere."""

import pytest

from hostile.surroundings import ODD, together
from hostile.things import SLIPS, commands, things, uses
from hostile.walk import HANGS, Ended, run

SHORT = [
    ('info', ('no folder', 'TMPDIR that is nowhere', 'no HOME', 'all closed')),
    ('simulate and plot', ('MPLBACKEND of a notebook', 'HOME that is a file', 'one column')),
    ('info', ('ASCII', 'dumb terminal', 'unbuffered')),
    ('simulate', ('threads of no number', 'warnings are errors', 'Latin-9', 'closed error')),
    ('replay', ('few files', 'locale of nobody', 'output that nobody reads')),
    ('diff', ('both full', 'columns of no number', 'time zone of nobody', 'optimised')),
    ('push_controller refused', ('domain of no number', 'no folder', 'closed output')),
    ('sim_plant --help', ('output that nobody reads', 'locale C', 'HOME that is a file')),
    ('bag_recorder refused', ('log that is not writable', 'warnings are errors', 'no PATH')),
    ('bag_player refused', ('log of no number',)),
]


@pytest.mark.parametrize(('command', 'names'), SHORT, ids=lambda value: str(value)[:40])
def test_odd_surroundings_end_no_process_with_a_traceback(command, names, tmp_path):
    ended = run(commands(tmp_path)[command], together(*names), tmp_path)
    assert ended.complaints == []


@pytest.mark.parametrize(
    ('command', 'kind'),
    [('replay', 'a name of no letters'), ('estimate', 'nested'), ('simulate', 'unreadable')],
)
def test_what_is_no_such_file_is_refused(command, kind, tmp_path):
    thing = things(tmp_path)[kind]
    words = next(use for use in uses(thing, tmp_path) if command in use)
    ended = run(words, together(), tmp_path)
    assert ended.complaints == []
    assert ended.status in (1, 2)


@pytest.mark.parametrize(
    ('ended', 'complaint'),
    [
        (Ended(0, 'fine', 'a\nb\nc\n'), None),
        (Ended(130, '', ''), None),
        (Ended(3, '', ''), 'exit status 3'),
        (Ended(HANGS, '', ''), 'exit status -1'),
        (Ended(139, '', ''), 'exit status 139'),
        (Ended(2, '', 'a\nb\nc\nd\n'), '4 lines on standard error'),
        (Ended(2, '', 'Traceback (most recent call last):\n'), 'Traceback on standard error'),
        (Ended(0, 'Traceback', ''), 'Traceback on standard output'),
    ],
)
def test_process_that_ends_otherwise_than_it_should_is_found(ended, complaint):
    assert ended.complaints == ([] if complaint is None else [complaint])


def test_walk_is_long_enough():
    assert len(ODD) + len(SLIPS) > 60
    assert len({odd.name for odd in ODD}) == len(ODD)
