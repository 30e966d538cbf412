# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""`tactile_push info`: what it prints of bags of which it is known, and how it ends."""

import json
import math
import re
from functools import partial

import pytest

from support.bag_making import joint_state, write_bag, write_file
from support.bags_to_know import BAND, CLOCK, JOINT_STATE, NOTES, STATE, clocks, pushes
from support.placed_bag import placed_bag


@pytest.fixture
def info_of(command):
    """Return a function that runs the command: exit status, standard output, standard error."""
    return partial(command, 'info')


def refuse(name):
    raise AssertionError(f'{name} in JSON')


def rows_of(out):
    """Return the rows of the tables, and the words of the other lines."""
    return [re.split(r'\s*[│┃]\s*|\s{2,}', line.strip('│┃ \n')) for line in out.splitlines()]


def test_command_says_what_is_in_a_bag(tmp_path, info_of):
    topics = {STATE: pushes(math.radians(-10.0)), '/clock': clocks(1, 2)}
    path = write_file(tmp_path / 'block.mcap', topics, NOTES)
    status, out, err = info_of(path)
    assert (status, err) == (0, '')
    rows = rows_of(out)
    assert ['start', '0.000000000 s (simulated time)'] in rows
    assert ['duration', '44.900 s'] in rows
    assert ['messages', '452'] in rows
    assert ['tactile_push', '1.2.3'] in rows
    headings = ['topic', 'type', 'messages', 'rate [Hz]', 'largest gap [s]', 'at [s]']
    assert [*headings, 'out of order'] in rows
    assert [STATE, JOINT_STATE, '450', '10.00', '0.100', '0.000', '0'] in rows
    assert ['/clock', CLOCK, '2', '', '0.000', '0.000'] in rows
    assert ['this bag', 'paper, fig. 9'] in rows
    assert ['θ within 3° of θ_d from step', '192', '173'] in rows
    assert ['θ from step 400 [°]', '-10.0 to -10.0', '-10.4 to -8.9'] in rows
    assert ['φ from step 400 [°]', '82.5 to 82.5', '80.2 to 85.8'] in rows
    assert ['so d by (17) [mm]', '1.04 to 1.04', '0.30 to 2.10'] in rows
    assert ['l [mm]', '23.75'] in [row[:2] for row in rows]
    assert ['stops', 'none'] in [row[:2] for row in rows]
    assert ['kp', '0.05'] in rows
    assert 'not in this bag: saturated, limited, ticks, ticks_lost\n' in out
    assert 'parameters of /push_controller\n' in out


def test_command_names_the_goals(tmp_path, info_of):
    status, out, _ = info_of(placed_bag(tmp_path / 'bag'))
    assert status == 0
    rows = rows_of(out)
    assert '/place/goal' in out
    assert ['goal', 'let go at', 'error', 'belt', 'in reach', 'end'] in rows
    error = '0.20 mm, -0.06°'
    placed = ['-50.00 mm, 5.73°', '-49.80 mm, 5.67°', error, '47 mm', 'with reserve', 'released']
    assert placed in rows
    assert 'out of reach: friction' in out
    goals = json.loads(info_of(tmp_path / 'bag', '--json')[1], parse_constant=refuse)['goals']['']
    assert (goals[0]['x'], goals[0]['theta'], goals[0]['stage']) == (-0.05, 0.1, 'released')
    assert goals[1]['reached'] is None


def test_command_counts_real_time_from_the_epoch(tmp_path, info_of):
    path = write_bag(tmp_path / 'bag', {'/clock': clocks(1_732_540_000_123_000_000)})
    assert ['start', '2024-11-25 13:06:40.123+00:00'] in rows_of(info_of(path)[1])


@pytest.mark.parametrize('clock', [[], [10**9]])
def test_command_does_not_know_a_clock_that_was_not_set_from_simulated_time(
    tmp_path, info_of, clock
):
    joints = [(10**9 + k, joint_state(10**9 + k)) for k in range(3)]
    topics = {'/clock': clocks(*clock), '/joint_states': (JOINT_STATE, joints)}
    _, out, _ = info_of(write_file(tmp_path / 'x.mcap', topics))
    (row,) = [line for line in out.splitlines() if line.startswith('start ')]
    why = 'simulated time' if clock else 'simulated time, or a clock that was not set'
    assert row.split(maxsplit=1)[1].strip() == f'1.000000000 s ({why})'


def test_command_takes_the_band(tmp_path, info_of):
    path = write_bag(tmp_path / 'bag', {STATE: pushes(0.0)})
    rows = rows_of(info_of(path, '--band-deg', '1')[1])
    assert ['θ within 1° of θ_d from step', '192', '110'] in rows
    rows = rows_of(info_of(path, '--band-deg', '5')[1])
    assert ['θ within 5° of θ_d from step', '0', '110 (1°)'] in rows


@pytest.mark.parametrize('band', ['0', '-1', '180', 'x', 'nan'])
def test_command_refuses_other_bands(tmp_path, info_of, band):
    status, out, err = info_of(tmp_path, f'--band-deg={band}')
    assert (status, out) == (2, '')
    assert 'expected degrees between 0 and 180' in err


def test_command_gives_json(tmp_path, info_of):
    topics = {STATE: pushes(math.radians(-10.0)), '/clock': clocks(1, 2)}
    path = write_file(tmp_path / 'block.mcap', topics, NOTES)
    status, out, err = info_of(path, '--json')
    assert (status, err) == (0, '')
    info = json.loads(out, parse_constant=refuse)
    assert info['path'] == info['files'][0]['path'] == str(path)
    assert (info['start_time_ns'], info['duration'], info['messages']) == (0, 44.9, 452)
    assert info['topics'][1]['rate'] == pytest.approx(10.0)
    assert info['version'] == '1.2.3'
    assert info['parameters']['push_controller']['max'] == 'inf'
    push = info['pushes']['']
    assert push['settle_step'] == 192
    assert push['phi_range'] == [math.radians(82.5)] * 2
    assert push['band'] == pytest.approx(BAND)
    assert push['paper']['settle_step'] == 173


def test_command_refuses_bad_bags_in_one_line(tmp_path, info_of):
    (tmp_path / 'text.mcap').write_text('no bag')
    (tmp_path / 'empty').mkdir()
    for wrong in ('nowhere', 'text.mcap', 'empty'):
        status, out, err = info_of(tmp_path / wrong)
        assert (status, out) == (2, '')
        assert len(err.splitlines()) == 1
        assert err.startswith(f'tactile_push info: {tmp_path / wrong}')


def test_names_and_notes_of_a_bag_do_not_move_the_terminal(tmp_path, info_of):
    topics = {'/a\x1b[2J\nb': clocks(1, 2)}
    notes = {'tactile_push.version': '1\x1b]0;title\x07'}
    status, out, _ = info_of(write_file(tmp_path / 'bag.mcap', topics, notes))
    assert status == 0
    assert r'/a\x1b[2J\nb' in out
    assert r'1\x1b]0;title\x07' in out
    assert all(letter.isprintable() for letter in out.replace('\n', ''))
