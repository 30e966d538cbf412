# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What words of a command line are read as, and which are refused."""

import argparse
import math
import subprocess
import sys
from pathlib import Path

import pytest

from support.commands import run_command
from tactile_push.cli import arguments


def refused(read, text):
    """Return the words with which a reader refuses a text."""
    with pytest.raises(argparse.ArgumentTypeError) as reason:
        read(text)
    return str(reason.value)


@pytest.mark.parametrize('closed', [True, False])
def test_bounds_belong_to_a_range_that_is_closed(closed):
    read = arguments.number('seconds from 1 to 2', 1.0, 2.0, closed=closed)
    assert read('1.5') == 1.5
    for bound in ('1', '2'):
        if closed:
            assert read(bound) == float(bound)
        else:
            assert refused(read, bound) == f'expected seconds from 1 to 2, got {bound}'
    for text in ('0.999', '2.001', '-1.5', 'inf', 'nan', '', '1,5', 'one'):
        assert refused(read, text) == f'expected seconds from 1 to 2, got {text}'


@pytest.mark.parametrize(('text', 'count'), [('0', 0), ('600', 600), ('10000000', 10_000_000)])
def test_steps_are_a_whole_number(text, count):
    assert arguments.steps(text) == count


@pytest.mark.parametrize('text', ['-1', '1.0', '1e3', '10000001', '9' * 5000, '٣', '', 'x'])
def test_other_steps_are_refused(text):
    assert refused(arguments.steps, text) == f'expected a whole number, 0 to 10000000, got {text}'


@pytest.mark.parametrize(('text', 'number'), [('-1', -1), ('0', 0), ('7', 7)])
def test_edge_is_a_whole_number_from_minus_1_on(text, number):
    assert arguments.edge(text) == number


@pytest.mark.parametrize('text', ['-2', '0.5', 'left', ''])
def test_other_edges_are_refused(text):
    assert refused(arguments.edge, text) == f'expected a whole number from -1 on, got {text}'


@pytest.mark.parametrize('name', ['a.png', 'b/c.SVG', 'd.e.pdf'])
def test_picture_is_of_a_format_that_can_be_drawn(name):
    assert arguments.picture(name) == Path(name)


@pytest.mark.parametrize('name', ['png', 'a.jpg', 'a.png/b', ''])
def test_other_pictures_are_refused(name):
    assert refused(arguments.picture, name) == f'expected a file *.png, *.svg, *.pdf, got {name}'


@pytest.mark.parametrize('name', ['a.html', 'b/c.HTM'])
def test_page_is_html(name):
    assert arguments.page(name) == Path(name)


@pytest.mark.parametrize('name', ['html', 'bag.mcap', 'bag', ''])
def test_other_pages_are_refused(name):
    assert refused(arguments.page, name) == f'expected a file *.html, got {name}'


def test_slash_in_front_of_a_topic_may_be_left_out():
    assert arguments.topic('left/contact') == arguments.topic('/left/contact') == '/left/contact'


@pytest.mark.parametrize(
    ('text', 'found'),
    [
        ('0', (None, 0.0)),
        ('1e-9', (None, 1e-9)),
        ('inf', (None, math.inf)),
        ('/contact:pose.x=0.5', (('/contact', 'pose.x'), 0.5)),
        ('contact:pose.x=0.5', (('/contact', 'pose.x'), 0.5)),
    ],
)
def test_tolerance_is_for_all_or_for_one_field(text, found):
    assert arguments.tolerance(text) == found


@pytest.mark.parametrize('text', ['', '-1', 'nan', 'x', '=1', 'contact=1', 'contact:=1', ':x=1'])
def test_other_tolerances_are_refused(text):
    words = f'expected a number of 0 or more, or TOPIC:FIELD=NUMBER, got {text}'
    assert refused(arguments.tolerance, text) == words


def test_parser_says_in_one_line_what_is_wrong_and_ends_with_2(capsys):
    parser = arguments.Parser(prog='program')
    parser.add_argument('--steps', type=arguments.steps)
    with pytest.raises(SystemExit) as end:
        parser.parse_args(['--steps', 'x'])
    assert end.value.code == 2
    assert capsys.readouterr() == (
        '',
        'program: error: argument --steps: expected a whole number, 0 to 10000000, got x; '
        'see program --help\n',
    )


@pytest.mark.parametrize(('given', 'status'), [([], 2), ([1], 1)])
def test_refusal_has_a_reason_for_people_and_an_exit_status(given, status):
    refusal = arguments.Refused(ValueError('no bag'), *given)
    assert (str(refusal), refusal.status) == ('no bag', status)


def test_unknown_option_points_to_the_help_of_its_command():
    done = run_command('record', '--outt')
    assert done.returncode == 2
    assert done.stderr == (
        'tactile_push record: error: unrecognized arguments: --outt; '
        'see tactile_push record --help\n'
    )


def test_the_words_are_understood_before_anything_heavy_is_imported():
    program = (
        'import sys; from tactile_push.cli import command_parser; command_parser(); '
        "print({'numpy', 'numba', 'mcap', 'yaml', 'rclpy'} & sys.modules.keys())"
    )
    done = subprocess.run([sys.executable, '-c', program], capture_output=True, text=True)
    assert done.stdout == 'set()\n', done.stderr
