# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import cmath
import importlib.util
import json
import math
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from tactile_push.mechanics import Outline, Pose, Slider, Support

BENCHMARKS = Path(__file__).parents[2] / 'benchmarks'
sys.path.insert(0, str(BENCHMARKS))

from pushing import fitting  # noqa: E402
from pushing.bounds import standard_deviations  # noqa: E402
from pushing.predicting import Physics, final_poses, force_errors, predict  # noqa: E402
from pushing.records import read_pushes  # noqa: E402

SCRIPT = BENCHMARKS / 'real_pushes.py'
RADIUS = 0.005  # of the tip
# The origin of the file's frame is far from the centroid (0.025, 0.0216).
VERTICES = [[0.0, 0.0], [0.06, 0.0], [0.05, 0.04], [0.0, 0.05]]
SPREADS = (1.0, 1.4)
FRICTIONS = (0.1, 0.3)


@pytest.fixture(scope='module')
def script():
    """Load the benchmark as a module."""
    spec = importlib.util.spec_from_file_location('real_pushes', SCRIPT)
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    yield module
    del sys.modules[spec.name]


@pytest.fixture
def bench(script, monkeypatch):
    """Give the benchmark with a small grid and few points of support."""
    for module in (script, fitting):
        monkeypatch.setattr(module, 'POINTS', 40)
    monkeypatch.setattr(fitting, 'SPREADS', np.array(SPREADS))
    monkeypatch.setattr(fitting, 'FRICTIONS', np.array(FRICTIONS))
    monkeypatch.setattr(fitting, 'REFINEMENTS', 0)
    return script


@pytest.fixture
def main(bench, monkeypatch, capsys):
    """Return a function that runs the benchmark: exit status, standard output, standard error."""

    def run(*arguments):
        capsys.readouterr()
        monkeypatch.setattr(sys, 'argv', ['real_pushes.py', *map(str, arguments)])
        try:
            status = bench.main()
        except SystemExit as end:
            status = end.code
        return status, *capsys.readouterr()

    return run


@pytest.fixture
def write(tmp_path):
    """Return a function that writes files of pushes into one folder and gives the folder."""
    folder = tmp_path / 'pushes'
    folder.mkdir()

    def written(content, name='block'):
        text = content if isinstance(content, str) else json.dumps(content)
        (folder / f'{name}.json').write_text(text)
        return folder

    return written


def placed(pose, x, y):
    """Give where a point of the object is, as a complex number."""
    return complex(pose[0], pose[1]) + cmath.exp(1j * pose[2]) * complex(x, y)


def measured(support, mu_c, start, tip_start, tip_end, tilt=0.0):
    """Push an object in a file's frame, as an experiment would write it down."""
    x, y = support.centre
    slider = Slider.on(Outline.polygon(VERTICES), support, exact=True, tilt=tilt)
    middle = placed(start, x, y)
    moved = slider.pushed(
        Pose(middle.real, middle.imag, start[2]), tip_start, tip_end, mu_c, RADIUS
    )
    end = complex(moved.x, moved.y) - cmath.exp(1j * moved.angle) * complex(x, y)
    return {
        'tip_start': list(tip_start),
        'tip_end': list(tip_end),
        'object_start': list(start),
        'object_end': [end.real, end.imag, moved.angle],
    }


def ways(count, seed=1):
    """Give starts of the object and straight ways of the tip against one of its sides."""
    random = np.random.default_rng(seed)
    for _ in range(count):
        start = (*random.uniform(-0.3, 0.3, 2), random.uniform(-3.0, 3.0))
        side = random.integers(4)
        a, b = np.array(VERTICES[side]), np.array(VERTICES[(side + 1) % 4])
        outward = np.array([b[1] - a[1], a[0] - b[0]]) / np.hypot(*(b - a))
        along = (b - a) / np.hypot(*(b - a))
        begin = a + random.uniform(0.2, 0.8) * (b - a) + (RADIUS + 0.003) * outward
        end = begin - 0.02 * outward + random.uniform(-0.01, 0.01) * along
        tips = [placed(start, *point) for point in (begin, end)]
        yield start, *((tip.real, tip.imag) for tip in tips)


