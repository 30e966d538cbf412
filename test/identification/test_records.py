# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import json
import math
from dataclasses import replace

import numpy as np
import pytest

from support.measured_pushes import VERTICES, content, pushes_in
from tactile_push.identification.records import (
    CUT,
    STRAIGHT,
    Bad,
    Push,
    Pushes,
    cut,
    merged,
)
from tactile_push.mechanics import Outline, Pose, Support
from tactile_push.simulation import ObjectFile

PUSH = {
    'tip_start': [0.03, -0.01],
    'tip_end': [0.03, 0.0],
    'object_start': [0.0, 0.0, 0.0],
    'object_end': [0.0, 0.005, 0.0],
}


@pytest.fixture
def write(tmp_path):
    """Return a function that writes a file and gives its path."""

    def written(made, name='block'):
        file = tmp_path / f'{name}.json'
        file.write_text(made if isinstance(made, str) else json.dumps(made))
        return file

    return written


@pytest.fixture
def refused(write):
    """Return a function that reads a file that must be refused in one line, and gives it."""

    def read(made):
        with pytest.raises(ValueError, match=r'block\.json: ') as error:
            pushes_in(write(made))
        assert '\n' not in str(error.value)
        return str(error.value)

    return read


def test_a_push_has_its_places_and_its_force(write):
    read = pushes_in(write(content([PUSH, PUSH | {'force': [1, -2.0]}])))

    first, second = read.pushes
    way = (0.03, -0.01), (0.03, 0.0)
    assert first[1:] == (Pose(0.0, 0.0, 0.0), Pose(0.0, 0.005, 0.0), way, 0.005, None, 0.0)
    assert second.force == (1.0, -2.0)
    assert second.name.endswith('block.json: pushes[1]')
    assert (read.support, read.bad) == (None, ())


def test_a_push_with_paths_is_cut(write):
    # The tip goes 2 mm from place to place: it has come 5 mm or more after three of them.
    tip = [[0.0, 0.002 * k] for k in range(8)]
    poses = [[0.1, 0.001 * k, 0.01 * k] for k in range(8)]

    read = pushes_in(write(content([{'tip_path': tip, 'object_path': poses}])))

    assert CUT == 0.005
    ways = [push.way for push in read.pushes]
    assert ways == [tuple(map(tuple, tip[:4])), tuple(map(tuple, tip[3:7]))]
    ends = [(push.begin, push.end) for push in read.pushes]
    assert ends == [(Pose(*poses[0]), Pose(*poses[3])), (Pose(*poses[3]), Pose(*poses[6]))]
    assert [push.name.rpartition(' ')[0][-4:] for push in read.pushes] == ['0 to', '3 to']


def test_small_steps_of_the_tip_are_put_together():
    tip = [(0.0, 0.0002 * k) for k in range(31)]
    psi = [3.0 + 0.01 * k for k in range(31)]

    (push,) = cut('', tip, [Pose(0.0, 0.0, 0.0)] * 31, 0.005, psi)

    y = [place[1] for place in push.way]
    assert y[0] == 0.0
    assert (np.diff(y) >= STRAIGHT).all()
    assert CUT <= y[-1] < CUT + STRAIGHT + 0.0002
    assert push.turn == pytest.approx(0.01 * y[-1] / 0.0002)


def test_a_tip_that_stands_makes_no_push():
    assert list(cut('', [(0.0, 0.0)] * 5, [Pose(0.0, 0.0, 0.0)] * 5, 0.005)) == []


@pytest.mark.parametrize(
    ('record', 'reason'),
    [
        *(({key: PUSH[key] for key in PUSH if key != left}, left) for left in PUSH),
        (PUSH | {'tip_start': [0.03]}, 'tip_start: expected 2 finite numbers'),
        (PUSH | {'tip_start': [0.03, -0.01, 0.0]}, 'tip_start'),
        (PUSH | {'tip_start': ['0.03', '-0.01']}, 'tip_start'),
        (PUSH | {'tip_end': None}, 'tip_end'),
        (PUSH | {'tip_end': [0.03, math.nan]}, 'tip_end: expected 2 finite numbers'),
        (PUSH | {'object_start': [0.0, 0.0]}, 'object_start'),
        (PUSH | {'object_start': [math.nan, 0.0, 0.0]}, 'object_start'),
        (PUSH | {'object_end': 3}, 'object_end'),
        (PUSH | {'object_end': [0.0, math.inf, 0.0]}, 'object_end'),
        (PUSH | {'object_end': [None, None, None]}, 'object_end: expected 3 finite numbers'),
        *((PUSH | {'force': force}, 'force') for force in (None, [1.0], ['a', 'b'], [math.nan, 1])),
        ({'tip_path': [[0.0, 0.0]] * 3}, 'object_path'),
        ({'tip_path': [[0, 0]] * 3, 'object_path': [[0, 0, 0]] * 2}, 'object_path: expected 3'),
        ({'tip_path': [[0, 0]] * 2, 'object_path': [[0, 0, 0], [0, 0]]}, 'object_path[1]'),
        (3, 'expected an object'),
        (None, 'expected an object'),
    ],
)
def test_a_record_that_is_no_push_is_named(write, record, reason):
    read = pushes_in(write(content([PUSH, record, PUSH])))

    (bad,) = read.bad
    assert bad.name.endswith('block.json: pushes[1]')
    assert bad.reason.startswith(reason)
    assert '\n' not in bad.reason
    assert len(read.pushes) == 2


