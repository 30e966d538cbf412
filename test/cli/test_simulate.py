# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import json
import math
import os
import re
import subprocess
import sys
import warnings
from xml.etree import ElementTree

import matplotlib.image
import numpy as np
import pytest

from support.expected import (
    BLOCK_L,
    FIGURE_8_END,
    FIGURE_8_SETTLE_STEP,
    each_step_of_figure_8,
)
from tactile_push.cli import main

R = 0.0135  # of the finger's disk
LENGTH = 0.0005  # by which the belt moves in a control period, V.A
KEYS = ('theta', 'phi', 'd', 'x', 'y', 'mode')
BLOCK = [[-0.025, -0.02375], [0.025, -0.02375], [0.025, 0.02375], [-0.025, 0.02375]]
SMALL = [[0, 0], [0.01, 0], [0.005, 0.01]]
STAR = {'points': [[0.0187, 0.0], [0.0, 0.0187], [-0.0187, 0.0], [0.0, -0.0187]]}  # c = 1.87 cm
TRIPOD = {'points': [[-0.02, -0.02], [0.02, -0.02], [0.0, 0.02]], 'loads': [1.0, 2.0, 5.0]}


def polygon(vertices, **more):
    return {'outline': {'kind': 'polygon', 'vertices': vertices}, **more}


@pytest.fixture
def write(tmp_path):
    """Return a function that writes a JSON file and gives its path."""

    def written(content, name='thing.json'):
        file = tmp_path / name
        file.write_text(json.dumps(content))
        return str(file)

    return written


@pytest.fixture
def command(capsys):
    """Return a function that runs the command: exit status, standard output, standard error."""

    def run(*arguments):
        capsys.readouterr()
        with warnings.catch_warnings():
            warnings.simplefilter('error')  # a warning would be printed
            try:
                status = main(['simulate', *map(str, arguments)])
            except SystemExit as end:
                status = end.code
        return status, *capsys.readouterr()

    return run


def strict(text):
    """Parse JSON, which has no NaN and no infinities."""

    def refuse(name):
        raise AssertionError(f'{name} in JSON')

    return json.loads(text, parse_constant=refuse)


@pytest.fixture
def simulate(command):
    """Return a function that gives the run that the command prints, arrays as arrays."""

    def run(*arguments, status=0):
        got, out, err = command(*arguments, '--json', '-')
        assert got == status, err
        assert out.count('\n') == 1
        content = strict(out)
        return {name: np.array(value) if name in KEYS else value for name, value in content.items()}

    return run


@pytest.fixture
def fig_8(simulate, write):
    return simulate('--support', write(STAR), '--steps', 700)


def finger(run):
    """Give where the centre of the disk is at the start of every step, from the push angles."""
    x = LENGTH * np.cumsum(np.append(0.0, 1.0 / np.tan(run['phi'][:-1])))
    return x, LENGTH * np.arange(len(run['phi']))


def contact_offset(run):
    """Give the contact relative to the centre of mass, along the tangent and the normal."""
    x_f, y_f = finger(run)
    sin, cos = np.sin(run['theta']), np.cos(run['theta'])
    x, y = x_f - R * sin - run['x'], y_f + R * cos - run['y']
    return cos * x + sin * y, -sin * x + cos * y


def steps_within(theta, desired, band):
    """Give the first step from which on theta is near."""
    step = len(theta)
    while step > 0 and abs(theta[step - 1] - desired) <= band:
        step -= 1
    return step if step < len(theta) else None


# The result


def test_json_has_a_value_for_the_start_of_every_step_in_si(simulate):
    run = simulate('--steps', 30, '--mu-c', 0.05)

    assert {*KEYS, 'c', 'settle_step'} <= set(run)
    for key in KEYS:
        assert run[key].shape == (31,)
    assert run['theta'][0] == pytest.approx(math.radians(20.0), rel=1e-14)
    assert run['phi'][0] == pytest.approx(math.pi / 2.0, rel=1e-14)
    assert run['d'][0] == pytest.approx(-0.006, rel=1e-12)
    assert 'slip_right' in run['mode']
    assert set(run['mode']) <= {'stick', 'slip_left', 'slip_right', 'free'}
    assert run['settle_step'] is None


@each_step_of_figure_8
def test_the_defaults_are_the_step_response_of_figure_8(fig_8, k, theta, phi):
    assert fig_8['c'] == pytest.approx(0.0187, rel=1e-12)
    assert math.degrees(fig_8['theta'][k]) == pytest.approx(theta, abs=0.006)
    assert math.degrees(fig_8['phi'][k]) == pytest.approx(phi, abs=0.06)


def test_figure_8_settles_and_translates_where_the_reference_does(fig_8):
    theta, phi, d = FIGURE_8_END
    assert fig_8['settle_step'] == FIGURE_8_SETTLE_STEP
    assert math.degrees(fig_8['theta'][-1]) == pytest.approx(theta, abs=0.01)
    assert math.degrees(fig_8['phi'][-1]) == pytest.approx(phi, abs=0.06)
    assert fig_8['d'][-1] == pytest.approx(d, abs=6e-6)
    # (17): the centre of mass lies on the ray of pushing.
    assert fig_8['d'][-1] == pytest.approx(
        BLOCK_L / math.tan(fig_8['theta'][-1] - fig_8['phi'][-1]), abs=1e-5
    )


def test_a_run_that_sticks_rolls_without_slipping(fig_8):
    # (16) integrated, I.B: d(0) = d_final + r (theta_final - theta(0)).
    assert set(fig_8['mode']) == {'stick'}
    assert fig_8['d'] + R * fig_8['theta'] == pytest.approx(
        -0.006 + R * math.radians(20.0), abs=1e-12
    )


@pytest.mark.parametrize('mu_c', [0, 0.25, 'inf'])
@pytest.mark.parametrize('surface', ['ellipsoid', 'exact'])
def test_the_centre_of_mass_is_where_finger_and_contact_say(simulate, write, mu_c, surface):
    # The disk's centre starts at the origin and moves by 0.5 mm (1 / tan phi, 1) a period.
    run = simulate(*('--support', write(STAR), '--surface', surface, '--mu-c', mu_c, '--steps', 60))
    x_c, y_c = contact_offset(run)

    assert (np.abs(run['d']) < 0.025).all()  # on the first edge
    assert x_c == pytest.approx(run['d'], abs=1e-12)
    assert y_c == pytest.approx(-0.02375, abs=1e-12)