def content(pushes, **more):
    return {
        'surface': 'made up',
        'outline': {'kind': 'polygon', 'vertices': VERTICES},
        'tip_radius': RADIUS,
        'pushes': pushes,
        **more,
    }


def synthetic(bench, count, *physics):
    """Make pushes, by turns with the given spreads and coefficients of friction."""
    outline = Outline.polygon(VERTICES)
    supports = [Support.spread(outline, spread, 40) for spread, _ in physics]
    return [
        measured(supports[i % len(physics)], physics[i % len(physics)][1], *way)
        for i, way in enumerate(ways(count))
    ]


def deviation(one, other):
    """Give how far and by what angle final poses differ, [m] and [rad]."""
    ends = [np.array([push['object_end'] for push in pushes]) for pushes in (one, other)]
    offset = ends[0] - ends[1]
    turned = (offset[:, 2] + math.pi) % (2.0 * math.pi) - math.pi
    return np.hypot(offset[:, 0], offset[:, 1]), np.abs(turned)


def test_a_prediction_with_the_true_numbers_has_no_error(bench, write):
    pushes = synthetic(bench, 12, (1.4, 0.25))
    folder = write(content(pushes))
    # They are pushes: the object moves and turns.
    moved, turned = deviation(pushes, [{'object_end': push['object_start']} for push in pushes])
    assert np.median(moved) > 0.005
    assert np.median(turned) > 0.05

    read = read_pushes(folder / 'block.json')
    errors = predict(read, Physics(Support.spread(read.outline, 1.4, 40), 0.25))

    assert read.name == 'block'
    assert errors.position == pytest.approx(0.0, abs=1e-9)
    assert errors.angle == pytest.approx(0.0, abs=1e-9)
    wrong = predict(read, Physics(Support.spread(read.outline, 2.4, 40), 0.05))
    assert wrong.position.mean() > 1e-4


def test_errors_are_distances_of_the_origin_and_angles_the_short_way_around(bench, write):
    pushes = synthetic(bench, 3, (1.4, 0.25))
    pushes[0]['object_end'][0] += 0.003
    pushes[0]['object_end'][1] -= 0.004
    pushes[1]['object_end'][2] += 0.25
    pushes[2]['object_end'][2] += 2.0 * math.pi - 0.125
    read = read_pushes(write(content(pushes)) / 'block.json')

    errors = predict(read, Physics(Support.spread(read.outline, 1.4, 40), 0.25))

    assert errors.position == pytest.approx([0.005, 0.0, 0.0], abs=1e-9)
    assert errors.angle == pytest.approx([0.0, 0.25, 0.125], abs=1e-9)
    assert errors.figures() == pytest.approx(
        {
            'mean_mm': 5.0 / 3.0,
            'median_mm': 0.0,
            'mean_deg': math.degrees(0.125),
            'median_deg': math.degrees(0.125),
        },
        abs=1e-6,
    )


def translation(overlap, length, yaw):
    """Push a square centred in its frame at its middle, head on, from inside it by some way."""
    start = (0.1, -0.2, yaw)
    begin = placed(start, 0.0, -0.02 - RADIUS + overlap)
    end = begin + cmath.exp(1j * yaw) * 1j * length
    moved = max(length - max(-overlap, 0.0), 0.0) * cmath.exp(1j * yaw) * 1j
    return {
        'tip_start': [begin.real, begin.imag],
        'tip_end': [end.real, end.imag],
        'object_start': list(start),
        'object_end': [start[0] + moved.real, start[1] + moved.imag, yaw],
    }


@pytest.mark.parametrize('mu_c', [0.0, 0.3, math.inf])
def test_a_head_on_push_moves_the_object_by_the_rest_of_the_way(bench, write, mu_c):
    # Symmetry allows nothing else; after the gap, and from the contact where poses overlap.
    square = [[-0.02, -0.02], [0.02, -0.02], [0.02, 0.02], [-0.02, 0.02]]
    pushes = [
        translation(overlap, length, yaw)
        for overlap, length, yaw in [
            (-0.004, 0.015, 0.0),
            (-0.004, 0.003, 1.0),
            (0.0, 0.01, -2.0),
            (0.001, 0.01, 0.5),
            (0.002, 0.0125, 3.0),
        ]
    ]
    made = content(pushes, outline={'kind': 'polygon', 'vertices': square})
    read = read_pushes(write(made) / 'block.json')

    errors = predict(read, Physics(Support.corners(read.outline), mu_c))

    assert errors.position == pytest.approx(0.0, abs=1e-9)
    assert errors.angle == pytest.approx(0.0, abs=1e-8)


