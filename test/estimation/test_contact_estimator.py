# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import math

import numpy as np
import pytest

from support.simulated_pushes import pushes_by_a_tip
from tactile_push.control import PushLaw, finger_velocity
from tactile_push.estimation.contact_estimator import ContactEstimator
from tactile_push.estimation.prior import Prior
from tactile_push.mechanics import Outline, Slider, Support
from tactile_push.simulation import Faults, Rig, Servo, paper_block
from tactile_push.simulation.rig import RigConfig

NOISE = math.radians(0.2)
BLOCK = Prior((-0.025, 0.025), 0.02375)
STICKS = Prior((-0.025, 0.025), 0.02375, mu_c=(math.inf, math.inf))
BELT = 0.005


def run(config, steps, seed, noise=NOISE, servo=None):
    """Let the paper's law push: readings and commanded and measured velocities, and every d."""
    rng = np.random.default_rng(seed)
    rig = Rig(config, Faults(servo=servo or Servo()))
    law = PushLaw(0.05, 5.0, math.radians(-10.0))
    rows, truth, command, x = [], [], 0.0, 0.0
    for _ in range(steps + 1):
        theta = rig.theta + noise * rng.standard_normal()
        rows.append((theta, command, (rig.finger_x - x) / 0.1))
        truth.append(rig.d)
        x = rig.finger_x
        command = finger_velocity(law.update(theta), BELT)
        rig.step(command, 0.1)
    return rows, truth


def follow(estimator, rows, column=2):
    """Give the estimates, the first of a reading without a push."""
    return [
        estimator.push(row[0], row[column], BELT, 0.1 if k else 0.0) for k, row in enumerate(rows)
    ]


def random_block(seed, mu_c):
    rng = np.random.default_rng(1000 + seed)
    theta, d, c = rng.uniform(-0.4, 0.4), rng.uniform(-0.02, 0.02), rng.uniform(0.005, 0.036)
    return paper_block(theta, d, c, mu_c)


def shares_inside(tilt, told, mu_c, seeds, steps):
    """Push the block on its corners above its support: share of periods whose interval has d."""
    shares = []
    prior = Prior((-0.025, 0.025), 0.02375, 0.085 * 0.02375, tilt=told)
    slider = Slider.on(
        Outline.rectangle(0.05, 0.0475),
        Support.corners(Outline.rectangle(0.05, 0.0475)),
        exact=True,
        tilt=tilt,
    )
    for seed in range(seeds):
        rng = np.random.default_rng(seed)
        start = rng.uniform(-0.4, 0.4), rng.uniform(-0.018, 0.018)
        rows, truth = run(RigConfig(slider, mu_c, *start, tip_turns=False), steps, seed)
        estimates = follow(ContactEstimator(prior, NOISE, radius_sigma=0.085 * 0.0135), rows)
        inside = [
            one.d.lower <= d <= one.d.upper and one.d.least <= d <= one.d.most
            for one, d in zip(estimates, truth, strict=True)
        ]
        shares.append(np.mean(inside))
    return np.array(shares)


@pytest.mark.slow
@pytest.mark.parametrize('tilt', [0.0, 0.0048, 0.008])
def test_a_slipping_contact_above_the_support_is_held_by_the_interval(tilt):
    # mu_s = 0.3 at 16 mm, and the ends of what is stated.
    shares = shares_inside(tilt, 0.008, 0.1, 6, 250)

    assert shares.mean() > 0.93
    assert shares.min() > 0.8


@pytest.mark.slow
def test_a_push_above_the_support_has_to_be_told():
    assert shares_inside(0.0048, 0.0, 0.1, 6, 250).mean() < 0.85


@pytest.mark.slow
@pytest.mark.parametrize(('told', 'least', 'most'), [(True, 34, 40), (False, 0, 20)])
def test_turning_of_the_disk_has_to_be_told(told, least, most):
    # Ten runs, four steps each. Told: fewer than 34 of 40 have a probability below 1 % at 95 %.
    inside = 0
    for seed in range(10):
        made = pushes_by_a_tip(seed, 120, turn=-13.0)
        assert len(made) == 121
        estimator = ContactEstimator(BLOCK, NOISE)
        for k, one in enumerate(made):
            spin = -13.0 * one.v_x if told else 0.0
            found = estimator.push(one.theta, one.v_x, BELT, one.duration, spin)
            if told:
                assert found.d.least <= one.d <= found.d.most
            if k in (30, 60, 90, 120):
                inside += found.d.lower <= one.d <= found.d.upper
    assert least <= inside <= most


def test_before_any_data_it_knows_what_was_known_before():
    estimator = ContactEstimator(BLOCK, NOISE)

    for estimate in (estimator.estimate(), estimator.push(math.nan, 0.001, BELT, 0.1)):
        assert (estimate.d.lower, estimate.d.upper) == BLOCK.d
        assert (estimate.d.least, estimate.d.most) == BLOCK.d
        assert (estimate.c.lower, estimate.c.upper) == BLOCK.c
        assert (estimate.mu_c.lower, estimate.mu_c.upper) == (0.0, math.inf)
        assert math.isnan(estimate.theta)
        assert estimate.contradiction == ''


@pytest.mark.slow
@pytest.mark.parametrize('mu_c', [0.0, 0.2, math.inf])
def test_intervals_have_the_truth_as_often_as_they_say(mu_c):
    # 24 runs and two steps each: fewer than 42 of 48 have a probability below 1 % at 95 %.
    inside = 0
    for seed in range(24):
        config = random_block(seed, mu_c)
        rows, truth = run(config, 60, seed)
        estimates = follow(ContactEstimator(BLOCK, NOISE), rows)
        for k in (20, 60):
            d = estimates[k].d
            inside += d.lower <= truth[k] <= d.upper
            assert d.least <= truth[k] <= d.most
            assert estimates[k].contradiction == ''
    assert inside >= 42


