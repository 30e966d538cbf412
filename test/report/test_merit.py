# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Figures of merit against histories of which they are known by construction."""

import math

import numpy as np
import pytest

from tactile_push.report.columns import Columns
from tactile_push.report.merit import FIELDS, KNOWN, known_step, push_figures

BAND = 0.05
PERIOD = 0.1
# The numbers that the README gives on push_controller/state.
INACTIVE, WAITING, PUSHING, STOPPED = range(4)
CONTACT_SILENT, WORKSPACE_LIMIT, TICKS_LOST = 1, 3, 5


def figures_of(rows, l=None, pushed=None, drop=(), lever=0.0):
    """Return the figures of states that are given by what is special about them."""
    usual = {
        'theta': 0.0,
        'theta_desired': 0.0,
        'phi': 1.5,
        'v_x': 0.0,
        'silence': 0.0,
        'saturated': 0.0,
        'limited': 0.0,
        'state': PUSHING,
        'stop_reason': 0,
        'ticks_lost': 0,
    }
    states = Columns()
    for k, row in enumerate(rows):
        values = {**usual, 'ticks': k + 1, **row}
        kept = {name: float(value) for name, value in values.items() if name not in drop}
        states.add(k * PERIOD, {'stamp': 1000.0 + k * PERIOD, **kept})
    return push_figures(states.table(), BAND, l, pushed, lever)


def columns(**values):
    """Return rows of columns."""
    return [dict(zip(values, row, strict=True)) for row in zip(*values.values(), strict=True)]


def test_steps_are_the_states_in_which_the_law_acts():
    rows = [{'state': state} for state in (WAITING, WAITING, PUSHING, STOPPED, PUSHING, INACTIVE)]
    figures = figures_of(rows)
    assert (figures.states, figures.steps) == (6, 2)


def test_a_tip_that_turns_as_it_moves_takes_its_surface_along():
    # The edge is across the belt, and the surface's direction, from the contact to the centre of
    # mass, leads 5 mm back for 20 mm ahead; for each metre the tip turns by -12.5 rad.
    l, d, r, turning, v_y = 0.02, 0.005, 0.0135, -12.5, 0.005
    v_x = -v_y * d / l / (1.0 - r * turning)
    phi = math.atan2(v_y, v_x)
    x = v_x * PERIOD * np.arange(30)
    rows = columns(phi=[phi] * 30, finger_x=x, psi=math.pi / 2.0 + turning * x)

    assert figures_of(rows, l, lever=r).d_range == pytest.approx((d, d))
    straight = -l / math.tan(phi)
    assert figures_of(rows, l).d_range == pytest.approx((straight, straight))  # of the pole
    without = ({**row, 'psi': math.nan} for row in rows)
    assert figures_of(without, l, lever=r).d_range == pytest.approx((straight, straight))
    assert straight < 0.9 * d


def test_settling_counts_steps_not_states():
    theta = [9.0, 0.3, 0.2, 0.01, 0.2, 0.04, -0.04]
    rows = columns(theta=theta, state=[WAITING, *[PUSHING] * 6])
    assert figures_of(rows).settle_step == 4
    assert figures_of(rows[:5]).settle_step is None
    assert figures_of(rows[3:4]).settle_step == 0
    assert figures_of(rows[:1]).settle_step is None


def test_settling_is_around_the_angle_desired_at_the_time():
    rows = columns(theta=[0.0, 0.0, 0.0, 0.4, 0.5], theta_desired=[0.0, 0.0, 0.5, 0.5, 0.5])
    figures = figures_of(rows)
    assert figures.settle_step == 4
    assert (figures.theta_desired, figures.theta_desired_changes) == (0.5, 1)


def test_a_trim_is_no_change_of_the_desired_angle_and_theta_settles_at_the_trimmed_one():
    trims = [0.0, 0.1, 0.2, 0.3, 0.3]
    rows = columns(
        theta=[0.0, 0.1, 0.2, 0.55, 0.8], theta_desired=[0.5 + t for t in trims], trim=trims
    )
    figures = figures_of(rows)
    assert figures.settle_step == 4
    assert figures.theta_desired == pytest.approx(0.5)
    assert figures.theta_desired_changes == 0
    assert figures.trim_range == (0.0, 0.3)