def test_an_overlap_moves_the_way_of_the_tip_out_along_the_normal(bench, write):
    overlap = 0.0015
    pushes = []
    for start, begin, end in ways(6):
        # The contact's normal, from the place of the tip over the nearest side.
        there = (complex(*begin) - complex(*start[:2])) * cmath.exp(-1j * start[2])
        normals = []
        for a, b in zip(VERTICES, VERTICES[1:] + VERTICES[:1], strict=True):
            edge = complex(*b) - complex(*a)
            inward = 1j * edge / abs(edge)
            outside = -((there - complex(*a)) * inward.conjugate()).real
            normals.append((outside, inward))
        outside, inward = max(normals, key=lambda pair: pair[0])
        inward *= cmath.exp(1j * start[2])
        # Begin in contact instead of 3 mm before it; write it down too deep by the overlap.
        contact = complex(*begin) + (outside - RADIUS) * inward
        finish = complex(*end) + (outside - RADIUS) * inward
        push = measured(
            Support.spread(Outline.polygon(VERTICES), 1.4, 40),
            0.2,
            start,
            (contact.real, contact.imag),
            (finish.real, finish.imag),
        )
        for key in ('tip_start', 'tip_end'):
            deep = complex(*push[key]) + overlap * inward
            push[key] = [deep.real, deep.imag]
        pushes.append(push)
    read = read_pushes(write(content(pushes)) / 'block.json')

    errors = predict(read, Physics(Support.spread(read.outline, 1.4, 40), 0.2))

    assert errors.position == pytest.approx(0.0, abs=1e-8)
    assert errors.angle == pytest.approx(0.0, abs=1e-7)


def fitted(bench, read, which=0):
    """Fit and give the errors and what was fitted on either half."""
    found = fitting.fit(fitting.Search(read, lambda: None))[which]
    name = ('fitted', 'centre')[which]
    return found.errors, [bench._numbers(name, read, half) for half in found.halves]


def test_the_fit_finds_the_numbers_of_the_pushes(bench, write):
    read = read_pushes(write(content(synthetic(bench, 12, (1.0, 0.3)))) / 'block.json')

    errors, numbers = fitted(bench, read)

    c = Support.spread(read.outline, 1.0, 40).c
    assert numbers == [pytest.approx({'spread': 1.0, 'c_mm': 1000.0 * c, 'mu_c': 0.3})] * 2
    assert errors.position == pytest.approx(0.0, abs=1e-9)
    assert errors.angle == pytest.approx(0.0, abs=1e-9)


def test_refinements_find_numbers_between_those_of_the_grid(bench, write, monkeypatch):
    # Whichever point of the grid is best, the one in the middle is half a step away.
    monkeypatch.setattr(fitting, 'REFINEMENTS', 1)
    read = read_pushes(write(content(synthetic(bench, 6, (1.2, 0.2)))) / 'block.json')

    errors, numbers = fitted(bench, read)

    c = Support.spread(read.outline, 1.2, 40).c
    for half in numbers:
        assert half == pytest.approx({'spread': 1.2, 'c_mm': 1000.0 * c, 'mu_c': 0.2})
    assert errors.position == pytest.approx(0.0, abs=1e-9)


def test_either_half_is_predicted_with_the_numbers_of_the_other(bench, write):
    # Every second push has other physics, so that what is fitted on one half is wrong for the
    # other by what the two physics differ for the same push.
    first, second = (1.0, 0.1), (1.4, 0.3)
    mixed = synthetic(bench, 12, first, second)
    swapped = synthetic(bench, 12, second, first)
    read = read_pushes(write(content(mixed)) / 'block.json')

    errors, numbers = fitted(bench, read)

    expected = [
        {
            'spread': spread,
            'c_mm': 1000.0 * Support.spread(read.outline, spread, 40).c,
            'mu_c': mu_c,
        }
        for spread, mu_c in (first, second)
    ]
    assert numbers == [pytest.approx(half) for half in expected]
    position, angle = deviation(mixed, swapped)
    assert np.median(position) > 1e-4
    assert errors.position == pytest.approx(position, abs=1e-9)
    assert errors.angle == pytest.approx(angle, abs=1e-9)


