# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from support.expected import FIGURE_8_SETTLE_STEP, assert_is_end_of_figure_8, each_step_of_figure_8
from tactile_push.control import AHEAD, CONTACT_SILENT, WAITING, PushLaw, settle_step
from tactile_push.mechanics import FREE, SLIP_LEFT, STICK, Outline, Slider
from tactile_push.simulation import (
    Belt,
    Faults,
    RigConfig,
    Sensor,
    Servo,
    UnevenFriction,
    Workspace,
    experiment,
    paper_block,
    paper_disk,
    rollout,
)

THETA_D = math.radians(-10.0)
QUANTITIES = ('theta', 'phi', 'd', 'x', 'y', 'mode')


def papers_law(theta_desired=THETA_D):
    return PushLaw(0.05, 5.0, theta_desired)


@pytest.fixture(scope='module')
def fig_8():
    """Return the step response of fig. 8 with kp = 0.05 and kd = 5."""
    return experiment(paper_block(), papers_law(), 600)


@each_step_of_figure_8
def test_step_response_of_figure_8_through_sensor_and_finger(fig_8, k, theta, phi):
    assert math.degrees(fig_8.theta[k]) == pytest.approx(theta, abs=0.006)
    assert math.degrees(fig_8.phi[k]) == pytest.approx(phi, abs=0.06)


def test_step_response_settles_and_translates(fig_8):
    assert settle_step(fig_8.theta, THETA_D, math.radians(3.0)) == FIGURE_8_SETTLE_STEP
    assert_is_end_of_figure_8(fig_8.theta[-1], fig_8.phi[-1], fig_8.d[-1])
    assert fig_8.end == 'done'


def test_rows_are_one_more_than_the_steps_and_start_as_configured(fig_8):
    for name in QUANTITIES:
        assert getattr(fig_8, name).shape == (601,)
        assert np.all(np.isfinite(getattr(fig_8, name)))
    assert math.degrees(fig_8.theta[0]) == pytest.approx(20.0)
    assert fig_8.phi[0] == AHEAD
    assert fig_8.d[0] == pytest.approx(-0.006, abs=1e-15)
    # The finger at the origin: CM at (r + l) n - d t.
    sin, cos = math.sin(math.radians(20.0)), math.cos(math.radians(20.0))
    assert fig_8.x[0] == pytest.approx(-0.03725 * sin + 0.006 * cos)
    assert fig_8.y[0] == pytest.approx(0.03725 * cos + 0.006 * sin)
    assert set(fig_8.mode.tolist()) == {STICK}


def test_law_18_links_the_columns(fig_8):
    theta, phi = fig_8.theta, fig_8.phi
    by_law = phi[:-1] + 0.05 * (theta[1:] - THETA_D) + 5.0 * np.diff(theta)
    inside = (by_law > math.radians(33.0)) & (by_law < math.radians(147.0))
    assert inside.sum() > 500
    assert phi[1:][inside] == pytest.approx(by_law[inside], abs=1e-12)
    assert np.all(phi >= math.radians(33.0))
    assert np.all(phi <= math.radians(147.0))


def assert_as_rollout(config, law, steps, **settings):
    found = experiment(config, PushLaw(*law), steps, **settings)
    expected = rollout(config, PushLaw(*law), steps, **settings)
    assert (found.end, expected.end) == ('done', 'done')
    for name in QUANTITIES:
        assert getattr(found, name) == pytest.approx(getattr(expected, name), abs=1e-9), name


@pytest.mark.parametrize('mu_c', [0.0, 0.3, math.inf])
def test_block_goes_as_in_the_rollout_without_sensor_and_finger(mu_c):
    assert_as_rollout(paper_block(mu_c=mu_c), (0.05, 5.0, THETA_D), 300)


@pytest.mark.parametrize('mu_c', [0.0, 0.3, math.inf])
def test_disk_goes_as_in_the_rollout_without_sensor_and_finger(mu_c):
    assert_as_rollout(paper_disk(mu_c=mu_c), (0.05, 5.0, 0.0), 300)