def test_the_settle_step_is_the_first_from_which_theta_stays_within_three_degrees(simulate):
    for arguments in ((), ('--kp', 0.2), ('--theta0-deg', -10), ('--theta-desired-deg', 19)):
        run = simulate('--steps', 400, *arguments)
        desired = math.radians(19.0 if '--theta-desired-deg' in arguments else -10.0)
        assert run['settle_step'] == steps_within(run['theta'], desired, math.radians(3.0))
    run = simulate('--steps', 100)
    assert run['settle_step'] is None


def test_no_steps_give_the_start_alone(simulate):
    run = simulate('--steps', 0)

    assert [len(run[key]) for key in KEYS] == [1] * 6
    assert run['theta'][0] == pytest.approx(math.radians(20.0))
    assert run['mode'][0] == 'free'  # nothing has moved
    assert run['settle_step'] is None
    assert simulate('--steps', 0, '--theta0-deg', -12)['settle_step'] == 0


# The options


@pytest.mark.parametrize(
    ('theta', 'd', 'phi'), [(-20.0, 4.0, 100.0), (35.5, -24.0, 60.0), (0.0, 0.0, 147.0)]
)
def test_the_start_is_the_one_of_the_options(simulate, theta, d, phi):
    run = simulate(
        *('--theta0-deg', theta, '--d0-mm', d, '--phi0-deg', phi, '--steps', 1, '--open-loop')
    )

    assert math.degrees(run['theta'][0]) == pytest.approx(theta, abs=1e-10)
    assert 1000.0 * run['d'][0] == pytest.approx(d, abs=1e-10)
    assert np.degrees(run['phi']) == pytest.approx(phi, rel=1e-12)
    # From the centre of the disk r + l along the normal and -d along the tangent.
    sin, cos = math.sin(math.radians(theta)), math.cos(math.radians(theta))
    reach = R + 0.02375
    assert run['x'][0] == pytest.approx(-reach * sin - d / 1000.0 * cos, abs=1e-12)
    assert run['y'][0] == pytest.approx(reach * cos - d / 1000.0 * sin, abs=1e-12)


@pytest.mark.parametrize(
    ('kp', 'kd', 'desired', 'first'),
    [(0.05, 5.0, -10.0, 90.0), (0.3, 1.0, 15.0, 80.0), (0.0, 20.0, 0.0, 120.0)],
)
def test_the_push_angle_obeys_the_law(simulate, kp, kd, desired, first):
    run = simulate(
        *('--kp', kp, '--kd', kd, '--theta-desired-deg', desired, '--phi0-deg', first),
        *('--steps', 200, '--mu-c', 0.4),
    )
    phi = math.radians(first)
    for k, theta in enumerate(run['theta']):
        if k > 0:  # (18)
            phi += kp * (theta - math.radians(desired)) + kd * (theta - run['theta'][k - 1])
            phi = min(max(phi, math.radians(33.0)), math.radians(147.0))
        assert run['phi'][k] == pytest.approx(phi, abs=1e-9)


def test_open_loop_keeps_the_push_angle_whatever_the_gains(simulate):
    run = simulate('--open-loop', '--phi0-deg', 100, '--steps', 50)

    assert (run['phi'] == run['phi'][0]).all()
    assert math.degrees(run['phi'][0]) == pytest.approx(100.0)
    other = simulate('--open-loop', '--phi0-deg', 100, '--steps', 50, '--kp', 1, '--kd', 9)
    assert (other['theta'] == run['theta']).all()


@pytest.mark.parametrize('phi', [10, 170])
def test_open_loop_may_push_beyond_the_bounds_of_the_law(simulate, phi):
    run = simulate('--open-loop', '--phi0-deg', phi, '--theta0-deg', 0, '--steps', 2)

    assert np.degrees(run['phi']) == pytest.approx(phi)


def pushed_by_euler(theta, d, mu_c, c, l, steps, parts):
    """Integrate pushes straight ahead with tiny Euler steps, without the paper's closed forms."""
    thetas = [theta]
    step = LENGTH / parts
    for _ in range(steps):
        for _ in range(parts):
            v_t, v_n = math.sin(theta), math.cos(theta)  # the finger's along tangent and normal
            # A force f at the contact moves the contact by A f: v = f, omega = x_c x f / c^2.
            a, b, e = 1.0 + (l / c) ** 2, l * d / c**2, 1.0 + (d / c) ** 2
            f_t = (e * v_t - b * v_n) / (a * e - b * b)
            f_n = (a * v_n - b * v_t) / (a * e - b * b)
            slip = 0.0
            if abs(f_t) > mu_c * f_n:
                share = math.copysign(mu_c, f_t)
                f_n = v_n / (b * share + e)
                f_t = share * f_n
                slip = v_t - (a * f_t + b * f_n)
            omega = (d * f_n + l * f_t) / c**2
            theta += omega * step
            d += (slip - omega * R) * step  # (16)
        thetas.append(theta)
    return np.array(thetas)


@pytest.mark.parametrize('mu_c', [0.0, 0.1, 0.2, math.inf])
@pytest.mark.parametrize(
    ('support', 'c'), [('corners', math.hypot(0.025, 0.02375)), (STAR, 0.0187)]
)
def test_pushes_are_those_of_a_fine_integration(simulate, write, support, c, mu_c):
    support = support if isinstance(support, str) else write(support)
    run = simulate(
        *('--open-loop', '--theta0-deg', 20, '--d0-mm', 2, '--mu-c', mu_c),
        *('--support', support, '--steps', 20),
    )

    expected = pushed_by_euler(math.radians(20.0), 0.002, mu_c, c, 0.02375, 20, 300)
    assert run['c'] == pytest.approx(c, rel=1e-12)
    assert run['theta'] == pytest.approx(expected, abs=1e-5)
    assert abs(expected[-1] - expected[0]) > 0.01


