# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The observer against rolling and turning by plane geometry, and by hand."""

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from support.turning_tip import C, L, R, X, rates, slope
from tactile_push.control.edge_observer import EdgeObserver

BELT = 0.0005  # of a control period [m]
NOTHING = 0.0, 0.0, 0.0
checked = settings(derandomize=True, deadline=None, max_examples=60)


def pushed(ways, theta=0.3, d=-0.006):
    """Yield the true theta and d of a block, and the finger's way and turn, period by period."""
    for way in ways:
        for _ in range(20):
            turn, slide, _ = rates(theta, d, X, way / 0.1, 'centre')
            theta, d = theta + turn * 0.005, d + slide * 0.005
        yield theta, d, way


def test_from_readings_of_a_block_that_is_turned_it_learns_where_the_contact_is_and_c():
    observer = EdgeObserver(L, R, 0.3)
    ways = [*(-0.0005,) * 20, *(0.0005,) * 20, *(-0.0003,) * 20]
    truth = [*pushed(ways)]
    for theta, _, way in truth:
        observer.follow(theta, way, slope(X) * way, BELT)
    theta, d, _ = truth[-1]
    assert observer.theta == pytest.approx(theta, abs=math.radians(0.2))
    assert observer.d == pytest.approx(d, abs=3e-4)
    assert math.sqrt(observer.c_squared) == pytest.approx(C, rel=0.05)


@pytest.mark.parametrize('theta', [-0.3, 0.0, 0.2])
@pytest.mark.parametrize('phi', [1.3, math.pi / 2.0, 1.7])
def test_the_contact_of_an_object_that_does_not_turn_is_that_of_the_ray_of_pushing(theta, phi):
    # (17): d = l / tan(theta - phi), if the object translates.
    observer = EdgeObserver(L, R, theta)
    for _ in range(200):
        observer.follow(theta, BELT / math.tan(phi), 0.0, BELT)
    assert observer.d == pytest.approx(L / math.tan(theta - phi), abs=1e-4)


def test_what_the_tip_turns_rolls_the_contact():
    # Its centre moves by r 0.1 while it turns by 0.1 rad: its surface stays where the edge is.
    still, rolled = EdgeObserver(L, R, 0.0), EdgeObserver(L, R, 0.0)
    still.follow(0.0, *NOTHING)
    rolled.follow(0.0, 0.1 * R, 0.1, 0.0)
    assert rolled.d - still.d == pytest.approx(0.1 * R, abs=1e-9)


def test_an_outlier_pulls_no_more_than_a_large_error():
    found = []
    for outlier in (math.radians(4.0), math.radians(60.0)):
        observer = EdgeObserver(L, R, 0.0)
        for theta in (*(0.0,) * 50, outlier):
            observer.follow(theta, 0.0, 0.0, BELT)
        found.append(observer.theta)
    assert found[0] == found[1] < math.radians(1.0)


@checked
@given(
    st.lists(
        st.tuples(st.floats(-1.5, 1.5), st.floats(-0.002, 0.002), st.floats(-0.1, 0.1)),
        min_size=1,
        max_size=30,
    )
)
def test_whatever_is_felt_it_believes_something_possible(felt):
    observer = EdgeObserver(L, R, 0.0)
    for theta, way, turn in felt:
        observer.follow(theta, way, turn, BELT)
        assert math.isfinite(observer.theta)
        assert abs(observer.d) <= 1.5 * L
        assert 0.2 * L - 1e-12 <= math.sqrt(observer.c_squared) <= 1.5 * L + 1e-12
        assert observer.d_variance > 0.0


def test_what_it_knows_of_d_grows_with_the_readings():
    observer = EdgeObserver(L, R, 0.1)
    before = observer.d_variance
    for _ in range(30):
        observer.follow(0.1, 0.0, 0.0, BELT)
    assert observer.d_variance < (3e-4) ** 2 < before
