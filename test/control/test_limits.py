# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tactile_push.control import Limits, plausible

checked = settings(derandomize=True, deadline=None, max_examples=100)


@given(
    wanted=st.floats(-1.0, 1.0), before=st.floats(-0.02, 0.02), acceleration=st.floats(1e-3, 10.0)
)
@checked
def test_velocity_and_its_change_are_bounded(wanted, before, acceleration):
    limits = Limits(max_speed=0.02, max_acceleration=acceleration)
    v_x = limits.velocity(wanted, before, 0.1)
    change = 0.1 * acceleration
    assert abs(v_x) <= 0.02
    assert abs(v_x - before) <= change * (1.0 + 1e-12)
    # It is as near to what is wanted as the bounds allow.
    if abs(wanted) <= 0.02 and abs(wanted - before) < change * (1.0 - 1e-12):
        assert v_x == wanted
    assert (v_x - before) * (wanted - before) >= 0.0


def test_a_lower_bound_on_speed_slows_down_no_faster_than_the_change_allows():
    limits = Limits(max_speed=0.001, max_acceleration=0.02)
    assert limits.velocity(0.01, 0.01, 0.1) == pytest.approx(0.008)
    assert limits.velocity(-0.01, -0.01, 0.1) == pytest.approx(-0.008)


@pytest.mark.parametrize(
    ('x', 'wanted', 'given'),
    [
        (0.0, 0.004, 0.004),
        (0.0, -0.004, -0.004),
        (0.1, 0.004, 0.0),
        (0.1, -0.004, -0.004),
        (-0.2, -0.004, 0.0),
        (-0.1, 0.004, 0.004),
        (math.nan, 0.004, 0.004),
    ],
)
def test_nothing_leads_further_out_of_the_workspace(x, wanted, given):
    limits = Limits(workspace_min=-0.1, workspace_max=0.1)
    assert limits.inward(wanted, x) == given


@pytest.mark.parametrize('degrees', [0.0, 20.0, -90.0, 90.0])
def test_an_edge_that_faces_the_belt_is_plausible(degrees):
    assert plausible(math.radians(degrees))


@pytest.mark.parametrize('theta', [math.radians(90.1), -3.0, math.nan, math.inf, -math.inf])
def test_what_faces_away_or_is_no_angle_is_not(theta):
    assert not plausible(theta)


@pytest.mark.parametrize(
    ('bounds', 'named'),
    [
        ({'contact_timeout': 0.0}, 'contact_timeout'),
        ({'joint_state_timeout': math.nan}, 'joint_state_timeout'),
        ({'max_speed': -1.0}, 'max_speed'),
        ({'max_acceleration': 0.0}, 'max_acceleration'),
        ({'max_ticks_lost': -1}, 'max_ticks_lost'),
        ({'workspace_min': 0.1, 'workspace_max': 0.1}, 'workspace_min'),
    ],
)
def test_bounds_that_are_none_are_refused(bounds, named):
    with pytest.raises(ValueError, match=named):
        Limits(**bounds)