def test_the_contact_slips_where_the_friction_is_too_small(simulate):
    start = ('--open-loop', '--theta0-deg', 20, '--d0-mm', 0, '--steps', 5)

    # The finger moves up, the edge leans to the left: the finger slips to the right.
    assert set(simulate(*start, '--mu-c', 0.05)['mode']) == {'slip_right'}
    assert set(simulate(*start, '--mu-c', 'inf')['mode']) == {'stick'}
    mirrored = ('--open-loop', '--theta0-deg', -20, '--d0-mm', 0, '--steps', 5)
    assert set(simulate(*mirrored, '--mu-c', 0.05)['mode']) == {'slip_left'}


def test_a_run_without_friction_ends_with_a_push_along_the_normal_through_the_centre(simulate):
    # IV: the only possible translation is along the contact normal.
    run = simulate('--mu-c', 0, '--steps', 1500)

    assert 'stick' not in run['mode'][:-500]
    assert math.degrees(run['phi'][-1] - run['theta'][-1]) == pytest.approx(90.0, abs=0.01)
    assert run['d'][-1] == pytest.approx(0.0, abs=1e-5)
    assert math.degrees(run['theta'][-1]) == pytest.approx(-10.0, abs=0.01)


def test_a_disk_without_friction_is_pushed_aside_as_the_closed_form_says(simulate):
    # The force goes through the centre, so the disk moves along the normal and never turns; the
    # angle of the tangent grows by sin(theta) / (R + r) for every length of the push.
    run = simulate(
        *('--object', 'disk', '--mu-c', 0, '--open-loop', '--theta0-deg', 5, '--steps', 200)
    )

    length = LENGTH * np.arange(201)
    expected = 2.0 * np.arctan(math.tan(math.radians(2.5)) * np.exp(length / (0.0285 + R)))
    assert run['theta'] == pytest.approx(expected, abs=1e-6)
    assert np.hypot(run['x'], run['y'] - length) == pytest.approx(0.0285 + R, abs=1e-12)
    assert run['d'] == pytest.approx(0.0, abs=1e-12)


# Objects and supports


def test_the_supports_of_the_block_have_the_ratios_of_the_paper(simulate):
    # V.B: 3.45, 1.87, 0.67 cm.
    ratio = {
        support: simulate('--support', support, '--steps', 0)['c']
        for support in ('corners', 'uniform', 'circle:0.01', 'rim')
    }
    x, y = np.meshgrid((np.arange(500) + 0.5) / 500 - 0.5, (np.arange(500) + 0.5) / 500 - 0.5)
    on_rim = (np.arange(5000) + 0.5) / 5000 - 0.5
    rim = 0.05 * np.hypot(0.05 * on_rim, 0.02375) + 0.0475 * np.hypot(0.0475 * on_rim, 0.025)

    assert ratio['corners'] == pytest.approx(math.hypot(0.025, 0.02375), rel=1e-12)
    assert ratio['corners'] == pytest.approx(0.0345, abs=5e-5)
    assert ratio['uniform'] == pytest.approx(np.hypot(0.05 * x, 0.0475 * y).mean(), rel=1e-5)
    assert ratio['uniform'] == pytest.approx(0.0187, abs=5e-5)
    assert ratio['circle:0.01'] == pytest.approx(0.02 / 3.0, rel=1e-12)
    assert ratio['circle:0.01'] == pytest.approx(0.0067, abs=5e-5)
    assert ratio['rim'] == pytest.approx(rim.mean() / 0.0975, rel=1e-6)


def test_the_disk_has_the_radius_of_the_paper(simulate):
    # V.C: 2.85 cm; uniform pressure gives 2/3 of it, the rim all.
    run = simulate('--object', 'disk', '--steps', 5, '--theta0-deg', 0)

    assert run['c'] == pytest.approx(0.019, rel=1e-12)
    assert run['x'][0] == pytest.approx(0.0, abs=1e-15)
    assert run['y'][0] == pytest.approx(0.0285 + R, rel=1e-12)
    assert simulate('--object', 'disk', '--support', 'rim', '--steps', 0)['c'] == pytest.approx(
        0.0285, rel=1e-12
    )


def test_the_law_turns_the_disk(simulate):
    run = simulate('--object', 'disk', '--theta-desired-deg', 0, '--steps', 600)

    assert run['settle_step'] is not None
    assert math.degrees(run['theta'][-1]) == pytest.approx(0.0, abs=0.1)


@pytest.mark.parametrize('surface', ['ellipsoid', 'exact'])
@pytest.mark.parametrize('shift', [(0.0, 0.0), (0.3, -0.2)])
def test_a_file_of_the_block_is_the_block(simulate, write, surface, shift):
    # Wherever the file has its origin.
    block = write(polygon((np.array(BLOCK) + shift).tolist()))
    options = ('--support', 'corners', '--surface', surface, '--mu-c', 0.4, '--steps', 60)

    run = simulate('--object', block, '--d0-mm', -6, *options)

    paper = simulate(*options)
    assert run['c'] == pytest.approx(paper['c'], rel=1e-12)
    assert (run['mode'] == paper['mode']).all()
    for key in KEYS[:-1]:
        assert run[key] == pytest.approx(paper[key], abs=1e-7)


def test_the_first_edge_of_a_file_is_pushed(simulate, write):
    # The 4.75 cm edge first: l is 2.5 cm.
    run = simulate('--object', write(polygon(BLOCK[1:] + BLOCK[:1])), '--steps', 10)

    x_c, y_c = contact_offset(run)
    assert x_c == pytest.approx(run['d'], abs=1e-12)
    assert y_c == pytest.approx(-0.025, abs=1e-12)


@pytest.mark.parametrize(
    'outline',
    [
        {'kind': 'circle', 'radius': 0.0285},
        {'kind': 'ellipse', 'semi_axes': [0.0285, 0.0285]},
        {
            'kind': 'smooth',
            'points': [
                [0.0285 * math.sin(angle), -0.0285 * math.cos(angle)]
                for angle in np.linspace(0.0, 2.0 * math.pi, 60, endpoint=False)
            ],
        },
    ],
    ids=['circle', 'ellipse', 'smooth'],
)
def test_every_outline_of_a_circle_moves_as_the_disk(simulate, write, outline):
    run = simulate('--object', write({'outline': outline}), '--mu-c', 0.3, '--steps', 60)

    paper = simulate('--object', 'disk', '--mu-c', 0.3, '--steps', 60)
    assert run['c'] == pytest.approx(paper['c'], rel=1e-6)
    for key in KEYS[:-1]:
        assert run[key] == pytest.approx(paper[key], abs=1e-6)


