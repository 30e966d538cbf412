# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import json
import math
import re
import tempfile
import warnings
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tactile_push.mechanics import Support
from tactile_push.simulation import read_object, read_support

TRIANGLE = [[0.01, 0.02], [0.05, 0.02], [0.02, 0.06]]


@pytest.fixture
def write(tmp_path):
    """Return a function that writes a file, objects as JSON and text as it is."""

    def written(content):
        file = tmp_path / 'thing.json'
        file.write_text(content if isinstance(content, str) else json.dumps(content))
        return file

    return written


def area_and_perimeter(outline):
    """Measure an outline with points that lie dense on it."""
    points = outline.points(1e-4)
    ahead = np.roll(points, -1, axis=0)
    twice = (points[:, 0] * ahead[:, 1] - points[:, 1] * ahead[:, 0]).sum()
    return twice / 2.0, np.hypot(*(ahead - points).T).sum()


def test_a_polygon_keeps_its_frame_and_its_first_edge(write):
    thing = read_object(write({'outline': {'kind': 'polygon', 'vertices': TRIANGLE}}))
    outline, centre = thing.outline, thing.centre_of_mass

    assert centre is None
    assert outline.points(1.0) == pytest.approx(np.array(TRIANGLE), abs=1e-16)


def test_a_polygon_given_clockwise_is_the_same_object(write):
    # The first edge goes from the first to the second corner, whichever way the file runs.
    backwards = [TRIANGLE[1], TRIANGLE[0], TRIANGLE[2]]

    outline = read_object(write({'outline': {'kind': 'polygon', 'vertices': backwards}})).outline

    assert outline.points(1.0) == pytest.approx(np.array(TRIANGLE), abs=1e-16)


def test_a_circle_has_its_radius(write):
    outline = read_object(write({'outline': {'kind': 'circle', 'radius': 0.03}})).outline

    assert outline.length == pytest.approx(2.0 * math.pi * 0.03, rel=1e-14)
    assert np.hypot(*outline.points(1e-3).T) == pytest.approx(0.03, rel=1e-12)


def test_an_ellipse_has_its_half_axes_in_order(write):
    outline = read_object(
        write({'outline': {'kind': 'ellipse', 'semi_axes': [0.04, 0.02]}})
    ).outline

    x, y = outline.points(1e-4).T
    assert (x / 0.04) ** 2 + (y / 0.02) ** 2 == pytest.approx(1.0, abs=1e-5)
    area, _ = area_and_perimeter(outline)
    assert area == pytest.approx(math.pi * 0.04 * 0.02, rel=1e-4)


def test_a_smooth_outline_is_the_curve_through_its_points(write):
    angles = np.linspace(0.0, 2.0 * math.pi, 24, endpoint=False)
    points = np.stack([0.01 + 0.03 * np.cos(angles), 0.03 * np.sin(angles)], axis=1)

    outline = read_object(write({'outline': {'kind': 'smooth', 'points': points.tolist()}})).outline

    assert np.hypot(*(outline.points(1e-4) - [0.01, 0.0]).T) == pytest.approx(0.03, rel=1e-9)


@pytest.mark.parametrize('centre', [[0.02, 0.03], [0, 0], [-0.001, 1e-9]])
def test_the_centre_of_mass_comes_as_a_pair_of_floats(write, centre):
    content = {'outline': {'kind': 'circle', 'radius': 0.03}, 'centre_of_mass': centre}

    read = read_object(write(content)).centre_of_mass

    assert read == tuple(centre)
    assert all(type(value) is float for value in read)


def test_a_centre_of_mass_of_null_is_an_unknown_one(write):
    content = {'outline': {'kind': 'circle', 'radius': 0.03}, 'centre_of_mass': None}

    assert read_object(write(content)).centre_of_mass is None


def test_whole_numbers_are_lengths_too(write):
    outline = read_object(write('{"outline": {"kind": "ellipse", "semi_axes": [2, 1]}}')).outline

    assert area_and_perimeter(outline)[0] == pytest.approx(2.0 * math.pi, rel=1e-3)