def test_the_nominal_prediction_has_uniform_pressure_and_a_quarter_of_friction(bench, main, write):
    outline = Outline.polygon(VERTICES)
    uniform = Support.uniform(outline, 40)
    folder = write(content([measured(uniform, 0.25, *way) for way in ways(4)]))

    status, out, _ = main(folder, '--json')

    assert status == 0
    nominal = json.loads(out)['files']['block']['nominal']
    assert nominal == pytest.approx(
        {'mean_mm': 0.0, 'mean_deg': 0.0, 'median_mm': 0.0, 'median_deg': 0.0}, abs=1e-5
    )


FEET = {'points': [[0.005, 0.005], [0.05, 0.005], [0.01, 0.04]], 'loads': [1.0, 2.0, 1.5]}


@pytest.mark.parametrize('tilt', [0.0, 3e-3])
def test_pushes_on_a_known_support_say_how_far_above_it_they_are(bench, main, write, tilt):
    support = Support.at_points(FEET['points'], FEET['loads'])
    pushes = [measured(support, 0.4, *way, tilt) for way in ways(6)]
    folder = write(content(pushes, support=FEET))

    status, out, _ = main(folder, '--json')

    assert status == 0
    result = json.loads(out)['files']['block']
    found = [half['tilt_mm'] for half in result['known_tilt']['halves']]
    assert found == pytest.approx([1000.0 * tilt] * 2)
    assert result['known_tilt']['mean_mm'] == pytest.approx(0.0, abs=1e-6)
    assert (result['known']['mean_mm'] > 0.01) == (tilt > 0.0)
    table = main(folder)[1]
    assert f'mu_c 0.400, tilt {1000.0 * tilt:.0f} mm' in table


@pytest.mark.parametrize(
    'support',
    [
        *(None, [], {}, {'points': 3}, {'points': [[0.0]], 'loads': [1.0]}, FEET | {'loads': []}),
        {'points': [[0.001, 0.001], [0.01, 0.001], [0.001, 0.01]]},  # beside the centroid
    ],
)
def test_a_support_that_is_none_is_refused(refused, write, support):
    line = refused(write(content([PUSH, PUSH], support=support)))

    assert 'block.json: support: ' in line or 'block.json: centre_of_mass: ' in line


def test_loads_that_the_file_leaves_out_are_those_of_statics(write):
    points = [[0.0, 0.0], [0.06, 0.0], [0.0, 0.05]]
    folder = write(content([PUSH, PUSH], support={'points': points}, centre_of_mass=[0.015, 0.025]))

    read = read_pushes(folder / 'block.json')

    assert read.support.loads == pytest.approx([0.25, 0.25, 0.5], abs=1e-9)  # by levers


@pytest.mark.parametrize('offset', [(1.0, 0.0), (-1.0, 1.0)])
def test_the_fit_finds_where_the_centre_of_friction_is(bench, write, monkeypatch, offset):
    monkeypatch.setattr(fitting, 'REFINEMENTS', 1)
    outline = Outline.polygon(VERTICES)
    even = Support.spread(outline, 1.4, 40)
    away = fitting.HOME * Support.uniform(outline, 40).c * np.array(offset)
    support = even.carrying((even.centre[0] + away[0], even.centre[1] + away[1]))
    read = read_pushes(
        write(content([measured(support, 0.3, *way) for way in ways(12)])) / 'block.json'
    )

    errors, numbers = fitted(bench, read, 1)

    for half in numbers:
        found = [half[key] for key in ('spread', 'mu_c', 'x_mm', 'y_mm')]
        assert found == pytest.approx([1.4, 0.3, *(1000.0 * away)], abs=1e-3)
    assert errors.position == pytest.approx(0.0, abs=1e-6)
    assert fitted(bench, read)[0].position.mean() > 1e-4