def test_the_finger_stays_on_an_ellipse(simulate, write):
    a, b = 0.04, 0.025
    ellipse = write({'outline': {'kind': 'ellipse', 'semi_axes': [a, b]}})

    run = simulate('--object', ellipse, '--mu-c', 0.1, '--open-loop', '--steps', 150)

    x_c, y_c = contact_offset(run)
    assert (x_c[0], y_c[0]) == pytest.approx((0.0, -b), abs=1e-9)  # the lowest point first
    assert np.abs(x_c).max() > 0.005
    assert run['d'] == pytest.approx(x_c, abs=1e-9)
    # A tangent at the distance h = (a^2 sin^2 + b^2 cos^2)^(1/2) touches at its derivative d, so
    # (h d)^2 = (h^2 - b^2) (a^2 - h^2).
    h = -y_c
    assert h * np.abs(x_c) == pytest.approx(
        np.sqrt(np.maximum(h**2 - b**2, 0.0) * (a**2 - h**2)), abs=1e-7
    )


def test_a_circle_of_support_lies_about_the_centre_of_mass_of_the_file(simulate, write):
    x, y = 0.004, -0.003
    block = write(polygon(BLOCK, centre_of_mass=[x, y]))
    options = ('--support', 'circle:0.01', '--steps', 30)

    run = simulate('--object', block, '--d0-mm', 2, *options)

    assert run['c'] == pytest.approx(0.02 / 3.0, rel=1e-12)
    x_c, y_c = contact_offset(run)
    assert x_c == pytest.approx(run['d'], abs=1e-12)
    assert y_c == pytest.approx(-0.02375 - y, abs=1e-12)
    # d counts from the point below the centre of mass: the edge goes from -29 to 21 mm.
    assert simulate('--object', block, '--d0-mm', -29, *options)['d'][0] == pytest.approx(-0.029)


@pytest.mark.parametrize(
    ('support', 'c'),
    [
        # By levers the legs bear 1/8, 3/8 and 1/2 of the weight.
        (
            {'points': TRIPOD['points']},
            math.hypot(0.025, 0.02) / 8.0
            + math.hypot(0.015, 0.02) * 3.0 / 8.0
            + math.hypot(0.005, 0.02) / 2.0,
        ),
        # Springs on the corners bear 1/4 + x 0.005/0.05^2.
        (
            'corners',
            2.0 * math.hypot(0.03, 0.02375) * 0.2 + 2.0 * math.hypot(0.02, 0.02375) * 0.3,
        ),
    ],
)
def test_the_weight_decides_on_loads_that_are_not_given(simulate, write, support, c):
    if isinstance(support, dict):
        support = write(support, 'support.json')

    run = simulate(
        *('--object', write(polygon(BLOCK, centre_of_mass=[0.005, 0.0]))),
        *('--support', support, '--steps', 3, '--d0-mm', 0),
    )

    assert run['c'] == pytest.approx(c, rel=1e-9)
    assert contact_offset(run)[1] == pytest.approx(-0.02375, abs=1e-12)


def test_loads_that_do_not_carry_the_weight_are_refused(refused, write):
    line = refused(
        *('--object', write(polygon(BLOCK, centre_of_mass=[0.005, 0.0]))),
        *('--support', write(TRIPOD, 'support.json')),
    )

    assert 'support: expected loads that carry a weight at (0.005, 0.0) m, got loads about ' in line


@pytest.mark.parametrize('surface', ['ellipsoid', 'exact'])
def test_a_support_with_loads_puts_the_centre_of_friction_in_their_mean(simulate, write, surface):
    run = simulate(*('--support', write(TRIPOD), '--surface', surface, '--d0-mm', 3, '--steps', 20))

    points, loads = np.array(TRIPOD['points']), np.array(TRIPOD['loads'])
    centre = loads @ points / loads.sum()
    assert run['c'] == pytest.approx(loads @ np.hypot(*(points - centre).T) / loads.sum())
    x_c, y_c = contact_offset(run)
    assert run['d'][0] == pytest.approx(0.003)
    assert x_c == pytest.approx(run['d'], abs=1e-12)
    assert y_c == pytest.approx(-0.02375 - centre[1], abs=1e-12)


def test_a_file_starts_at_the_contact_nearest_to_the_centre_of_mass(simulate, write):
    # The foot of the centroid (0.02, 0.01) on the first edge lies 1 cm beyond its end.
    leaning = write(polygon([[0, 0], [0.01, 0], [0.05, 0.03]]))

    assert simulate('--object', leaning, '--steps', 0)['d'][0] == pytest.approx(-0.01, abs=1e-12)
    run = simulate('--object', write(polygon(SMALL)), '--steps', 0)
    assert run['d'][0] == pytest.approx(0.0, abs=1e-12)


# Limit surfaces


def test_both_surfaces_agree_on_a_translation(simulate):
    options = ('--theta0-deg', 0, '--d0-mm', 0, '--open-loop', '--steps', 40)
    for support in ('corners', 'uniform', 'circle:0.01', 'rim'):
        for surface in ('ellipsoid', 'exact'):
            run = simulate(*options, '--support', support, '--surface', surface)
            # The ray of pushing goes through the centre of friction (II.A).
            assert run['theta'] == pytest.approx(0.0, abs=1e-9)
            assert run['x'] == pytest.approx(0.0, abs=1e-9)
            assert np.diff(run['y']) == pytest.approx(LENGTH, abs=1e-9)


