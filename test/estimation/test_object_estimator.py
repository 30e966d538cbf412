# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import math
from dataclasses import replace

import numpy as np
import pytest

from support.simulated_pushes import (
    BELT,
    BLOCK,
    NOISE,
    PERIOD,
    PLATE,
    RADIUS,
    TRIANGLE,
    follow,
    pushes,
    rig_of,
)
from tactile_push.estimation import DiskEstimator, ObjectEstimator, edges_of


def test_before_any_data_the_finger_is_as_likely_anywhere_on_the_outline():
    estimator = ObjectEstimator(edges_of(PLATE), NOISE)

    for estimate in (estimator.estimate(), estimator.push(math.nan, 0.0, BELT, PERIOD)):
        assert estimate.weights == pytest.approx(np.array([0.4, 0.1, 0.4, 0.1]))
        assert (estimate.d.lower, estimate.d.upper) == (-0.04, 0.04)
        assert (estimate.d.least, estimate.d.most) == (-0.04, 0.04)
        assert math.isnan(estimate.theta)
        assert np.isnan(estimate.pose).all()
        assert estimate.contradiction == ''


@pytest.mark.slow
def test_readings_tell_the_edges_of_a_triangle_apart():
    # Two of the edges are almost alike, the third is not.
    edges = edges_of(TRIANGLE)
    gained = []
    for seed in range(9):
        edge = seed % 3
        theta, share = np.random.default_rng(seed).uniform((-0.4, 0.3), (0.4, 0.7))
        d = edges[edge].d[0] + share * edges[edge].length
        made = pushes(rig_of(TRIANGLE, edge, theta, d), 120, seed)
        estimator = ObjectEstimator(edges, NOISE)
        before = estimator.estimate().weights[edge]
        estimates = follow(estimator, made)

        gained.append(math.log(estimates[-1].weights[edge] / before))
        assert all(estimate.contradiction == '' for estimate in estimates)
        for estimate, one in zip(estimates, made, strict=True):
            assert estimate.weights.sum() == pytest.approx(1.0)
            assert estimate.d.least <= one.d <= estimate.d.most
    assert min(gained) > math.log(0.05)
    assert np.mean(gained) > 0.1


@pytest.mark.slow
def test_the_long_edges_of_a_plate_are_told_from_the_short_ones():
    edges = edges_of(PLATE)
    for seed in range(8):
        edge, theta = seed % 2, np.random.default_rng(seed).uniform(-0.4, 0.4)
        made = pushes(rig_of(PLATE, edge, theta, 0.1 * edges[edge].length), 100, seed)
        weights = follow(ObjectEstimator(edges, NOISE), made)[-1].weights
        assert weights[edge] + weights[edge + 2] > 0.95


def test_opposite_edges_of_a_rectangle_stay_undecided():
    made = pushes(rig_of(PLATE, 0, 0.3, 0.01), 300, 0)
    estimate = follow(ObjectEstimator(edges_of(PLATE), NOISE), made)[-1]

    assert estimate.weights == pytest.approx(np.array([0.5, 0.0, 0.5, 0.0]), abs=0.01)
    assert estimate.edge == 0
    # The object may as well lie the other way around, about its own centre.
    assert estimate.covariance[2, 2] == pytest.approx(math.pi**2 / 2.0, rel=0.02)
    assert estimate.covariance[0, 0] < 0.003**2
    assert estimate.covariance[1, 1] < 0.003**2


def test_an_undecided_edge_shows_in_the_pose_and_in_d():
    made = pushes(rig_of(PLATE, 0, 0.1, 0.005), 3, 1)
    estimate = follow(ObjectEstimator(edges_of(PLATE), NOISE), made)[-1]

    assert (estimate.weights[:2] > 0.01).all()
    for lower, upper in ((one.d.lower, one.d.upper) for one in estimate.estimates):
        assert estimate.d.lower <= lower
        assert estimate.d.upper >= upper
    # The centre of mass is 1 cm from a long edge and 4 cm from a short one.
    assert estimate.covariance[1, 1] > 0.01**2


@pytest.mark.parametrize(('vertices', 'edge'), [(BLOCK, 0), (PLATE, 1), (TRIANGLE, 2)])
def test_with_a_known_edge_the_pose_is_the_objects(vertices, edge):
    edges = edges_of(vertices)
    squares = []
    for seed in range(6):
        made = pushes(rig_of(vertices, edge, 0.2 - 0.1 * seed, sum(edges[edge].d) / 2.0), 60, seed)
        estimates = follow(ObjectEstimator(edges[edge : edge + 1], NOISE), made)
        for k in (10, 30, len(made) - 1):
            estimate, one = estimates[k], made[k]
            # The rig's polygon begins with the pushed edge, but its frame is that of the corners.
            error = estimate.pose - (one.x, one.y, one.angle)
            error[2] = math.remainder(error[2], math.tau)
            squares.append(error @ np.linalg.solve(estimate.covariance, error))
    # 3 on average if the covariance is right; it has liberties, so less.
    assert 0.1 < np.mean(squares) < 4.5