def test_other_keys_do_no_harm(write):
    # Files of measured pushes hold an object's outline beside the pushes.
    content = {
        'surface': 'plywood',
        'pushes': [],
        'outline': {'kind': 'polygon', 'vertices': TRIANGLE, 'unit': 'm'},
    }

    assert len(read_object(write(content)).outline.points(1.0)) == 3


def test_an_object_may_have_its_support_and_friction(write):
    points = [[0.015, 0.025], [0.04, 0.025], [0.02, 0.05]]
    content = {
        'outline': {'kind': 'polygon', 'vertices': TRIANGLE},
        'support': {'points': points, 'loads': [1.0, 2.0, 5.0]},
        'mu_c': 0.3,
    }

    thing = read_object(write(content))

    assert thing.support.points == pytest.approx(np.array(points))
    assert thing.support.loads == pytest.approx([1.0, 2.0, 5.0])
    assert thing.mu_c == 0.3


def test_an_object_s_load_may_be_spread_by_one_number_and_tilted(write):
    outline = {'kind': 'polygon', 'vertices': TRIANGLE}
    content = {'outline': outline, 'support': {'spread': 2.4}}

    even = read_object(write(content))
    tilted = read_object(write(content | {'centre_of_mass': [0.028, 0.032]}))

    expected = Support.spread(even.outline, 2.4)
    assert even.support.centre == pytest.approx(np.mean(TRIANGLE, axis=0))
    assert even.support.loads == pytest.approx(expected.loads)
    assert tilted.support.centre == (0.028, 0.032)
    assert tilted.support.loads @ tilted.support.points == pytest.approx([0.028, 0.032])


def test_loads_of_an_object_that_are_left_out_carry_it_at_its_centroid(write):
    # That of a triangle is the mean of its corners, which bear alike.
    content = {
        'outline': {'kind': 'polygon', 'vertices': TRIANGLE},
        'support': {'points': TRIANGLE},
    }

    assert read_object(write(content)).support.loads == pytest.approx(1.0 / 3.0)


@pytest.mark.parametrize(
    ('change', 'reason'),
    [
        ({'support': 3}, 'support: expected points or a spread, got 3'),
        ({'support': {}}, 'support: expected points or a spread'),
        ({'support': {'spread': 3.5}}, 'support: spread: expected a number from 0 to 3'),
        ({'support': {'spread': '1'}}, 'support: spread: expected a finite number'),
        ({'support': {'points': [[0.0]]}}, 'support: points: '),
        ({'support': {'spread': 1.0}, 'centre_of_mass': [0.1, 0.1]}, 'support: centre_of_mass: '),
        ({'mu_c': -0.1}, 'mu_c: expected a number of 0 or more'),
        ({'mu_c': math.nan}, 'mu_c: '),
    ],
)
def test_a_support_and_friction_that_cannot_be_are_refused(write, change, reason):
    content = {'outline': {'kind': 'polygon', 'vertices': TRIANGLE}, **change}

    assert reason in refused(read_object, write(content))


def test_a_support_has_its_loads_and_the_centre_and_moment_that_follow(write):
    points, loads = np.array([[0.0, 0.0], [0.03, 0.0], [0.0, 0.04]]), np.array([1.0, 2.0, 5.0])

    support = read_support(write({'points': points.tolist(), 'loads': loads.tolist()}))

    assert support.points == pytest.approx(points)
    assert support.loads == pytest.approx(loads)
    centre = (points * loads[:, None]).sum(axis=0) / 8.0
    assert support.centre == pytest.approx(centre, rel=1e-14)
    assert support.f_max == pytest.approx(8.0)  # (2)
    arms = np.hypot(*(points - centre).T)
    assert support.c == pytest.approx((loads * arms).sum() / 8.0, rel=1e-14)  # (1)


def test_points_without_loads_bear_what_the_centre_of_mass_asks_for(write):
    points = [[0.0, 0.0], [0.03, 0.0], [0.0, 0.04]]

    support = read_support(write({'points': points}), (0.015, 0.01))

    assert support.loads == pytest.approx([0.25, 0.5, 0.25], abs=1e-9)  # by levers