def test_surfaces_differ_in_the_motion_but_not_in_the_sense_of_rotation(simulate):
    options = ('--support', 'corners', '--open-loop', '--mu-c', 0.3, '--steps', 30)

    runs = [simulate(*options, '--surface', surface) for surface in ('ellipsoid', 'exact')]

    assert runs[0]['c'] == runs[1]['c']
    assert abs(runs[0]['theta'][-1] - runs[1]['theta'][-1]) > math.radians(0.1)
    for run in runs:
        turns = np.diff(run['theta'])
        assert (turns < 0.0).all() or (turns > 0.0).all()
    assert np.sign(runs[0]['theta'][1] - runs[0]['theta'][0]) == np.sign(
        runs[1]['theta'][1] - runs[1]['theta'][0]
    )


def test_the_exact_surface_dissipates_least(simulate, write):
    # Among all motions that move the contact as the finger, found by a search in thirds.
    points, loads = np.array(TRIPOD['points']), np.array(TRIPOD['loads'])
    centre = loads @ points / loads.sum()
    theta, d, l, parts = 0.0, -0.005, 0.02375 + centre[1], 20
    run = simulate(
        *('--support', write(TRIPOD), '--surface', 'exact', '--open-loop', '--theta0-deg', 0),
        *('--d0-mm', 1000.0 * d, '--steps', 3),
    )

    def power(omega):
        # In the object's frame: velocity of the contact and of the support relative to it.
        v_x = math.sin(theta) - omega * (points[:, 1] - centre[1] + l)
        v_y = math.cos(theta) + omega * (points[:, 0] - centre[0] - d)
        return loads @ np.hypot(v_x, v_y)

    expected = [theta]
    for _ in range(3):
        for _ in range(parts):
            lower, upper = -1000.0, 1000.0
            for _ in range(90):
                third = (upper - lower) / 3.0
                if power(lower + third) < power(upper - third):
                    upper -= third
                else:
                    lower += third
            omega = (lower + upper) / 2.0
            theta += omega * LENGTH / parts
            d -= omega * R * LENGTH / parts
        expected.append(theta)
    assert set(run['mode']) == {'stick'}
    assert run['theta'] == pytest.approx(expected, abs=3e-4 * abs(expected[-1]))


@pytest.mark.parametrize('surface', ['ellipsoid', 'exact'])
@pytest.mark.parametrize('d', [-5, 5])
@pytest.mark.parametrize('mu_c', [0, 'inf'])
@pytest.mark.parametrize('support', ['corners', 'circle:0.01'])
def test_pushes_of_figure_7_turn_as_the_voting_theorem_says(simulate, support, mu_c, d, surface):
    run = simulate(
        *('--open-loop', '--theta0-deg', 0, '--d0-mm', d, '--phi0-deg', 90, '--mu-c', mu_c),
        *('--support', support, '--surface', surface, '--steps', 40),
    )

    alpha = math.atan(float(mu_c))
    for k in range(40):
        along, out = run['d'][k], -0.02375
        assert abs(along) < 0.025
        # Rays at the contact, in the frame of the edge, and the side on which they pass the CM.
        rays = [math.pi / 2.0 + alpha, math.pi / 2.0 - alpha, run['phi'][k] - run['theta'][k]]
        votes = [np.sign(math.cos(ray) * -out - math.sin(ray) * -along) for ray in rays]
        assert np.sign(run['theta'][k + 1] - run['theta'][k]) == np.sign(sum(votes)) != 0.0


def test_mirror_images_move_as_mirror_images(simulate):
    options = ('--open-loop', '--mu-c', 0.3, '--steps', 80)

    run = simulate('--theta0-deg', 15, '--d0-mm', 4, '--phi0-deg', 80, *options)

    mirrored = simulate('--theta0-deg', -15, '--d0-mm', -4, '--phi0-deg', 100, *options)
    for key in ('theta', 'd', 'x'):
        assert mirrored[key] == pytest.approx(-run[key], abs=1e-7)
    assert mirrored['y'] == pytest.approx(run['y'], abs=1e-7)
    swapped = {'slip_left': 'slip_right', 'slip_right': 'slip_left'}
    assert [swapped.get(mode, mode) for mode in run['mode']] == list(mirrored['mode'])


# Contact lost


LOST = ('--open-loop', '--theta0-deg', 0, '--d0-mm', 4, '--mu-c', 0, '--steps', 300)


def test_a_lost_contact_ends_the_run_with_a_reason_and_status_1(command, write):
    # The finger slips off a small triangle's corner.
    status, out, err = command('--object', write(polygon(SMALL)), *LOST, '--json', '-')

    assert status == 1
    assert err.count('\n') == 1
    assert 'lost' in err
    run = strict(out)
    lengths = {len(run[key]) for key in KEYS}
    assert len(lengths) == 1
    count = lengths.pop()
    assert 10 < count < 300
    assert f'step {count - 1}' in err
    assert run['settle_step'] is None
    assert 'lost' in run['end']
    # To the last the finger touches the object, never more than its size away from the centre.
    x_f, y_f = finger({key: np.array(run[key]) for key in KEYS})
    assert (np.hypot(x_f - run['x'], y_f - run['y']) <= R + 0.0067).all()
    assert (np.hypot(x_f - run['x'], y_f - run['y']) >= R + 0.0029).all()


def test_a_lost_object_has_not_settled(simulate, write):
    triangle = write(polygon(SMALL))
    last = simulate('--object', triangle, *LOST, status=1)['theta'][-1]

    run = simulate(
        *('--object', triangle, *LOST, '--theta-desired-deg', math.degrees(last)), status=1
    )

    assert run['settle_step'] is None


def test_a_lost_contact_is_told_beside_the_summary(command, write):
    status, out, err = command('--object', write(polygon(SMALL)), *LOST)

    assert status == 1
    assert 'never' in out
    assert err.count('\n') == 1


# Output


def test_the_summary_says_what_the_json_says(command, simulate):
    options = ('--support', 'corners', '--mu-c', 0.4, '--steps', 500)
    status, out, err = command(*options)
    run = simulate(*options)

    assert (status, err) == (0, '')
    lines = {line.split()[0]: line for line in out.splitlines()}
    assert f'{1000.0 * run["c"]:.2f} mm' in lines['c']
    assert f'step {run["settle_step"]}' in lines['settled']
    for key in ('theta', 'phi'):
        assert (
            f'{math.degrees(run[key][0]):.2f}° -> {math.degrees(run[key][-1]):.2f}°' in lines[key]
        )
    assert f'{1000.0 * run["d"][-1]:.3f} mm' in lines['d']
    for mode in set(run['mode'][:-1]):
        assert f'{mode} {(run["mode"][:-1] == mode).sum()}' in lines['steps']