@pytest.mark.parametrize('given', [{}, {'trim': 0.0}])
def test_without_steadying_there_is_no_range_of_a_trim(given):
    assert figures_of([given] * 3).trim_range is None


@pytest.mark.parametrize(
    ('steps', 'first'),
    [(1, 1), (3, 2), (90, 60), (100, 67), (399, 266), (400, 267), (401, 400), (450, 400)],
)
def test_ranges_are_those_after_step_400_or_of_the_last_third(steps, first):
    # Decreasing, so that the first step of the range is the greatest.
    theta = -np.arange(steps) / 1000.0
    phi = 2.0 - np.arange(steps) / 500.0
    figures = figures_of(columns(theta=theta, phi=phi))
    assert figures.ranges_from == first
    if first < steps:
        assert figures.theta_range == (theta[-1], theta[first])
        assert figures.phi_range == (phi[-1], phi[first])
    else:
        assert figures.theta_range is figures.phi_range is None


def test_bounds_on_d_by_17():
    # Straight pushes through the centre of mass: d = 0 if phi - theta is 90 degrees, and
    # d = -l / tan(phi - theta) otherwise.
    beta = np.radians([20.0, 90.0, 135.0, 45.0, 60.0, 190.0])
    figures = figures_of(columns(phi=beta[1:], theta=[0.0] * 5), l=0.02)
    assert figures.ranges_from == 4
    assert figures.d_range is None  # of a finger that moves away from the object
    steps = columns(phi=np.tile(beta[:5] + 0.1, 3), theta=[0.1] * 15)
    figures = figures_of(steps, l=0.02)
    assert figures.ranges_from == 10
    assert figures.d_range == pytest.approx((-0.02 / math.tan(math.radians(20.0)), 0.02))
    assert figures.l == 0.02
    assert figures_of(steps).d_range is None


def test_commands_and_bounds():
    rows = columns(
        v_x=[math.nan, 0.003, -0.001, 0.0, 0.009],
        saturated=[1, 1, 0, 0, 1],
        limited=[1, 0, 1, 1, 0],
        state=[WAITING, PUSHING, PUSHING, PUSHING, STOPPED],
    )
    figures = figures_of(rows)
    assert figures.v_x_range == (-0.001, 0.003)
    assert figures.saturated_share == pytest.approx(1 / 3)
    assert figures.limited_share == pytest.approx(2 / 3)


def test_ticks_of_several_activations_add_up():
    figures = figures_of(columns(ticks=[1, 2, 4, 4, 1, 3, 2], ticks_lost=[0, 0, 1, 1, 0, 1, 0]))
    assert (figures.ticks, figures.ticks_lost) == (4 + 3 + 2, 1 + 1)


def test_longest_silence_is_that_after_the_first_contact():
    states = [WAITING, PUSHING, STOPPED, STOPPED, PUSHING, INACTIVE]
    figures = figures_of(columns(silence=[9.0, 0.1, 0.4, 0.5, 0.0, 7.0], state=states))
    assert (figures.silence, figures.silence_at) == (0.5, 3 * PERIOD)
    assert figures_of([{'state': WAITING}]).silence is None


def test_stops():
    states = [PUSHING, STOPPED, STOPPED, PUSHING, STOPPED, STOPPED, INACTIVE, STOPPED, STOPPED]
    reasons = [0, CONTACT_SILENT, CONTACT_SILENT, 0, WORKSPACE_LIMIT, TICKS_LOST, 0, 77, 77]
    stops = figures_of(columns(state=states, stop_reason=reasons)).stops
    assert [(stop.reason, stop.ended) for stop in stops] == [
        ('contact silent', True),
        ('workspace limit', True),
        ('ticks lost', True),
        ('unknown (77)', False),
    ]
    assert [stop.at for stop in stops] == pytest.approx([0.1, 0.4, 0.5, 0.7])
    assert [stop.duration for stop in stops] == pytest.approx([0.2, 0.1, 0.1, 0.1])