@pytest.mark.slow
@pytest.mark.parametrize('support', ['corners', 'rim', 'uniform'])
def test_it_survives_a_limit_surface_that_is_not_its_own(support):
    outline = Outline.rectangle(0.05, 0.0475)
    count = () if support == 'corners' else (60,)
    slider = Slider.on(outline, getattr(Support, support)(outline, *count), exact=True)
    inside = 0
    for seed in range(8):
        start = random_block(seed, math.inf)
        config = RigConfig(slider, math.inf, start.theta, start.d, tip_turns=False)
        rows, truth = run(config, 173, seed)
        estimates = follow(ContactEstimator(BLOCK, NOISE), rows)
        inside += sum(
            estimates[k].d.lower <= truth[k] <= estimates[k].d.upper for k in (20, 60, 173)
        )
        assert all(
            estimate.d.least <= d <= estimate.d.most
            for estimate, d in zip(estimates, truth, strict=True)
        )
    assert inside >= 20  # of 24: fewer have a probability below 1 % at 95 %


def test_d_is_known_long_before_the_block_translates():
    # Figure 8: the paper reads off d after 400 steps, 1.8 mm wide.
    rows, truth = run(paper_block(), 173, 0)
    estimates = follow(ContactEstimator(STICKS, NOISE), rows)

    widths = [1e3 * (estimate.d.upper - estimate.d.lower) for estimate in estimates]
    assert widths[100] < 1.8
    assert widths[173] < 1.0
    assert estimates[173].d.lower <= truth[173] <= estimates[173].d.upper


def test_mirror_images_mirror():
    rows, _ = run(paper_block(mu_c=0.3), 30, 3)
    estimates = follow(ContactEstimator(BLOCK, NOISE), rows)
    mirrored = follow(ContactEstimator(BLOCK, NOISE), [(-a, -b, -c) for a, b, c in rows])

    for one, other in zip(estimates, mirrored, strict=True):
        assert other.d.mean == pytest.approx(-one.d.mean, abs=1e-7)
        assert other.d.lower == pytest.approx(-one.d.upper, abs=2e-5)
        assert other.c.mean == pytest.approx(one.c.mean, abs=1e-7)


def test_the_same_pushes_give_the_same_estimates_also_after_a_reset():
    rows, _ = run(paper_block(), 20, 2)
    estimator = ContactEstimator(BLOCK, NOISE)
    first = follow(estimator, rows)
    estimator.reset()

    again = follow(estimator, rows)

    assert [estimate.d for estimate in again] == [estimate.d for estimate in first]


def test_outliers_are_put_aside():
    rows, truth = run(paper_block(), 80, 4)
    rows[30] = (1.2, *rows[30][1:])
    rows[50] = (math.nan, *rows[50][1:])
    estimates = follow(ContactEstimator(BLOCK, NOISE, outlier=0.01), rows)

    assert estimates[30].d.upper - estimates[30].d.lower > 0.0
    assert abs(estimates[30].theta - rows[29][0]) < 0.05
    assert estimates[80].d.lower <= truth[80] <= estimates[80].d.upper
    assert estimates[80].contradiction == ''


def test_an_object_that_is_no_longer_pushed_contradicts_the_model():
    # It stays at an angle at which it would have to turn.
    rows, _ = run(paper_block(), 20, 5)
    estimator = ContactEstimator(BLOCK, NOISE)
    follow(estimator, rows)
    rng = np.random.default_rng(5)
    for _ in range(80):
        estimate = estimator.push(rows[-1][0] + NOISE * rng.standard_normal(), -0.004, BELT, 0.1)
    assert estimate.contradiction
    assert (estimate.d.lower, estimate.d.upper) == BLOCK.d


def test_readings_anywhere_contradict_the_model():
    rng = np.random.default_rng(6)
    estimator = ContactEstimator(BLOCK, NOISE)
    for _ in range(60):
        estimate = estimator.push(rng.uniform(-1.5, 1.5), 0.0, BELT, 0.1)
    assert 'jump' in estimate.contradiction


def test_a_prior_that_leaves_out_the_truth_is_less_likely():
    rows, _ = run(paper_block(), 60, 7)
    evidence = []
    for l in (0.02375, 0.06):
        estimator = ContactEstimator(Prior((-0.025, 0.025), l), NOISE)
        follow(estimator, rows)
        evidence.append(estimator.log_evidence)
    assert evidence[0] > evidence[1]


def test_a_density_over_the_prior_is_followed():
    prior = Prior(BLOCK.d, BLOCK.l, density=lambda d, c, mu_c: float(d > 0.0))
    estimate = ContactEstimator(prior, NOISE).push(0.1, 0.0, BELT, 0.0)

    assert estimate.d.lower >= -0.001
    assert estimate.d.upper == pytest.approx(0.025, abs=1e-3)


@pytest.mark.parametrize(
    'arguments',
    [(0.1, math.nan, BELT, 0.1), (0.1, 0.0, math.inf, 0.1), (0.1, 0.0, BELT, -0.1)],
)
def test_motions_that_are_none_are_refused(arguments):
    with pytest.raises(ValueError, match='expected'):
        ContactEstimator(BLOCK, NOISE).push(*arguments)
