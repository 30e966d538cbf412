# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""`tactile_push simulate --law`: what each law takes, and what is said of its run."""

import json
import math

import numpy as np
import pytest

from tactile_push.simulation import Rollout
from tactile_push.simulation.placed_run import PlacedRun
from tactile_push.simulation.placement import Placement

PLACE = '--law', 'place', '--x-goal-mm'
SETTLE, STEER = ('--law', 'settle', '--theta-goal-deg'), ('--law', 'steer', '--x-goal-mm')


@pytest.fixture
def simulated(command):
    """Return a function that gives the JSON of a run."""

    def run(*arguments):
        status, out, err = command('simulate', *arguments, '--json', '-')
        assert status == 0, err
        return json.loads(out)

    return run


@pytest.mark.slow
def test_settle_brings_theta_to_its_goal_from_figure_8s_start_by_step_50(simulated):
    run = simulated(*SETTLE, -10, '--steps', 120)
    assert run['end'] == 'done'
    assert math.degrees(run['theta'][0]) == pytest.approx(20.0)
    assert run['settle_step'] <= 50
    assert all(abs(math.degrees(theta) + 10.0) <= 3.0 for theta in run['theta'][50:])


@pytest.fixture
def placed(monkeypatch):
    """Let every object be placed in two control periods; return what was asked for."""
    asked = []

    def run(config, goal, steps, *, axes):
        asked.append((config.theta, config.d, goal, steps))
        columns = [[0.3, 0.2, 0.1], [1.5, 1.6, 1.6], [0.003, 0.002, 0.001]]
        columns += [[-0.02, -0.01, 0.0022], [0.037, 0.0375, 0.038]]
        history = Rollout(*np.array(columns), np.array([0, 0, 0]), 'done')
        finger = np.array([[0.0, 0.0], [0.01, 0.0005], [0.02, 0.001]])
        placed = Placement('released', '', 2e-4, 0.001, 0.09, 0.02)
        return PlacedRun(history, finger, goal, placed, axes - 1)

    monkeypatch.setattr('tactile_push.simulation.placed_run.placed_run', run)
    return asked


def test_place_is_told_its_goal_and_tells_how_the_object_lies(placed, simulated, tmp_path):
    picture = tmp_path / 'placed.png'
    run = simulated(*PLACE, 2, '--theta-goal-deg', -6, '--d0-mm', 3, '--plot', picture)
    goal = (0.002, math.radians(-6.0))
    assert placed == [(math.radians(20.0), 0.003, goal, 600)]
    assert run['goal'] == {'x': goal[0], 'theta': goal[1]}
    assert (run['stage'], run['end'], run['settle_step']) == ('released', 'done', 2)
    assert (run['x_error'], run['theta_error'], run['belt'], run['learned']) == (
        *(2e-4, 0.001, 0.09, 0.02),
    )
    assert run['finger'][1] == [0.01, 0.0005]
    assert picture.read_bytes().startswith(b'\x89PNG')


def test_what_is_placed_is_told_in_lines(placed, command):
    status, out, _ = command('simulate', *PLACE, 2, '--theta-goal-deg', -6)
    assert status == 0
    rows = dict(line.split(maxsplit=1) for line in out.splitlines())
    assert rows['settled'] == 'step 2, where it is let go'
    assert rows['x'] == '-20.00 mm -> 2.20 mm'
    assert rows['error'] == '0.20 mm, 0.06°'
    assert rows['belt'] == '90.0 mm, 20.0 mm of it to learn where the finger touches'


def test_a_finger_of_two_axes_tells_how_often_it_touched_anew(placed, command):
    asked = ('simulate', *PLACE, 2, '--theta-goal-deg', -6)
    for axes, rows in ((1, []), (2, ['1'])):
        status, out, _ = command(*asked, '--axes', axes)
        assert status == 0
        assert [line.split()[1] for line in out.splitlines() if line.startswith('regrasps')] == rows


def test_an_object_that_is_not_placed_is_a_failure(command):
    # Belt for three control periods.
    status, out, err = command('simulate', *PLACE, 0, '--theta-goal-deg', 0, '--steps', 3)
    assert status == 1
    assert err.endswith('tactile_push simulate: missed\n')
    assert 'settled    never, where it is let go\n' in out


@pytest.mark.slow
def test_steer_says_from_when_on_the_centre_of_mass_is_near_its_goal(simulated, command):
    run = simulated(*STEER, 0, '--steps', 600)
    first = run['settle_step']
    assert 50 < first < 600
    assert abs(run['x'][first - 1]) > 0.002
    assert all(abs(x) <= 0.002 for x in run['x'][first:])
    status, out, _ = command('simulate', *STEER, 0, '--steps', 2)
    assert status == 0
    assert 'settled    never, within 2 mm of x = 0 mm\n' in out
    # Figure 8's start: the finger at the origin, 37.25 mm from the centre along n and -6 along t.
    assert (
        f'x          {-37.25 * math.sin(math.radians(20)) + 6 * math.cos(math.radians(20)):.2f} '
        in out
    )


@pytest.mark.parametrize(
    ('arguments', 'refusal'),
    [
        (('--law', 'steer'), '--law: expected --x-goal-mm with steer, got none'),
        (('--law', 'settle'), '--law: expected --theta-goal-deg with settle, got none'),
        ((*STEER, 0, '--theta-desired-deg', -10), '--theta-desired-deg: expected --law push, got '),
        ((*STEER, 0, '--phi0-deg', 90), '--phi0-deg: expected --law push, got steer'),
        ((*STEER, 0, '--open-loop'), '--open-loop: expected --law push, got steer'),
        (('--axes', 2), '--axes: expected --law place, got push'),
        ((*SETTLE, 0, '--kd', 5), '--kd: expected --law push, got settle'),
        (('--x-goal-mm', 0), '--x-goal-mm: expected --law'),
        (('--theta-goal-deg', 0), '--theta-goal-deg: expected --law'),
        ((*SETTLE, 0, '--object', 'disk'), 'object: expected one with straight edges to settle'),
        ((*STEER, 0, '--object', 'disk'), 'object: expected one with straight edges to steer'),
        ((*PLACE, 0), '--law: expected --theta-goal-deg with place, got none'),
        (
            (*PLACE, 0, '--theta-goal-deg', 0, '--object', 'disk'),
            'object: expected one with straight edges to place',
        ),
        (('--law', 'shove'), "argument --law: invalid choice: 'shove'"),
        ((*STEER, 'nan'), 'argument --x-goal-mm: expected millimetres, got nan'),
        ((*SETTLE, 90), 'argument --theta-goal-deg: expected degrees between -90 and 90, got 90'),
    ],
)
def test_what_makes_no_sense_is_refused_in_one_line(command, arguments, refusal):
    status, out, err = command('simulate', *arguments)
    assert (status, out) == (2, '')
    assert refusal in err.splitlines()[-1]


def test_a_finger_that_stops_is_a_failure_with_its_reason(command):
    # No angle holds the block so far to the right, and on the way there it reaches the end.
    status, _, err = command('simulate', *STEER, -44, '--theta0-deg', 40, '--steps', 300)
    assert status == 1
    assert err.endswith('tactile_push simulate: workspace limit\n')