def test_no_stop():
    assert figures_of([{}] * 3).stops == []


@pytest.mark.parametrize('name', FIELDS)
def test_older_bag_without_a_field(name):
    rows = columns(theta=np.linspace(1.0, 0.0, 30), theta_desired=[0.02] * 30)
    figures = figures_of(rows, l=0.02, drop=[name])
    assert figures.missing == (name,)
    assert figures.steps == 30
    expected = {
        'theta': 'theta_range',
        'theta_desired': 'theta_desired',
        'phi': 'phi_range',
        'v_x': 'v_x_range',
        'silence': 'silence',
        'saturated': 'saturated_share',
        'limited': 'limited_share',
        'ticks': 'ticks',
        'ticks_lost': 'ticks_lost',
    }
    missing = {expected[name]} if name in expected else set()
    if name in ('theta', 'phi'):
        missing.add('d_range')
    if name in ('theta', 'theta_desired'):
        missing.add('settle_step')
    values = {key: getattr(figures, key) for key in ('settle_step', *expected.values(), 'd_range')}
    assert {key for key, value in values.items() if value is None} == missing


def test_nothing_at_all():
    figures = figures_of([])
    assert (figures.states, figures.steps, figures.stops) == (0, 0, [])
    assert figures.missing == FIELDS
    assert figures.settle_step is figures.theta_range is figures.paper is None


@pytest.mark.parametrize('settled', [0, 1, 4095, 4096, 4097, 8192, 8999])
def test_figures_of_long_runs(settled):
    count = 9001
    random = np.random.default_rng(settled)
    theta = random.uniform(-0.04, 0.04, count)
    theta[:settled] = random.uniform(-1.0, 1.0, settled)
    if settled:
        theta[settled - 1] = 0.06
    figures = figures_of(columns(theta=theta, phi=theta + 1.5, v_x=theta, saturated=theta > 0))
    assert figures.settle_step == settled
    assert figures.theta_range == (theta[400:].min(), theta[400:].max())
    assert figures.v_x_range == (theta.min(), theta.max())
    assert figures.saturated_share == pytest.approx(np.mean(theta > 0))
    assert figures.steps == count


NARROW, WIDE = KNOWN, 1.01 * KNOWN


@pytest.mark.parametrize(
    ('widths', 'step'),
    [
        ([WIDE, WIDE, NARROW, NARROW], 2),
        ([NARROW, NARROW, NARROW, NARROW], 0),
        ([WIDE, NARROW, WIDE, NARROW], 3),  # what is forgotten was not known for good
        ([NARROW, NARROW, NARROW, WIDE], None),
        ([NARROW, math.nan, NARROW, NARROW], 2),
    ],
)
def test_step_is_the_first_of_those_that_stay_narrow(widths, step):
    times = [0.1, 0.2, 0.3, 0.4]
    assert known_step(times, times, widths) == step


def test_only_steps_of_the_law_count():
    told = [0.1, 0.2, 0.3, 0.4, 0.5]
    widths = [WIDE, NARROW, WIDE, NARROW, WIDE]
    # Between the steps 0.2 and 0.4 the finger was held; after them, too.
    assert known_step([0.1, 0.2, 0.4], told, widths) == 1


def test_of_a_step_without_an_estimate_nothing_is_known():
    assert known_step([0.1, 0.2, 0.3], [0.3], [NARROW]) == 2
    assert known_step([0.1, 0.2, 0.3], [0.1, 0.3], [NARROW, NARROW]) == 2
    assert known_step([0.1, 0.2, 0.3], [], []) is None


def test_last_steps_may_not_be_told_of_yet():
    assert known_step([0.1, 0.2, 0.3], [0.1, 0.2], [WIDE, NARROW]) == 1


def test_without_steps_nothing_is_known():
    assert known_step([], [], []) is None