@given(
    theta=st.floats(-0.35, 0.35),
    d=st.floats(-0.015, 0.015),
    theta_desired=st.floats(-0.2, 0.2),
    kp=st.floats(0.0, 0.1),
    kd=st.floats(3.0, 6.0),
    mu_c=st.sampled_from([0.2, math.inf]),
    period=st.sampled_from([0.05, 0.1]),
)
@settings(derandomize=True, deadline=None, max_examples=30)
def test_experiment_is_the_rollout_whatever_the_start_and_the_gains(
    theta, d, theta_desired, kp, kd, mu_c, period
):
    config = paper_block(theta, d, mu_c=mu_c)
    assert_as_rollout(config, (kp, kd, theta_desired), 60, period=period)


def test_lost_contact_ends_the_experiment_with_the_reason():
    slider = Slider(Outline.rectangle(0.004, 0.0475), 0.0187)
    config = RigConfig(slider, 0.0, math.radians(-30.0), 0.0)
    result = experiment(config, PushLaw(0.0, 0.0, 0.0), 200)
    assert result.end == CONTACT_SILENT
    last = len(result.theta) - 1
    assert 2 < last < 100
    for name in QUANTITIES:
        assert getattr(result, name).shape == (last + 1,)
        assert np.all(np.isfinite(getattr(result, name)))
    # The push goes on as it was for 0.3 s after the last contact.
    lost = result.mode.tolist().index(FREE)
    assert last - lost in (2, 3)
    assert set(result.mode[:lost].tolist()) == {SLIP_LEFT}
    assert set(result.mode[lost:].tolist()) == {FREE}
    assert set(result.phi.tolist()) == {AHEAD}


def test_contact_behind_the_hemisphere_ends_the_experiment_but_not_the_rollout():
    # The pole turns clockwise as the finger goes to the right, the edge hardly turns.
    slider = Slider(Outline.rectangle(1.0, 0.0475), 1.0)
    config = RigConfig(slider, 0.0, math.radians(70.0), 0.0)

    to_the_right = math.radians(72.0)
    law = PushLaw(0.0, 0.0, 0.0, phi_max=to_the_right)
    seen, felt = experiment(config, law, 240), rollout(config, to_the_right, 240)
    assert felt.end == 'done'
    assert seen.end != 'done'
    assert 1 < len(seen.theta) < 240
    assert seen.theta == pytest.approx(felt.theta[: len(seen.theta)], abs=1e-9)


def test_no_steps_give_the_start_alone():
    result = experiment(paper_block(), papers_law(), 0)
    assert result.theta == pytest.approx([math.radians(20.0)])
    assert result.mode.tolist() == [FREE]
    assert result.end == 'done'


@pytest.mark.parametrize(
    ('name', 'steps', 'period'),
    [('steps', -1, 0.1), ('period', 1, 0.0), ('period', 1, -0.1), ('period', 1, math.nan)],
)
def test_times_that_are_none_are_refused_by_name(name, steps, period):
    with pytest.raises(ValueError, match=f'^{name}: expected'):
        experiment(paper_block(), papers_law(), steps, period)


HARDWARE = Faults(
    servo=Servo(time_constant=0.1),
    sensor=Sensor(noise=math.radians(0.5), outlier=0.01, dropout=0.01),
)


@pytest.mark.slow
@pytest.mark.parametrize('mu_c', [0.0, 0.1, 0.3, math.inf])
def test_papers_gains_settle_the_block_with_a_lag_noise_outliers_and_dropouts(mu_c):
    for seed in range(25):
        run = experiment(
            paper_block(mu_c=mu_c), papers_law(), 600, faults=HARDWARE, sensor_rate=50.0, seed=seed
        )
        assert run.end == 'done', seed
        # theta as it is, not as it is sensed; without faults it takes 192 steps.
        settled = settle_step(run.theta, THETA_D, math.radians(3.0))
        assert settled is not None, seed
        assert settled <= 230, seed
        assert abs(run.theta[300:].mean() - THETA_D) < math.radians(0.5), seed