@pytest.mark.parametrize(('gain', 'stays'), [(0.4, True), (0.6, False)])
def test_a_prior_keeps_the_centre_at_home_unless_the_data_ask_for_more(write, gain, stays):
    # A standard deviation away costs half a mean error of one push.
    read = read_pushes(write(content([PUSH] * 20)) / 'block.json')
    search = fitting.Search(read, lambda: None)
    home, away = (1.0, 0.2, 0.0, 0.0), (1.0, 0.2, 0.0, fitting.HOME * search.length)
    search.known = {home: np.full(20, 0.003), away: np.full(20, 0.003)}
    search.known[away][4] -= gain * 0.003

    point, _ = search.best([home, away], 0, 0.003 / 10)

    assert (point == home) == stays


def test_what_the_data_allow_is_what_fits_of_noisy_pushes_scatter_by(bench, write):
    # Newton's step from the truth is the fit; its scatter over draws of noise is the bound.
    outline, sigma = Outline.polygon(VERTICES), 2e-4
    even = Support.spread(outline, 1.4, 40)
    true, random = (1.4, 0.3, 0.0, 0.0), np.random.default_rng(4)
    pushes = [measured(even, 0.3, *way) for way in ways(30)]
    length = Support.uniform(outline, 40).c

    for push in pushes:
        noise = sigma * random.normal(size=3) / [1.0, 1.0, length]
        push['object_end'] = np.add(push['object_end'], noise).tolist()
    read = read_pushes(write(content(pushes)) / 'block.json')

    found = standard_deviations(fitting.Search(read, lambda: None), true)

    slopes = []
    for step in ((0.02, 0, 0, 0), (0, 0.01, 0, 0), (0, 0, 1e-4, 0), (0, 0, 0, 1e-4)):
        search = fitting.Search(read, lambda: None)
        physics = [search.physics(tuple(np.add(true, sign * np.array(step)))) for sign in (-1, 1)]
        lower, upper = (
            np.array([tuple(pose) for pose in final_poses(read, there)]) for there in physics
        )
        by = physics[1].support.c - physics[0].support.c if step[0] else 2.0 * max(step)
        slopes.append(((upper - lower) / by * [1.0, 1.0, length]).ravel())
    fits = [
        np.linalg.lstsq(np.transpose(slopes), sigma * random.normal(size=90), rcond=None)[0]
        for _ in range(2000)
    ]
    c, mu_c, x, y = np.std(fits, axis=0)
    expected = {'c_mm': 1000.0 * c, 'mu_c': mu_c, 'x_mm': 1000.0 * x, 'y_mm': 1000.0 * y}
    assert found == pytest.approx(expected, rel=0.3)  # the residuals tell sigma to 15 %


def test_the_angle_of_the_force_is_that_between_measured_and_predicted(write):
    # A head-on push at the middle of a square: the force is along the way.
    pushes = [translation(-0.002, 0.01, yaw) for yaw in (0.0, 1.0)]
    for push, beside in zip(pushes, (0.1, -0.2), strict=True):
        way = complex(*push['tip_end']) - complex(*push['tip_start'])
        force = 3.0 * way * cmath.exp(1j * beside)
        push['force'] = [force.real, force.imag]
    square = [[-0.02, -0.02], [0.02, -0.02], [0.02, 0.02], [-0.02, 0.02]]
    made = content(pushes, outline={'kind': 'polygon', 'vertices': square})
    read = read_pushes(write(made) / 'block.json')

    errors = force_errors(read, Physics(Support.corners(read.outline), 0.3))

    assert errors == pytest.approx([0.1, 0.2], abs=1e-9)


