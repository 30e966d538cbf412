# Copyright 2026 The tactile_push authors
#
# Licensed under the Apache License, Version 2.0 (the "License");
# you may not use this file except in compliance with the License.
# You may obtain a copy of the License at
#
#     http://www.apache.org/licenses/LICENSE-2.0
#
# Unless required by applicable law or agreed to in writing, software
# distributed under the License is distributed on an "AS IS" BASIS,
# WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
# See the License for the specific language governing permissions and
# limitations under the License.
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tactile_push.control import AHEAD, PushLaw, settle_step
from tactile_push.mechanics import FREE, SLIP_LEFT, STICK, Outline, Slider
from tactile_push.simulation import RigConfig, experiment, paper_block, paper_disk, rollout

THETA_D = math.radians(-10.0)
QUANTITIES = ('theta', 'phi', 'd', 'x', 'y', 'mode')


def papers_law(theta_desired=THETA_D):
    return PushLaw(0.05, 5.0, theta_desired)


@pytest.fixture(scope='module')
def fig_8():
    """Return the step response of fig. 8 with kp = 0.05 and kd = 5."""
    return experiment(paper_block(), papers_law(), 600)


# Computed outside this package, see reference.md: theta and phi at k in degrees.
@pytest.mark.parametrize(
    ('k', 'theta', 'phi'),
    [
        (0, 20.0, 90.0),
        (20, 18.19, 110.5),
        (50, 10.73, 109.8),
        (100, 0.83, 98.5),
        (173, -6.10, 88.5),
    ],
)
def test_step_response_of_figure_8_through_sensor_and_finger(fig_8, k, theta, phi):
    assert math.degrees(fig_8.theta[k]) == pytest.approx(theta, abs=0.006)
    assert math.degrees(fig_8.phi[k]) == pytest.approx(phi, abs=0.06)


def test_step_response_settles_and_translates(fig_8):
    assert settle_step(fig_8.theta, THETA_D, math.radians(3.0)) == 192
    assert math.degrees(fig_8.theta[-1]) == pytest.approx(-10.0, abs=0.05)
    assert math.degrees(fig_8.phi[-1]) == pytest.approx(82.6, abs=0.05)
    assert fig_8.d[-1] == pytest.approx(0.00107, abs=0.00001)
    # (17): the ray of pushing passes through the centre of mass.
    assert 0.02375 / math.tan(fig_8.theta[-1] - fig_8.phi[-1]) == pytest.approx(
        fig_8.d[-1], abs=0.00005
    )
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
    assert result.end == 'no contact'
    last = len(result.theta) - 1
    assert 2 < last < 100
    for name in QUANTITIES:
        assert getattr(result, name).shape == (last + 1,)
        assert np.all(np.isfinite(getattr(result, name)))
    assert result.mode[-1] == FREE  # in the last period the contact was lost
    assert set(result.mode[:-1].tolist()) == {SLIP_LEFT}


def test_contact_behind_the_hemisphere_ends_the_experiment_but_not_the_rollout():
    # The pole turns clockwise as the finger goes to the right, the edge hardly turns.
    slider = Slider(Outline.rectangle(1.0, 0.0475), 1.0)
    config = RigConfig(slider, 0.0, math.radians(70.0), 0.0)

    def law():
        law = PushLaw(0.0, 0.0, 0.0)
        law.reset(math.radians(72.0))
        return law

    seen, felt = experiment(config, law(), 240), rollout(config, law(), 240)
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