def test_given_loads_stay_whatever_the_centre_of_mass(write):
    content = {'points': [[0.0, 0.0], [0.03, 0.0], [0.0, 0.04]], 'loads': [1.0, 2.0, 5.0]}

    assert read_support(write(content), (0.0, 0.0)).loads == pytest.approx([1.0, 2.0, 5.0])


def test_points_that_an_object_tips_over_are_refused(write):
    with pytest.raises(ValueError, match='centre_of_mass: expected a point over the support'):
        read_support(write({'points': [[0.0, 0.0], [0.03, 0.0], [0.0, 0.04]]}), (0.03, 0.03))


def test_points_without_loads_bear_alike(write):
    points = [[0.0, 0.0], [0.03, 0.0], [0.0, 0.03]]

    support = read_support(write({'points': points}))

    assert len(set(support.loads)) == 1
    assert support.centre == pytest.approx((0.01, 0.01))


def refused(read, file):
    """Return the message with which a file is refused."""
    with warnings.catch_warnings():
        warnings.simplefilter('error')
        with pytest.raises(ValueError) as error:
            read(file)
    message = str(error.value)
    assert message.startswith(f'{file}: ')
    assert '\n' not in message
    assert 'expected' in message
    return message[len(f'{file}: ') :]


BEYOND = pytest.param(10**400, id='beyond floats')
NO_NUMBER = [None, 'abc', '0.03', {}, [[0.03]], True, BEYOND]
NO_POINTS = {
    'null': None,
    'text': 'abc',
    'number': 3,
    'object': {'x': 1, 'y': 2},
    'empty': [],
    'numbers': [1, 2, 3],
    'ragged': [[0, 0], [0.01], [0, 0.01]],
    'three numbers': [[0, 0, 0], [0.01, 0, 0], [0, 0.01, 0]],
    'nulls': [[0, 0], [None, 0], [0, 0.01]],
    'words': [['a', 'b'], ['c', 'd'], ['e', 'f']],
    'numbers as text': [['0', '0'], ['0.01', '0'], ['0', '0.01']],
    'truth': [[False, False], [True, False], [False, True]],
    'objects': [{}, {}, {}],
    'nested deeper': [[[0], [0]], [[1], [0]], [[0], [1]]],
    'NaN': [[0, 0], [math.nan, 0], [0, 0.01]],
    'infinity': [[0, 0], [math.inf, 0], [0, 0.01]],
    'beyond floats': [[0, 0], [10**400, 0], [0, 0.01]],
}


@pytest.mark.parametrize(
    ('kind', 'key', 'lengths'),
    [
        ('polygon', 'vertices', [[0, 0], [50, 0], [50, 47.5], [0, 47.5]]),
        ('circle', 'radius', 30),
        ('ellipse', 'semi_axes', [20, 30]),
        ('smooth', 'points', [[20, 0], [0, 30], [-20, 0], [0, -30]]),
    ],
)
def test_lengths_in_millimetres_are_doubted(write, kind, key, lengths):
    with pytest.raises(ValueError, match=rf'thing.json: {key}: expected metres, .* millimetres\?$'):
        read_object(write({'outline': {'kind': kind, key: lengths}}))
    metres = (1e-3 * np.array(lengths)).tolist()
    read_object(write({'outline': {'kind': kind, key: metres}}))


@pytest.mark.parametrize('points', NO_POINTS.values(), ids=NO_POINTS)
@pytest.mark.parametrize(('kind', 'key'), [('polygon', 'vertices'), ('smooth', 'points')])
def test_what_is_no_list_of_points_is_refused_with_its_key(write, kind, key, points):
    assert key in refused(read_object, write({'outline': {'kind': kind, key: points}}))


@pytest.mark.parametrize('points', NO_POINTS.values(), ids=NO_POINTS)
def test_what_is_no_list_of_support_points_is_refused_with_its_key(write, points):
    assert 'points' in refused(read_support, write({'points': points}))


@pytest.mark.parametrize('radius', [*NO_NUMBER, [], 0, -1, -0.0, math.nan, math.inf])
def test_what_is_no_radius_is_refused(write, radius):
    content = {'outline': {'kind': 'circle', 'radius': radius}}

    assert 'radius' in refused(read_object, write(content))