def test_without_friction_the_force_turns_with_the_edge(write):
    # It begins along the edge's normal, and its mean over the last 60 % lies between what the edge
    # has turned by before and at the end.
    pushes = []
    for start, begin, far in ways(6):
        end = tuple(np.add(begin, np.subtract(far, begin) * 0.4))  # it stays on the edge
        push = measured(Support.uniform(Outline.polygon(VERTICES), 40), 0.0, start, begin, end)
        there = (complex(*begin) - complex(*start[:2])) * cmath.exp(-1j * start[2])
        edges = [
            (complex(*b) - complex(*a), complex(*a))
            for a, b in zip(VERTICES, VERTICES[1:] + VERTICES[:1], strict=True)
        ]
        _, normal = max(
            (((there - a) * (-1j * edge).conjugate()).real / abs(edge), 1j * edge)
            for edge, a in edges
        )
        force = normal * cmath.exp(1j * start[2])
        pushes.append(push | {'force': [force.real, force.imag]})
    read = read_pushes(write(content(pushes)) / 'block.json')

    errors = force_errors(read, Physics(Support.uniform(read.outline, 40), 0.0))

    turned = np.array([abs(push['object_end'][2] - push['object_start'][2]) for push in pushes])
    assert (errors < turned).all()
    much = turned > 0.02  # and in one sense
    assert much.sum() >= 4
    assert (errors > 0.2 * turned)[much].all()


def test_a_force_within_the_friction_cone_is_what_the_support_resists_with(write):
    # With endless friction the contact sticks, and the force is the sum of the feet's frictions.
    outline = Outline.polygon(VERTICES)
    support = Support.at_points(FEET['points'], FEET['loads'])
    start = (0.0, 0.0, 0.4)
    x, y = support.centre
    ends = [placed(start, *point) for point in ((x + 0.003, -RADIUS), (x + 0.0032, 0.0))]
    push = measured(support, math.inf, start, *((end.real, end.imag) for end in ends))
    slider = Slider.on(outline, support, exact=True)
    way = (ends[1] - ends[0]) / abs(ends[1] - ends[0])
    before = placed(start, x, y)
    after = placed(push['object_end'], x, y)
    turn = push['object_end'][2] - start[2]
    moved = (after - before) * cmath.exp(-0.5j * (start[2] + push['object_end'][2]))
    f_x, f_y, _ = slider.wrench((moved.real, moved.imag, turn))
    force = complex(f_x, f_y) * cmath.exp(1j * push['object_end'][2])
    assert abs(cmath.phase(force / way)) > 0.01
    push['force'] = [force.real, force.imag]
    read = read_pushes(write(content([push, push])) / 'block.json')

    errors = force_errors(read, Physics(support, math.inf))

    assert errors == pytest.approx([0.0, 0.0], abs=0.02)


def test_forces_that_are_none_are_refused(refused, write):
    for force in (None, [1.0], ['a', 'b'], [math.nan, 1.0]):
        line = refused(write(content([PUSH | {'force': [1.0, 0.0]}, PUSH | {'force': force}])))
        assert 'block.json: pushes[1]: force: expected 2 finite numbers' in line


def test_json_has_the_errors_of_every_file_beside_the_published_ones(bench, main, write):
    published = {'ellipsoid': {'mean_mm': 2.5, 'mean_deg': 4.0}}
    still = {'mean_mm': 20.0, 'mean_deg': 15.0}
    write(content(synthetic(bench, 4, (1.0, 0.3)), published=published), 'a')
    folder = write(
        content(synthetic(bench, 5, (1.4, 0.1)), object_did_not_move_baseline=still), 'b'
    )
    (folder / 'README.md').write_text('not a file of pushes')

    status, out, _ = main(folder, '--json')

    assert status == 0
    content_read = json.loads(out, parse_constant=pytest.fail)
    files = content_read['files']
    assert list(content_read) == ['files']
    assert list(files) == ['a', 'b']
    for name, count in (('a', 4), ('b', 5)):
        assert files[name]['pushes'] == count
        for model in ('fitted', 'nominal'):
            for key in ('mean_mm', 'mean_deg', 'median_mm', 'median_deg'):
                assert math.isfinite(files[name][model][key])
        assert files[name]['fitted']['mean_mm'] == pytest.approx(0.0, abs=1e-6)
        assert files[name]['nominal']['mean_mm'] > 0.01
    assert files['a']['published'] == published
    assert still in files['b']['published'].values()


def test_the_table_has_every_file_and_model(bench, main, write):
    published = {'polynomial': {'mean_mm': 1.25, 'mean_deg': 3.5}}
    folder = write(content(synthetic(bench, 4, (1.0, 0.3)), published=published))

    status, out, _ = main(folder)

    assert status == 0
    assert 'nominal' in out
    assert 'polynomial' in out
    assert '1.250' in out
    assert '4 pushes' in out
    assert 'mu_c 0.300' in out


