# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""`tactile_push diff`: what it prints, what it takes and how it ends."""

import json
import math
import re
from functools import partial

import pytest

from support.bad_definitions import BAD_DEFINITIONS
from support.bag_making import write_bag, write_file
from support.bags_to_compare import JOINT_STATE, STATE, clocks, states


@pytest.fixture
def diff(command):
    """Return a function that runs the command: exit status, standard output, standard error."""
    return partial(command, 'diff')


@pytest.fixture
def bags(tmp_path):
    """Return two bags that differ in one number."""
    a = write_bag(tmp_path / 'a', {STATE: states(), '/clock': clocks(1, 2)})
    b = write_bag(
        tmp_path / 'b', {STATE: states(change={3: {'phi': 1.25}}), '/clock': clocks(1, 2)}
    )
    return a, b


def test_command_says_what_is_different(bags, diff):
    status, out, err = diff(*bags)
    assert (status, err) == (1, '')
    rows = [re.split(r'\s*[│┃]\s*', line.strip('│┃ \n')) for line in out.splitlines()]
    assert ['/clock', '2', '2', '2', '0', '0', '0', 'same'] in rows
    assert [STATE, '5', '5', '5', '0', '0', '1', 'different'] in rows
    at = '0.300000000 s'
    assert ['position.phi', '1', at, '1.5', '1.25', '0.25', at] in rows
    assert out.splitlines()[-1] == '1 of 2 topics are different'


def test_command_says_nothing_of_what_is_the_same(bags, diff):
    status, out, err = diff(bags[0], bags[0])
    assert (status, err) == (0, '')
    assert 'position' not in out
    assert out.splitlines()[-1] == '0 of 2 topics are different'


def test_command_names_missing_messages_and_fields(tmp_path, diff):
    a = write_bag(tmp_path / 'a', {STATE: states(5), '/clock': clocks(1, 2, 3)})
    b = write_bag(tmp_path / 'b', {STATE: states(4, kp=1.0), '/clock': clocks(1, 2)})
    status, out, _ = diff(a, b)
    assert status == 1
    assert f'{STATE}: first message only in A: 0.400000000 s\n' in out
    assert f'{STATE}: fields only in B: position.kp\n' in out
    assert '/clock: first message only in A: message 2\n' in out


def refuse(name):
    raise AssertionError(f'{name} in JSON')


def test_command_gives_json(tmp_path, diff):
    a = write_bag(tmp_path / 'a', {STATE: states(), '/clock': clocks(1, 2)})
    b = write_bag(tmp_path / 'b', {STATE: states(change={3: {'phi': math.nan}})})
    status, out, err = diff(a, b, '--json')
    assert (status, err) == (1, '')
    result = json.loads(out, parse_constant=refuse)
    assert (result['a'], result['b'], result['same']) == (str(a), str(b), False)
    assert result['topics']['/clock']['remarks'] == ['only A has the topic']
    state = result['topics'][STATE]
    found = {
        'at': {'stamp_ns': 300_000_000},
        'field': 'position.phi',
        'a': 1.5,
        'b': 'nan',
        'difference': None,
    }
    assert state['first'] == found
    assert state['fields'] == {'position.phi': {'messages': 1, 'first': found, 'largest': found}}
    assert (state['messages'], state['compared'], state['different']) == ([5, 5], 5, 1)
    assert (state['paired_by'], state['same']) == ('stamp', False)


@pytest.mark.parametrize(
    ('options', 'status'),
    [
        (['--tolerance', '0.3'], 0),
        (['--tolerance', '0.2'], 1),
        (['--tolerance', f'{STATE}:phi=0.3'], 0),
        (['--tolerance', f'{STATE[1:]}:phi=0.3'], 0),
        (['--tolerance', f'{STATE}:theta=0.3'], 1),
        (['--tolerance', '1', '--tolerance', f'{STATE}:phi=0.1'], 1),
        (['--topics', '/clock'], 0),
        (['--topics', 'clock', STATE], 1),
        (['--ignore', STATE], 0),
        (['--ignore', STATE, '--times'], 0),
    ],
)
def test_command_takes_options(bags, diff, options, status):
    assert diff(*bags, *options)[0] == status