@pytest.mark.parametrize(
    'semi_axes',
    [
        *NO_NUMBER,
        0.03,
        [],
        [0.03],
        [0.03, 0.02, 0.01],
        [None, None],
        ['0.03', '0.02'],
        [[0.03], [0.02]],
        [0.03, 0],
        [-0.03, 0.02],
        [0.03, math.nan],
        [math.inf, 0.02],
        [10**400, 1],
    ],
)
def test_what_are_no_half_axes_is_refused(write, semi_axes):
    content = {'outline': {'kind': 'ellipse', 'semi_axes': semi_axes}}

    assert 'semi_axes' in refused(read_object, write(content))


@pytest.mark.parametrize(
    'centre',
    [
        0.01,
        'ab',
        '12',
        {},
        {'x': 0, 'y': 0},
        [],
        [0],
        [0, 0, 0],
        [None, None],
        ['0', '0'],
        [[0], [0]],
        [True, False],
        [math.nan, 0],
        [0, math.inf],
        [10**400, 0],
    ],
)
def test_what_is_no_centre_of_mass_is_refused(write, centre):
    content = {'outline': {'kind': 'polygon', 'vertices': TRIANGLE}, 'centre_of_mass': centre}

    assert 'centre_of_mass' in refused(read_object, write(content))


@pytest.mark.parametrize(
    'loads',
    [
        3,
        'abc',
        '123',
        {},
        [],
        [1, 1],
        [1, 1, 1, 1],
        [[1], [1], [1]],
        [None, 1, 1],
        ['1', '1', '1'],
        ['a', 'b', 'c'],
        [True, True, True],
        [1, 1, -1],
        [0, 0, 0],
        [1, 1, math.nan],
        [1, 1, math.inf],
        [1, 1, 10**400],
    ],
)
def test_what_are_no_loads_is_refused(write, loads):
    points = [[0, 0], [0.01, 0], [0, 0.01]]

    assert 'loads' in refused(read_support, write({'points': points, 'loads': loads}))


@pytest.mark.parametrize(
    'vertices',
    [
        pytest.param([[0, 0], [0.04, 0]], id='two points'),
        pytest.param([[0, 0], [0.04, 0], [0.01, 0.01], [0, 0.04]], id='not convex'),
        pytest.param([[0, 0], [0.04, 0.04], [0.04, 0], [0, 0.04]], id='crossing itself'),
        pytest.param([[0, 0], [0.04, 0], [0.04, 0.04], [0, 0.04]] * 2, id='twice around'),
        pytest.param([[0, 0], [0.01, 0], [0.02, 0]], id='on a line'),
        pytest.param([[0, 0], [0.01, 0], [0.01, 0], [0, 0.01]], id='the same twice'),
    ],
)
@pytest.mark.parametrize(('kind', 'key'), [('polygon', 'vertices'), ('smooth', 'points')])
def test_an_outline_that_is_not_convex_is_refused_with_its_points(write, kind, key, vertices):
    message = refused(read_object, write({'outline': {'kind': kind, key: vertices}}))

    assert message.startswith(f'{key}: expected ')
    assert f'got {np.array(vertices, dtype=float).tolist()}' in message


@pytest.mark.parametrize(
    'outline',
    [
        None,
        [],
        'polygon',
        3,
        {},
        {'kind': None},
        {'kind': 3},
        {'kind': 'hexagon'},
        {'kind': 'Polygon', 'vertices': TRIANGLE},
        {'kind': ['polygon'], 'vertices': TRIANGLE},
        {'kind': {'polygon': 1}, 'vertices': TRIANGLE},
        {'vertices': TRIANGLE},
    ],
)
def test_an_unknown_kind_of_outline_is_refused_with_the_known_ones(write, outline):
    message = refused(read_object, write({'outline': outline}))

    assert message.startswith('outline: ')
    assert all(kind in message for kind in ('polygon', 'circle', 'ellipse', 'smooth'))


def test_a_file_without_an_outline_is_refused(write):
    assert 'outline' in refused(read_object, write({'vertices': TRIANGLE}))