def test_json_goes_to_a_file_beside_the_summary(command, tmp_path):
    file = tmp_path / 'run.json'

    status, out, err = command('--steps', 7, '--json', file)

    assert (status, err) == (0, '')
    assert out.startswith('c ')
    printed = command('--steps', 7, '--json', '-')[1]
    assert strict(file.read_text()) == strict(printed)


@pytest.mark.parametrize('ending', ['png', 'PNG', 'svg', 'pdf'])
def test_the_plot_is_of_the_format_of_its_ending(command, tmp_path, ending):
    file = tmp_path / f'run.{ending}'

    status, _, err = command('--steps', 20, '--plot', file)

    assert (status, err) == (0, '')
    assert os.listdir(tmp_path) == [file.name]
    if ending.lower() == 'png':
        height, width = matplotlib.image.imread(file, 'png').shape[:2]
        assert min(height, width) > 200
    elif ending == 'svg':
        assert ElementTree.parse(file).getroot().tag == '{http://www.w3.org/2000/svg}svg'
    else:
        assert file.read_bytes().startswith(b'%PDF-')


@pytest.mark.parametrize('steps', [0, 1])
def test_the_shortest_runs_can_be_drawn(command, tmp_path, steps):
    status, _, err = command('--steps', steps, '--plot', tmp_path / 'run.png')

    assert (status, err) == (0, '')
    assert (tmp_path / 'run.png').stat().st_size > 1000


def test_a_run_that_lost_the_object_is_drawn_all_the_same(command, write, tmp_path):
    file = tmp_path / 'run.svg'

    assert command('--object', write(polygon(SMALL)), *LOST, '--plot', file)[0] == 1
    assert ElementTree.parse(file).getroot().tag.endswith('svg')


def test_the_help_has_every_option(command):
    status, out, _ = command('--help')

    assert status == 0
    for option in (
        *('object', 'support', 'surface', 'mu-c', 'kp', 'kd', 'theta0-deg', 'd0-mm', 'phi0-deg'),
        *('theta-desired-deg', 'steps', 'open-loop', 'json', 'plot'),
    ):
        assert f'--{option} ' in out.replace('\n', ' ')


def in_a_shell(*arguments):
    return subprocess.run(
        [sys.executable, '-m', 'tactile_push.cli', 'simulate', *arguments],
        capture_output=True,
        text=True,
        timeout=300,
    )


@pytest.mark.slow
def test_the_command_prints_json_in_a_process_of_its_own(simulate):
    done = in_a_shell('--steps', '12', '--json', '-')

    assert (done.returncode, done.stderr) == (0, '')
    assert strict(done.stdout)['theta'] == pytest.approx(simulate('--steps', 12)['theta'])


@pytest.mark.slow
def test_the_command_refuses_a_missing_file_in_a_process_of_its_own(tmp_path):
    done = in_a_shell('--object', str(tmp_path / 'nothing.json'))

    assert (done.returncode, done.stdout) == (2, '')
    assert done.stderr.count('\n') == 1
    assert 'nothing.json' in done.stderr
    assert 'Traceback' not in done.stderr


# Bad input


@pytest.fixture
def refused(command):
    """Return a function that runs a command which must fail in one line, and gives the line."""

    def run(*arguments):
        status, out, err = command(*arguments)
        assert (status, out) == (2, ''), (out, err)
        assert err.endswith('\n')
        assert err.count('\n') == 1, err
        assert err.startswith('tactile_push simulate: ')
        return err

    return run


@pytest.mark.parametrize(
    ('option', 'value'),
    [
        ('mu-c', '-1'),
        ('mu-c', 'nan'),
        ('mu-c', '-inf'),
        ('mu-c', 'low'),
        ('kp', '-0.1'),
        ('kp', 'nan'),
        ('kp', 'inf'),
        ('kd', '-5'),
        ('kd', 'inf'),
        ('theta0-deg', '90'),
        ('theta0-deg', '-90'),
        ('theta0-deg', 'nan'),
        ('theta0-deg', '120'),
        ('d0-mm', 'nan'),
        ('d0-mm', 'inf'),
        ('d0-mm', 'left'),
        ('phi0-deg', '0'),
        ('phi0-deg', '180'),
        ('phi0-deg', '-20'),
        ('phi0-deg', 'nan'),
        ('theta-desired-deg', 'nan'),
        ('theta-desired-deg', '1000'),
        ('steps', '-1'),
        ('steps', '1.5'),
        ('steps', '1e12'),
        ('steps', '1000000000000'),
        ('steps', 'ten'),
        ('steps', '9' * 5000),
    ],
    ids=lambda value: value[:20],
)
def test_a_value_out_of_range_is_refused(refused, option, value):
    line = refused(f'--{option}={value}')

    assert f'--{option}: expected ' in line
    assert value in line


def test_an_unknown_surface_is_refused(refused):
    line = refused('--surface', 'sphere')

    assert '--surface' in line
    assert all(word in line for word in ("'sphere'", 'ellipsoid', 'exact'))


@pytest.mark.parametrize('d', [25.001, -25.001, 40, 1e300])
def test_a_contact_off_the_edge_is_refused(refused, d):
    line = refused('--d0-mm', d)

    assert 'd: expected' in line or '--d0-mm' in line
    assert '-0.025' in line or '-25' in line
    assert str(d) in line or str(d / 1000.0) in line


def test_a_contact_beside_a_disk_at_its_tangent_is_refused(refused):
    assert 'd: expected' in refused('--object', 'disk', '--d0-mm', 1)


def names_angle(line, degrees):
    """Tell whether a message has an angle, in degrees or in radians."""
    numbers = [float(number) for number in re.findall(r'-?\d+\.?\d*', line)]
    return any(
        math.isclose(number, angle, rel_tol=1e-9)
        for number in numbers
        for angle in (degrees, math.radians(degrees))
    )