@pytest.mark.slow
def test_the_script_runs_by_its_path(tmp_path):
    done = subprocess.run([sys.executable, SCRIPT, tmp_path], capture_output=True, text=True)

    assert (done.returncode, done.stdout) == (2, '')
    assert done.stderr.count('\n') == 1
    assert str(tmp_path) in done.stderr


# Bad input


@pytest.fixture
def refused(main):
    """Return a function that runs the benchmark, which must fail in one line, and gives it."""

    def run(*arguments):
        status, out, err = main(*arguments)
        assert (status, out) == (2, ''), (out, err)
        assert err.endswith('\n')
        assert err.count('\n') == 1, err
        return err

    return run


PUSH = {
    'tip_start': [0.03, -0.01],
    'tip_end': [0.03, 0.0],
    'object_start': [0.0, 0.0, 0.0],
    'object_end': [0.0, 0.005, 0.0],
}


def test_a_folder_without_files_is_refused(refused, tmp_path):
    line = refused(tmp_path)

    assert 'PATH: ' in line
    assert str(tmp_path) in line


def test_two_files_of_one_name_are_refused(refused, write):
    folder = write(content([PUSH, PUSH]))

    assert 'PATH: expected files of different names, got two of block' in refused(folder, folder)


def test_a_folder_that_is_none_is_refused(refused, tmp_path):
    assert str(tmp_path / 'nowhere') in refused(tmp_path / 'nowhere')


@pytest.mark.parametrize('text', ['', '{"outline": ', '[]', 'null'])
def test_a_file_that_is_no_json_object_is_refused(refused, write, text):
    line = refused(write(text))

    assert 'block.json: expected ' in line
    assert 'JSON' in line


@pytest.mark.parametrize('key', ['outline', 'tip_radius', 'pushes'])
def test_a_file_without_a_key_is_refused(refused, write, key):
    made = content([PUSH] * 4)
    del made[key]

    line = refused(write(made))

    assert 'block.json: ' in line
    assert key in line


@pytest.mark.parametrize('key', PUSH)
def test_a_push_without_a_key_is_refused(refused, write, key):
    one = {name: value for name, value in PUSH.items() if name != key}

    line = refused(write(content([PUSH, one, PUSH, PUSH])))

    assert 'block.json: ' in line
    assert key in line


@pytest.mark.parametrize(
    ('key', 'value'),
    [
        ('tip_start', [0.03]),
        ('tip_start', [0.03, -0.01, 0.0]),
        ('tip_start', ['0.03', '-0.01']),
        ('tip_end', None),
        ('tip_end', [None, None]),
        ('tip_end', [0.03, math.nan]),
        ('object_start', [0.0, 0.0]),
        ('object_start', ['a', 'b', 'c']),
        ('object_start', [math.nan, 0.0, 0.0]),
        ('object_end', 3),
        ('object_end', [0.0, math.inf, 0.0]),
    ],
)
def test_a_place_that_is_none_is_refused(refused, write, key, value):
    line = refused(write(content([PUSH, {**PUSH, key: value}, PUSH, PUSH])))

    assert 'block.json: ' in line
    assert key in line


@pytest.mark.parametrize('radius', [-1, 0, math.nan, None, 'thin', '0.005', [0.005]])
def test_a_radius_that_is_none_is_refused(refused, write, radius):
    line = refused(write(content([PUSH] * 4, tip_radius=radius)))

    assert 'block.json: ' in line
    assert 'tip_radius' in line


@pytest.mark.parametrize('pushes', [None, {}, {'a': PUSH}, [], [PUSH], [1, 2], [None, None]])
def test_pushes_that_do_not_fill_two_halves_are_refused(refused, write, pushes):
    line = refused(write(content(pushes)))

    assert 'block.json: ' in line
    assert 'pushes' in line


@pytest.mark.parametrize('published', [3, [1], {'polynomial': 3}, {'polynomial': {'mean_mm': 'x'}}])
def test_published_errors_that_are_none_are_refused(refused, write, published):
    line = refused(write(content([PUSH] * 4, published=published)))

    assert 'block.json: ' in line
    assert 'published' in line
