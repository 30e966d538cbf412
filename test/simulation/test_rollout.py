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
"""Rollouts of the law on the rig against the figures of the paper and independent numbers."""

import math

import numpy as np
import pytest

from tactile_push.control import PushLaw
from tactile_push.mechanics import Edge
from tactile_push.simulation import RigConfig, paper_block, paper_disk, rollout

THETA_D = math.radians(-10.0)


def settled_from(theta, desired, band):
    """Return the first step from which theta stays within the band."""
    step = len(theta)
    while step > 0 and abs(theta[step - 1] - desired) <= band:
        step -= 1
    return step


@pytest.fixture(scope='module')
def fig_8():
    """Return the step response of fig. 8 with kp = 0.05 and kd = 5."""
    return rollout(paper_block(), PushLaw(0.05, 5.0, THETA_D), 600)


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
def test_step_response_of_figure_8(fig_8, k, theta, phi):
    assert math.degrees(fig_8.theta[k]) == pytest.approx(theta, abs=0.05)
    assert math.degrees(fig_8.phi[k]) == pytest.approx(phi, abs=0.05)


def test_step_response_of_figure_8_settles_and_translates(fig_8):
    assert settled_from(fig_8.theta, THETA_D, math.radians(3.0)) == 192
    assert math.degrees(fig_8.theta[-1]) == pytest.approx(-10.0, abs=0.05)
    assert math.degrees(fig_8.phi[-1]) == pytest.approx(82.6, abs=0.05)
    assert fig_8.d[-1] == pytest.approx(0.00107, abs=0.00002)
    # (17): the ray of pushing passes through the centre of mass.
    assert 0.02375 / math.tan(fig_8.theta[-1] - fig_8.phi[-1]) == pytest.approx(
        fig_8.d[-1], abs=0.00005
    )
    assert fig_8.end == 'done'


def test_rows_are_one_more_than_the_steps_and_start_as_configured(fig_8):
    for column in (fig_8.theta, fig_8.phi, fig_8.d, fig_8.x, fig_8.y):
        assert column.shape == (601,)
        assert np.all(np.isfinite(column))
    assert len(fig_8.mode) == 601
    assert math.degrees(fig_8.theta[0]) == pytest.approx(20.0)
    assert math.degrees(fig_8.phi[0]) == pytest.approx(90.0)
    assert fig_8.d[0] == -0.006
    # The finger at the origin: CM at (r + l) n - d t.
    sin, cos = math.sin(math.radians(20.0)), math.cos(math.radians(20.0))
    assert fig_8.x[0] == pytest.approx(-0.03725 * sin + 0.006 * cos)
    assert fig_8.y[0] == pytest.approx(0.03725 * cos + 0.006 * sin)
    assert set(fig_8.mode) <= {'stick', 'slip_left', 'slip_right'}


def test_law_18_links_the_columns(fig_8):
    theta, phi = fig_8.theta, fig_8.phi
    by_law = phi[:-1] + 0.05 * (theta[1:] - THETA_D) + 5.0 * np.diff(theta)
    inside = (by_law > math.radians(33.0)) & (by_law < math.radians(147.0))
    assert inside.sum() > 500
    assert phi[1:][inside] == pytest.approx(by_law[inside], abs=1e-12)
    assert np.all(phi >= math.radians(33.0))
    assert np.all(phi <= math.radians(147.0))


def test_first_push_is_the_one_of_the_first_period(fig_8):
    # phi(0) = 90 degrees drives period 0, in which the finger pushes 0.5 mm in +y. The CM moves
    # by about that minus the part that turns the block.
    assert 0.0 < fig_8.y[1] - fig_8.y[0] < 0.0005
    one = rollout(paper_block(), PushLaw(0.05, 5.0, THETA_D), 1)
    assert one.theta == pytest.approx(fig_8.theta[:2], abs=1e-15)
    assert one.mode[0] == one.mode[1]


def test_disk_settles_at_zero():
    result = rollout(paper_disk(), PushLaw(0.05, 5.0, 0.0), 600)
    assert result.end == 'done'
    assert settled_from(result.theta, 0.0, math.radians(1.0)) < 500
    assert np.all(result.d == 0.0)


def test_open_loop_push_of_figure_7_turns_clockwise_past_the_finger():
    # kp = kd = 0 keeps phi at 90 degrees; d(0) < 0 means clockwise (voting theorem).
    result = rollout(paper_block(0.0, -0.005), PushLaw(0.0, 0.0, 0.0), 100)
    assert np.all(result.phi == math.pi / 2.0)
    assert np.all(np.diff(result.theta) < 0.0)


def test_period_is_the_length_of_a_push():
    law = (0.0, 0.0, 0.0)
    short = rollout(paper_block(), PushLaw(*law), 20, period=0.05)
    long = rollout(paper_block(), PushLaw(*law), 10, period=0.1)
    assert short.theta[::2] == pytest.approx(long.theta, abs=1e-7)
    assert short.theta[1] != pytest.approx(long.theta[1], abs=1e-6)


def test_lost_contact_ends_the_rollout_with_the_reason():
    config = RigConfig(Edge(0.004, 0.02), 0.015, 0.0, math.radians(-30.0), 0.0)
    result = rollout(config, PushLaw(0.0, 0.0, 0.0), 200)
    assert result.end == 'no contact'
    assert 2 < len(result.theta) < 100
    assert len(result.theta) == len(result.phi) == len(result.d) == len(result.x) == len(result.y)
    assert len(result.mode) == len(result.theta)
    assert result.mode[-1] == 'free'  # in the last period the contact was lost
    assert set(result.mode[:-1]) == {'slip_left'}
    assert np.all(np.abs(result.d) <= 0.002)


def test_no_steps_give_the_start_alone():
    result = rollout(paper_block(), PushLaw(0.05, 5.0, THETA_D), 0)
    assert result.theta == pytest.approx([math.radians(20.0)])
    assert result.mode == ('free',)
    assert result.end == 'done'