@pytest.mark.parametrize(
    ('theta', 'phi'), [(60, 33), (60, 60), (60, 59.99), (-60, 120), (-60, 120.01), (-40, 147)]
)
@pytest.mark.parametrize('how', [(), ('--open-loop',)])
def test_a_first_push_away_from_the_object_is_refused(refused, theta, phi, how):
    line = refused('--theta0-deg', theta, '--phi0-deg', phi, *how)

    assert 'phi: expected' in line or '--phi0-deg' in line
    assert 'towards the object' in line
    assert names_angle(line, phi)


@pytest.mark.parametrize('phi', [20, 32.9, 147.1, 160])
def test_a_first_push_beyond_the_bounds_of_the_law_is_refused(refused, phi):
    line = refused('--phi0-deg', phi, '--theta0-deg', 0)

    assert 'phi: expected' in line or '--phi0-deg' in line
    assert names_angle(line, phi)


@pytest.mark.parametrize(
    ('content', 'words'),
    [
        pytest.param(
            polygon([[0, 0], [0.04, 0], [0.01, 0.01], [0, 0.04]]),
            ('vertices: ', 'convex', '[0.01, 0.01]'),
            id='not convex',
        ),
        pytest.param(
            polygon([[0, 0], [0.04, 0.04], [0.04, 0], [0, 0.04]]),
            ('vertices: ', 'does not cross itself', '[0.04, 0.04]'),
            id='crossing itself',
        ),
        pytest.param(
            polygon([[0, 0], [0.01, 0]]), ('vertices: ', 'three', '[0.01, 0.0]'), id='two points'
        ),
        pytest.param(polygon(None), ('vertices: ',), id='null'),
        pytest.param(polygon([[0, 0], [None, 0], [0, 0.01]]), ('vertices: ',), id='nested null'),
        pytest.param(
            polygon([['0', '0'], ['0.01', '0'], ['0', '0.01']]), ('vertices: ',), id='text'
        ),
        pytest.param(polygon([[0, 0], [10**400, 0], [0, 1]]), ('vertices: ',), id='beyond floats'),
        pytest.param(polygon([[0, 0], [1e308, 0], [0, 1e308]]), (), id='too big'),
        pytest.param(polygon([[0, 0], [1e-300, 0], [0, 1e-300]]), (), id='too small'),
        pytest.param({'outline': {'kind': 'polygon'}}, ('vertices', 'polygon'), id='no vertices'),
        pytest.param({'outline': {'kind': 'hexagon'}}, ('kind', 'hexagon'), id='wrong kind'),
        pytest.param({'outline': {'kind': ['polygon']}}, ('kind', 'polygon'), id='list of kinds'),
        pytest.param({'outline': BLOCK}, ('outline: ', 'kind'), id='list for an outline'),
        pytest.param({'vertices': BLOCK}, ('outline: ',), id='no outline'),
        pytest.param(BLOCK, ('list',), id='list'),
        pytest.param(None, ('JSON object',), id='nothing'),
        pytest.param(
            {'outline': {'kind': 'circle', 'radius': -1}}, ('radius: ', '-1'), id='negative radius'
        ),
        pytest.param(
            {'outline': {'kind': 'circle', 'radius': '0.03'}},
            ('radius: ', '0.03'),
            id='text radius',
        ),
        pytest.param(
            {'outline': {'kind': 'ellipse', 'semi_axes': [0.03]}},
            ('semi_axes',),
            id='one half axis',
        ),
        pytest.param(
            polygon(BLOCK, centre_of_mass=[0.0]), ('centre_of_mass: ',), id='half a centre of mass'
        ),
        pytest.param(
            polygon(BLOCK, centre_of_mass=[math.nan, 0.0]), ('centre_of_mass: ', 'nan'), id='NaN'
        ),
        pytest.param(
            polygon(BLOCK, centre_of_mass=[0.03, 0.0]),
            ('centre_of_mass: ', '0.03'),
            id='centre of mass beside the object',
        ),
    ],
)
def test_a_wrong_object_is_refused(refused, write, content, words):
    file = write(content)

    line = refused('--object', file)

    assert 'expected ' in line
    for word in words:
        assert word in line.replace(file, 'FILE')


@pytest.mark.parametrize(
    ('content', 'words'),
    [
        pytest.param(
            {'points': BLOCK, 'loads': [1, 1, -1, 1]}, ('loads: ', '-1'), id='negative load'
        ),
        pytest.param(
            {'points': BLOCK, 'loads': [1, 1, math.nan, 1]}, ('loads: ', 'nan'), id='NaN load'
        ),
        pytest.param({'points': BLOCK, 'loads': [0, 0, 0, 0]}, ('loads: ',), id='no load'),
        pytest.param({'points': BLOCK, 'loads': [1, 1]}, ('loads: ', '[1, 1]'), id='few loads'),
        pytest.param({'points': BLOCK, 'loads': ['1'] * 4}, ('loads: ',), id='text loads'),
        pytest.param({'points': BLOCK, 'loads': [1e308] * 4}, (), id='loads beyond floats'),
        pytest.param(
            {'points': [[0.1, 0.0], [0.0, 0.0], [0.0, 0.01]]},
            ('support: ', 'under the object', '0.1'),
            id='point outside',
        ),
        pytest.param(
            {'points': [[0.0, 0.0251], [0.0, 0.0], [0.01, 0.0]]},
            ('support: ', 'under the object', '0.0251'),
            id='point a millimetre outside',
        ),
        pytest.param({'points': [[0.0, 0.0]]}, ('support: ', 'place'), id='one point'),
        pytest.param({'points': [[0.01, 0.01]] * 3}, ('support: ', 'place'), id='all at one point'),
        pytest.param(
            {'points': BLOCK, 'loads': [0, 0, 1, 0]}, ('support: ', 'place'), id='all on one point'
        ),
        pytest.param({'points': []}, ('points: ', '[]'), id='no points'),
        pytest.param({'points': None}, ('points: ', 'None'), id='null'),
        pytest.param({'points': [[None, None]]}, ('points: ',), id='nested nulls'),
        pytest.param(
            {'points': [['0.01', '0'], ['0', '0'], ['0', '0.01']]}, ('points: ',), id='text'
        ),
        pytest.param({'points': [[0, 0], [0.01]]}, ('points: ',), id='ragged'),
        pytest.param({'loads': [1.0]}, ('points',), id='loads alone'),
        pytest.param([[0, 0], [0, 0.01]], ('list',), id='list'),
    ],
)
def test_a_wrong_support_is_refused(refused, write, content, words):
    file = write(content)

    line = refused('--support', file)

    assert 'expected ' in line
    for word in words:
        assert word in line.replace(file, 'FILE')