def test_edges_that_turn_alike_are_computed_once():
    estimates = ObjectEstimator(edges_of(BLOCK), NOISE).push(0.1, 0.0, BELT, 0.0).estimates

    assert len(estimates) == 4
    assert len({id(estimate) for estimate in estimates}) == 2


def test_an_edge_that_has_fallen_behind_says_so_and_stays_out():
    made = pushes(rig_of(PLATE, 0, 0.3, 0.01), 100, 0)
    estimates = follow(ObjectEstimator(edges_of(PLATE), NOISE), made)

    behind = [bool(estimate.estimates[1].contradiction) for estimate in estimates]
    assert behind[-1]
    assert behind == sorted(behind)
    assert estimates[-1].weights[1] == 0.0
    # What is only unlikely is still possible.
    assert estimates[-1].d.most >= 0.01


@pytest.mark.slow
@pytest.mark.parametrize('wrong', [0.9, 1.1])
def test_l_and_r_may_be_wrong_by_a_tenth(wrong):
    inside = total = 0
    for seed in range(8):
        rng = np.random.default_rng(seed)
        corners = np.array(BLOCK) * (1.0, wrong)
        rig = rig_of(corners, 0, rng.uniform(-0.4, 0.4), rng.uniform(-0.015, 0.015))
        made = pushes(rig, 173, seed)
        estimator = ObjectEstimator(edges_of(BLOCK)[:1], NOISE, radius=RADIUS * wrong)
        for k, estimate in enumerate(follow(estimator, made)):
            d = made[k].d
            assert estimate.d.least <= d <= estimate.d.most
            if k in (20, 60, 173):
                total += 1
                inside += estimate.d.lower <= d <= estimate.d.upper
    assert inside >= total - 3  # of 24: fewer have a probability of 3 % at 95 %


def test_a_reset_forgets_everything():
    made = pushes(rig_of(BLOCK, 0, 0.3, 0.01), 15, 0)
    estimator = ObjectEstimator(edges_of(BLOCK), NOISE)
    first = follow(estimator, made)
    estimator.reset()
    assert math.isnan(estimator.estimate().theta)

    again = follow(estimator, made)

    assert [estimate.d for estimate in again] == [estimate.d for estimate in first]


def test_estimators_without_sense_are_refused():
    edges = edges_of(BLOCK)
    with pytest.raises(ValueError, match='edges'):
        ObjectEstimator((), NOISE)
    for name, value in (('l_share', 0.4), ('radius_share', -0.1), ('radius', 0.0)):
        with pytest.raises(ValueError, match=name.removesuffix('_share')[0]):
            ObjectEstimator(edges, NOISE, **{name: value})


def found_by_a_tip_that_turns(seed, *, told, start=None, steps=250):
    """Return for each reading whether d was within its interval, and the last interval's width."""
    rng = np.random.default_rng(seed)
    theta, d = start or rng.uniform((-0.35, -0.006), (0.35, 0.006))
    made = pushes(rig_of(BLOCK, 0, theta, d, tip_turns=True), steps, seed)
    if not told:
        made = [replace(one, spin=0.0) for one in made]
    estimates = follow(ObjectEstimator(edges_of(BLOCK)[:1], NOISE), made)
    assert all(e.d.least <= one.d <= e.d.most for e, one in zip(estimates, made, strict=True))
    inside = [e.d.lower <= one.d <= e.d.upper for e, one in zip(estimates, made, strict=True)]
    return inside, estimates[-1].d.upper - estimates[-1].d.lower


@pytest.mark.slow
def test_contact_is_found_by_a_tip_that_turns_if_somebody_tells_how_fast():
    told = [found_by_a_tip_that_turns(seed, told=True)[0] for seed in range(4)]
    untold = [found_by_a_tip_that_turns(seed, told=False)[0] for seed in range(4)]
    assert np.mean(np.concatenate(told)) >= 0.93
    assert np.mean(np.concatenate(untold)) < 0.5


def test_contact_of_a_tip_that_turns_is_known_to_a_millimetre_and_a_half():
    start = math.radians(20.0), -0.006
    inside, width = found_by_a_tip_that_turns(1, told=True, start=start, steps=400)
    assert np.mean(inside) >= 0.93
    assert width <= 0.0015


def test_another_touch_of_a_disk_is_the_first_one():
    first, again = (DiskEstimator(0.0285, NOISE) for _ in range(2))
    for k in range(20):
        again.push(0.1 + 0.01 * k, 0.001, BELT, PERIOD)
    expected, found = first.push(0.3, 0.0, 0.0, 0.0), again.touch_again(0.3, 0.01, 1e-3)
    assert (found.c, found.mu_c, found.theta) == (expected.c, expected.mu_c, expected.theta)