EVERYTHING = Faults(
    Servo(0.05, 0.03, 1e-5),
    Workspace(-0.2, 0.2),
    Belt(0.1, 2.0),
    UnevenFriction(0.3, 0.004),
    Sensor(0.01, 0.01, 0.002, 0.03, 0.05, 0.05),
)


def test_same_seed_gives_the_same_run_to_the_bit_and_another_seed_does_not():
    runs = [
        experiment(
            paper_block(mu_c=0.3), papers_law(), 100, faults=EVERYTHING, sensor_rate=50.0, seed=seed
        )
        for seed in (5, 5, 6)
    ]
    for name in QUANTITIES:
        assert np.array_equal(getattr(runs[0], name), getattr(runs[1], name))
    assert not np.array_equal(runs[0].theta, runs[2].theta)


def test_more_readings_a_period_change_nothing_without_faults():
    one = experiment(paper_block(), papers_law(), 200)
    five = experiment(paper_block(), papers_law(), 200, sensor_rate=50.0)
    for name in QUANTITIES:
        assert getattr(five, name) == pytest.approx(getattr(one, name), abs=1e-8), name


def test_latency_of_a_period_lets_the_law_act_on_the_theta_before():
    late = experiment(paper_block(), papers_law(), 200, faults=Faults(sensor=Sensor(latency=0.1)))
    # The first contact comes after a period, in which the belt stands.
    theta, phi = late.theta, late.phi
    felt = np.concatenate([[theta[0], theta[0]], theta[1:-1]])[: len(theta)]
    by_law = phi[:-1] + 0.05 * (felt[1:] - THETA_D) + 5.0 * np.diff(felt)
    inside = (by_law > math.radians(33.0)) & (by_law < math.radians(147.0))
    assert inside.sum() > 150
    # The finger has moved since: its pole has turned a little, and the reading does not know.
    assert np.abs(phi[1:][inside] - by_law[inside]).max() < 0.1
    assert np.abs(theta - experiment(paper_block(), papers_law(), 200).theta).max() > 0.003


def test_sensor_that_feels_nothing_ends_the_run_before_it_began():
    faults = Faults(sensor=Sensor(detectable_range=math.radians(10.0)))
    run = experiment(paper_block(), papers_law(), 100, faults=faults)
    assert run.end == WAITING
    assert len(run.theta) == len(run.mode) == 0


def test_sensor_of_a_limited_range_ends_the_run_where_it_feels_no_more():
    faults = Faults(sensor=Sensor(detectable_range=math.radians(19.0)))
    run = experiment(paper_block(math.radians(0.0)), papers_law(math.radians(40.0)), 500)
    short = experiment(
        paper_block(math.radians(0.0)), papers_law(math.radians(40.0)), 500, faults=faults
    )
    assert run.end == 'done'
    assert short.end == CONTACT_SILENT
    assert 3 < len(short.theta) < 500
    assert short.theta[:-4] == pytest.approx(run.theta[: len(short.theta) - 4], abs=1e-12)


def test_a_lost_reading_lets_the_push_go_on():
    run = experiment(
        paper_block(), papers_law(), 300, faults=Faults(sensor=Sensor(dropout=0.1)), seed=2
    )
    kept = np.diff(run.phi[:150]) == 0.0
    assert run.end == 'done'
    assert 5 < kept.sum() < 30


@pytest.mark.parametrize('rate', [5.0, 25.0, math.nan, -10.0])
def test_readings_that_do_not_fit_into_a_period_are_refused(rate):
    with pytest.raises(ValueError, match='sensor_rate: expected a whole number'):
        experiment(paper_block(), papers_law(), 1, sensor_rate=rate)