@pytest.mark.parametrize('text', ['', '{"outline": ', '[]', 'null'])
def test_a_file_that_is_no_json_object_is_refused(refused, text):
    assert 'JSON' in refused(text)


@pytest.mark.parametrize('key', ['outline', 'tip_radius', 'pushes'])
def test_a_file_without_a_key_is_refused(refused, key):
    made = content([PUSH])
    del made[key]

    assert key in refused(made)


@pytest.mark.parametrize('radius', [-1, 0, math.nan, None, 'thin', '0.005', [0.005]])
def test_a_radius_that_is_none_is_refused(refused, radius):
    assert 'tip_radius' in refused(content([PUSH], tip_radius=radius))


@pytest.mark.parametrize('pushes', [None, {}, {'a': PUSH}, []])
def test_pushes_that_are_none_are_refused(refused, pushes):
    assert 'pushes' in refused(content(pushes))


def test_an_outline_in_millimetres_is_refused_with_a_hint(refused):
    large = [[1000.0 * x, 1000.0 * y] for x, y in VERTICES]

    line = refused(content([PUSH], outline={'kind': 'polygon', 'vertices': large}))

    assert 'are these millimetres?' in line


@pytest.mark.parametrize(
    'support',
    [
        *([], {}, {'points': 3}, {'points': [[0.0]], 'loads': [1.0]}, {'spread': 4.0}, 'rim'),
        {'points': [[0.001, 0.001], [0.01, 0.001], [0.001, 0.01]]},  # beside the centre of mass
    ],
)
def test_a_support_that_cannot_be_is_refused(refused, support):
    made = content([PUSH], support=support, centre_of_mass=[0.025, 0.0216])

    assert 'block.json: support: ' in refused(made)


def test_loads_that_the_file_leaves_out_are_those_of_statics(write):
    points = [[0.0, 0.0], [0.06, 0.0], [0.0, 0.05]]
    made = content([PUSH], support={'points': points}, centre_of_mass=[0.015, 0.025])

    loads = pushes_in(write(made)).support.loads

    assert loads == pytest.approx([0.25, 0.25, 0.5], abs=1e-9)  # by levers


def test_a_known_object_takes_the_place_of_the_file_s(write):
    made = content([PUSH])
    del made['outline']
    known = ObjectFile(Outline.circle(0.03))

    assert pushes_in(write(made), known).outline is known.outline


def test_pushes_of_several_files_are_those_of_one_object(write):
    one, other = pushes_in(write(content([PUSH, 3]))), pushes_in(write(content([PUSH]), 'b'))

    both = merged([one, other])

    assert both.pushes == one.pushes + other.pushes
    assert both.bad == one.bad


@pytest.mark.parametrize('what', ['outline', 'support'])
def test_pushes_of_several_objects_are_refused(write, what):
    one = pushes_in(write(content([PUSH])))
    other = {'outline': Outline.circle(0.03), 'support': Support.uniform(one.outline, 10)}

    with pytest.raises(ValueError, match=f'{what}: expected the same in all DATA'):
        merged([one, replace(one, **{what: other[what]})])


def test_some_of_the_pushes_keep_the_rest():
    pushes = [Push(str(k), *[Pose(0.0, 0.0, 0.0)] * 2, ((0, 0), (0, 1)), 1.0) for k in range(4)]
    some = Pushes(Outline.circle(1.0), tuple(pushes), None, (Bad('a', 'b'),)).of([3, 1])

    assert [push.name for push in some.pushes] == ['3', '1']
    assert some.bad == (('a', 'b'),)