@pytest.mark.parametrize(
    ('kind', 'key'),
    [
        ('polygon', 'vertices'),
        ('circle', 'radius'),
        ('ellipse', 'semi_axes'),
        ('smooth', 'points'),
    ],
)
def test_an_outline_without_its_numbers_is_refused_with_the_missing_key(write, kind, key):
    message = refused(read_object, write({'outline': {'kind': kind}}))

    assert re.search(rf'\b{key}\b', message)
    assert kind in message


@pytest.mark.parametrize('content', [{}, {'loads': [1, 2]}, {'Points': TRIANGLE}])
def test_a_support_without_points_is_refused(write, content):
    assert '"points"' in refused(read_support, write(content))


@pytest.mark.parametrize('read', [read_object, read_support])
@pytest.mark.parametrize(
    'text',
    [
        pytest.param('', id='empty'),
        pytest.param('{"outline": ', id='cut off'),
        pytest.param('{} {}', id='two objects'),
        pytest.param('outline: polygon', id='not JSON'),
        pytest.param('[]', id='list'),
        pytest.param('"text"', id='text'),
        pytest.param('3.5', id='number'),
        pytest.param('null', id='null'),
        pytest.param('[' * 100_000, id='nested without end'),
        pytest.param('{"outline": ' * 100_000, id='objects without end'),
    ],
)
def test_a_file_that_is_no_json_object_is_refused(write, read, text):
    assert 'JSON' in refused(read, write(text))


@pytest.mark.parametrize('read', [read_object, read_support])
def test_a_binary_file_is_refused(tmp_path, read):
    file = tmp_path / 'thing.json'
    file.write_bytes(bytes(range(256)))

    assert 'JSON' in refused(read, file)


@pytest.mark.parametrize('read', [read_object, read_support])
def test_a_file_that_cannot_be_read_is_an_error_of_the_system(tmp_path, read):
    with pytest.raises(FileNotFoundError) as missing:
        read(tmp_path / 'nothing.json')
    assert missing.value.filename == str(tmp_path / 'nothing.json')
    with pytest.raises(IsADirectoryError):
        read(tmp_path)


@pytest.mark.parametrize('key', ['points', 'loads'])
def test_a_message_does_not_grow_with_the_file(write, key):
    count = 3000
    content = {'points': [[0.001 * i, 0.0] for i in range(count)], 'loads': [1.0] * count}
    content[key] = [[math.nan, 0.0]] * count if key == 'points' else [-1.0] * count

    assert len(refused(read_support, write(content))) < 500


leaves = st.one_of(
    st.none(),
    st.booleans(),
    st.integers(-3, 3),
    st.integers(),
    st.floats(),
    st.text(max_size=3),
    st.sampled_from(['polygon', 'circle', 'ellipse', 'smooth', '0.01']),
)
keys = st.sampled_from(
    ['outline', 'kind', 'vertices', 'radius', 'semi_axes', 'points', 'loads', 'centre_of_mass']
)
anything = st.recursive(
    leaves,
    lambda inner: st.one_of(st.lists(inner, max_size=5), st.dictionaries(keys, inner, max_size=4)),
    max_leaves=12,
)
outlines = st.fixed_dictionaries(
    {'kind': st.one_of(st.sampled_from(['polygon', 'circle', 'ellipse', 'smooth']), anything)},
    optional={
        key: st.one_of(anything, st.lists(st.lists(st.floats(), min_size=2, max_size=2)))
        for key in ('vertices', 'radius', 'semi_axes', 'points')
    },
)


@pytest.mark.slow
@settings(
    derandomize=True,
    deadline=None,
    max_examples=300,
)
@given(
    st.fixed_dictionaries(
        {'outline': st.one_of(outlines, anything)},
        optional={'centre_of_mass': anything, 'support': anything, 'mu_c': anything},
    ),
    st.fixed_dictionaries({'points': anything}, optional={'loads': anything}),
)
def test_whatever_a_file_holds_it_is_read_or_refused_in_one_line(thing, support):
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / 'thing.json'
        for read, content in ((read_object, thing), (read_support, support)):
            file.write_text(json.dumps(content))
            try:
                read(file)
            except ValueError as error:
                assert str(error).startswith(f'{file}: ')
                assert '\n' not in str(error)