@pytest.mark.parametrize(('centre', 'side'), [([0.0, 0.015], 90), ([0.015, 0.0], 45)])
def test_an_object_that_would_tip_over_is_refused(refused, write, centre, side):
    points = [[-0.01, 0.0], [0.01, 0.0], [0.0, 0.01]]

    line = refused(
        *('--object', write(polygon(BLOCK, centre_of_mass=centre))),
        *('--support', write({'points': points}, 'support.json')),
    )

    assert 'centre_of_mass: ' in line
    assert f'{centre[0]}, {centre[1]}' in line
    # Seen from the centre of mass all support lies away from the side that is named.
    named = math.radians(float(line.split(' at ')[1].split(' ')[0]))
    offset = np.array(points) - centre
    assert (offset @ [math.cos(named), math.sin(named)] < 0.0).all()


@pytest.mark.parametrize(
    'radius', ['-1', '0', 'nan', 'inf', '', 'wide', '1e-320', '1', '0.03', '0.025', '0.024']
)
@pytest.mark.parametrize('surface', ['ellipsoid', 'exact'])
def test_a_circle_of_support_that_is_none_or_larger_than_the_object_is_refused(
    refused, radius, surface
):
    # The block is 4.75 cm deep: a radius of more than 2.375 cm has load beside it.
    line = refused('--support', f'circle:{radius}', '--surface', surface)

    assert 'support: ' in line or 'radius: ' in line
    assert 'expected ' in line


@pytest.mark.parametrize('radius', [0.0286, 0.03])
def test_a_circle_of_support_larger_than_the_disk_is_refused(refused, radius):
    assert 'support: ' in refused('--object', 'disk', '--support', f'circle:{radius}')


def test_corners_of_an_object_without_corners_are_refused(refused):
    line = refused('--object', 'disk', '--support', 'corners')

    assert 'polygon' in line
    assert 'corners' in line


@pytest.mark.parametrize('option', ['object', 'support'])
@pytest.mark.parametrize(
    'content',
    [
        pytest.param(b'', id='empty'),
        pytest.param(b'{"outline": ', id='cut off'),
        pytest.param(bytes(range(256)), id='binary'),
        pytest.param(b'[' * 100_000, id='nested without end'),
    ],
)
def test_a_file_that_is_no_json_is_refused(refused, tmp_path, option, content):
    file = tmp_path / 'thing.json'
    file.write_bytes(content)

    line = refused(f'--{option}', file)

    assert str(file) in line
    assert 'expected JSON' in line


@pytest.mark.parametrize('option', ['object', 'support'])
@pytest.mark.parametrize('name', ['nothing.json', 'Corners', 'folder', 'folder/deep/x.json'])
def test_a_file_that_cannot_be_read_is_refused_with_its_option(refused, tmp_path, option, name):
    (tmp_path / 'folder').mkdir()

    line = refused(f'--{option}', tmp_path / name)

    assert str(tmp_path / name) in line
    assert f'{option}: ' in line


@pytest.mark.parametrize('option', ['json', 'plot'])
@pytest.mark.parametrize('name', ['nowhere/run.png', 'folder.png', 'file.png/run.png'])
def test_a_path_that_cannot_be_written_is_refused_with_its_option(refused, tmp_path, option, name):
    (tmp_path / 'folder.png').mkdir()
    (tmp_path / 'file.png').touch()

    line = refused(f'--{option}', tmp_path / name, '--steps', 3)

    assert str(tmp_path / name) in line
    assert f'--{option}: ' in line


@pytest.mark.skipif(not os.path.exists('/dev/full'), reason='there is no /dev/full')
def test_a_full_disk_is_told_with_the_file(refused):
    assert '/dev/full' in refused('--json', '/dev/full', '--steps', 3)


@pytest.mark.parametrize('name', ['run.foo', 'run.json', 'run', 'run.', 'folder', '.png'])
def test_a_plot_of_no_known_format_is_refused_before_anything_is_written(refused, tmp_path, name):
    (tmp_path / 'folder').mkdir()

    line = refused(*('--plot', tmp_path / name, '--json', tmp_path / 'run.jsn', '--steps', 3))

    assert '--plot: expected ' in line
    assert str(tmp_path / name) in line
    assert 'png' in line.replace(str(tmp_path / name), '')
    assert 'svg' in line
    assert os.listdir(tmp_path) == ['folder']


def test_a_plot_for_which_something_is_missing_fails_in_one_line(command, tmp_path):
    # PGF needs TeX.
    file = tmp_path / 'run.pgf'

    status, _, err = command('--plot', file, '--steps', 3)

    assert (status == 0 and file.exists()) or (status == 2 and err.count('\n') == 1)


def test_an_object_s_file_may_say_support_and_friction(simulate, write):
    thing = polygon(BLOCK, support=STAR, mu_c=0.2)
    said, asked = write(thing), write(polygon(BLOCK), 'plain.json')
    words = ['--steps', '5']

    found = simulate('--object', said, *words)

    star = write(STAR, 'star.json')
    expected = simulate('--object', asked, '--support', star, '--mu-c', '0.2', *words)
    assert found['c'] == pytest.approx(0.0187)
    assert found['theta'] == pytest.approx(expected['theta'], abs=1e-12)
    other = simulate('--object', said, '--support', 'corners', '--mu-c', 'inf', *words)
    plain = simulate('--object', asked, '--support', 'corners', *words)
    assert other['theta'] == pytest.approx(plain['theta'], abs=1e-12)
    assert (other['c'], plain['c']) == pytest.approx([math.hypot(*BLOCK[0])] * 2)