@pytest.mark.parametrize(
    'text', ['x', '-1', 'nan', f'{STATE}:phi', f'{STATE}=1', f'{STATE}:=1', ':phi=1', '/a:b=c', '']
)
def test_command_refuses_other_tolerances(bags, diff, text):
    status, out, err = diff(*bags, f'--tolerance={text}')
    assert (status, out) == (2, '')
    assert len(err.splitlines()) == 1
    assert 'expected a number of 0 or more, or TOPIC:FIELD=NUMBER' in err


def test_bags_may_stand_behind_lists(bags, diff):
    a, b = bags
    orders = [
        ['--topics', STATE, a, b],
        [a, '--topics', STATE, b],
        ['--ignore', '/clock', a, b],
        ['--topics', STATE, a, '--ignore', '/clock', b],
        ['--topics', STATE, '--times', '--ignore', '/clock', a, b, '--json'],
    ]
    for words in orders:
        status, out, err = diff(*words)
        assert (status, err) == (1, '')
        assert str(a) in out and out.index(str(a)) < out.index(str(b))
        assert '/clock' not in out.replace(str(a), '').replace(str(b), '')
    status, out, err = diff('--topics', '/clock', a)
    assert (status, out) == (2, '')
    assert 'required: BAG_A, BAG_B, before --topics' in err


def test_command_refuses_bad_bags_in_one_line(bags, diff, tmp_path):
    (tmp_path / 'text.mcap').write_text('no bag')
    for wrong in ('nowhere', 'text.mcap'):
        for arguments in ((bags[0], tmp_path / wrong), (tmp_path / wrong, bags[0])):
            status, out, err = diff(*arguments)
            assert (status, out) == (2, '')
            assert len(err.splitlines()) == 1
            assert err.startswith('tactile_push diff: ')
            assert wrong in err
    status, out, err = diff(*bags, '--topics', '/nowhere')
    assert (status, out) == (2, '')
    assert err.startswith('tactile_push diff: no topic /nowhere in ')


def test_command_refuses_a_message_that_does_not_decode(tmp_path, diff):
    kind, messages = states()
    cut = [(time, data[:30] if k == 2 else data) for k, (time, data) in enumerate(messages)]
    a, b = (write_bag(tmp_path / n, {STATE: (kind, m)}) for n, m in (('a', messages), ('b', cut)))
    status, out, err = diff(a, b)
    assert (status, out) == (2, '')
    assert len(err.splitlines()) == 1
    assert STATE in err


@pytest.mark.parametrize('definition', [text for text, _ in BAD_DEFINITIONS.values()])
def test_command_compares_other_definitions_or_says_in_one_line_what_is_wrong(
    tmp_path, diff, definition
):
    a = write_file(tmp_path / 'a.mcap', {STATE: states()})
    definitions = {JOINT_STATE: definition or ' '}
    b = write_file(tmp_path / 'b.mcap', {STATE: states()}, definitions=definitions)
    for bags in ((a, b), (b, a)):
        status, out, err = diff(*bags)
        if status == 1:
            assert f'{STATE}: A and B define {JOINT_STATE} differently' in out
            assert err == ''
        else:
            assert (status, out) == (2, '')
            (line,) = err.splitlines()
            assert STATE in line and JOINT_STATE in line
    assert diff(b, b)[0] == 0


def test_command_reads_on_with_a_warning_where_a_bag_is_cut_off(bags, diff, tmp_path):
    (file,) = bags[0].glob('*.mcap')
    cut = tmp_path / 'cut.mcap'
    cut.write_bytes(file.read_bytes()[:-30])
    status, _, err = diff(cut, bags[0])
    assert status == 0
    assert 'Traceback' not in err
    for line in err.splitlines():
        assert line.startswith('tactile_push diff: warning: ')
    assert err


def test_names_in_a_bag_do_not_move_the_terminal(tmp_path, command):
    one, other = (
        write_bag(tmp_path / name, {'/a\x1b[2J\nb': clocks(1, time)})
        for name, time in (('one', 2), ('other', 3))
    )
    status, out, _ = command('diff', one, other)
    assert status == 1
    assert r'/a\x1b[2J\nb' in out
    assert all(letter.isprintable() for letter in out.replace('\n', ''))
