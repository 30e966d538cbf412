# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""`tactile_push reach`: what it says of goals, what it draws, and what it refuses."""

import json
import math

import pytest

from tactile_push.cli import reach
from tactile_push.control.placing import reachable_set

GOAL = '--x-goal-mm', '--theta-goal-deg'


@pytest.fixture
def few_goals(monkeypatch):
    """Try a goal every 100 mm and 50 degrees."""
    monkeypatch.setattr(reach, 'X_STEP', 0.1)
    monkeypatch.setattr(reach, 'THETA_STEP', math.radians(50.0))


def goal(x, theta):
    return GOAL[0], x, GOAL[1], theta


def test_a_goal_beside_the_start_is_reached_with_reserve(command):
    status, out, _ = command('reach', *goal(10, 0))
    assert status == 0
    line = next(line for line in out.splitlines() if line.startswith('goal'))
    assert line.startswith('goal       x 10.0 mm, theta 0.0°: with reserve, ')
    assert 'reached' not in out  # nobody asked for the others


def test_a_goal_that_only_a_look_with_reserve_finds_is_reached_with_reserve(command):
    # The search for the same plan without reserve picks others, which do not arrive.
    _, out, _ = command('reach', *goal(50, -15), '--json', '-')
    assert json.loads(out)['goal']['verdict'] == 'with reserve'


def test_a_goal_farther_than_the_belt_allows_has_a_nearest_one_that_can_be_reached(command):
    # The finger goes aside by 1.54 mm for a millimetre of belt at the most.
    arguments = '--belt-mm', 20
    status, out, _ = command('reach', *arguments, *goal(30, 20), '--json', '-')
    assert status == 1
    told = json.loads(out)['goal']
    assert (told['verdict'], told['reason']) == ('out of reach', 'belt')
    assert told['belt'] == 'nan'
    nearest = told['nearest']
    assert nearest['x'] < -0.007 + 0.031 + 0.001
    x, theta = 1e3 * nearest['x'], math.degrees(nearest['theta'])
    status, out, _ = command('reach', *arguments, *goal(x, theta), '--json', '-')
    assert status == 0
    assert json.loads(out)['goal']['verdict'] != 'out of reach'


def test_a_finger_that_starts_near_the_end_of_its_workspace_does_not_get_as_far_to_the_left(
    command,
):
    verdicts = {}
    for x0 in (-100, 0):
        _, out, _ = command('reach', '--x0-mm', x0, *goal(-40, 0), '--json', '-')
        told = json.loads(out)
        assert told['start']['finger_x'] == pytest.approx(1e-3 * x0)
        verdicts[x0] = told['goal']['verdict'], told['goal']['reason']
    assert verdicts[-100] == ('out of reach', 'workspace')
    assert verdicts[0][0] != 'out of reach'


def test_a_c_takes_the_place_of_a_support(command):
    _, out, _ = command('reach', '--c-mm', 20, *goal(0, 0), '--json', '-')
    told = json.loads(out)
    assert told['object'] == pytest.approx(
        {'l': 0.02375, 'c': 0.02, 'growth': 0.0, 'mu_c': told['object']['mu_c']}
    )
    assert told['object']['mu_c'] == 'inf'
    # Figure 8's start: 37.25 mm along n and -6 along t from the centre to the finger.
    x = 0.006 * math.cos(math.radians(20)) - 0.03725 * math.sin(math.radians(20))
    assert told['start']['x'] == pytest.approx(x)


@pytest.mark.slow
def test_the_set_is_drawn_and_told(command, few_goals, tmp_path):
    picture = tmp_path / 'reach.png'
    status, out, err = command('reach', '-o', picture)
    assert (status, err) == (0, '')
    assert picture.read_bytes().startswith(b'\x89PNG')
    # From 75 mm left of the start to 195 mm right of it, at -50, 0 and 50 degrees.
    assert 'of 6 goals with reserve' in out
    status, out, _ = command('reach', '--json', '-')
    grid = json.loads(out)['set']
    assert grid['x'] == pytest.approx([0.0, 0.1])
    assert grid['theta'] == pytest.approx([math.radians(50.0 * k) for k in (-1, 0, 1)])
    assert grid['verdict'][1][0] == 'with reserve'
    assert [len(row) for row in grid['reason']] == [2, 2, 2]


def test_ctrl_c_ends_it_in_silence(command, monkeypatch):
    def interrupted(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr(reachable_set, 'reachable_set', interrupted)
    assert command('reach') == (130, '', '')


@pytest.mark.parametrize(
    ('arguments', 'refusal'),
    [
        ((GOAL[0], 3), '--theta-goal-deg: expected one with --x-goal-mm, got none'),
        ((GOAL[1], 3), '--x-goal-mm: expected one with --theta-goal-deg, got none'),
        (('--c-mm', 20, '--support', 'rim'), '--c-mm: expected no --support with it, got one'),
        (('--c-mm', 0), 'argument --c-mm: expected a positive number of millimetres, got 0'),
        (('--x0-mm', 106), '--x0-mm: expected -105 to 105, the workspace, got 106'),
        (('--belt-mm', 0), 'argument --belt-mm: expected millimetres from 1 to 5000, got 0'),
        (('--belt-mm', 'nan'), 'argument --belt-mm: expected millimetres from 1 to 5000, got nan'),
        (goal('nan', 0), 'argument --x-goal-mm: expected millimetres, got nan'),
        (goal(0, 90), 'argument --theta-goal-deg: expected degrees between -90 and 90, got 90'),
        (('--object', 'disk'), 'object: expected one with straight edges to place, got a round'),
        (('--object', 'none.json'), '--object: none.json: No such file or directory'),
        (('-o', 'reach.txt'), 'expected a file *.png, *.svg, *.pdf, got reach.txt'),
        (('--d0-mm', 30), 'd: expected'),
    ],
)
def test_bad_input_is_refused_in_one_line(command, arguments, refusal):
    status, out, err = command('reach', *arguments)
    assert (status, out) == (2, '')
    assert len(err.splitlines()) == 1
    assert refusal in err
