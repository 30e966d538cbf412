# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import math
from dataclasses import replace

import numpy as np
import pytest

from support.pushed_block import HALF, RADIUS
from tactile_push.control import PushLaw, finger_velocity
from tactile_push.estimation import ContactEstimator, Prior
from tactile_push.estimation.hypotheses import ModelErrors, advance, predict
from tactile_push.estimation.onset import beyond_motion_cone, positive_part
from tactile_push.estimation.prior import ROUND
from tactile_push.estimation.unknowns import ALPHA, LOG_C, THETA, TILT, UNKNOWNS, D, L, R
from tactile_push.mechanics.motion import pushed_twist
from tactile_push.mechanics.resistance import Pressure, Push
from tactile_push.report.merit import KNOWN
from tactile_push.simulation import Rig, paper_block

MOMENTS = np.array(ROUND)
C = 0.0187


@pytest.mark.parametrize('z', [-4.0, -1.5, 0.0, 0.7, 3.0])
def test_positive_part_is_that_of_the_integral(z):
    deviation = 0.3
    x = np.linspace(-10.0, 10.0, 400_001)
    density = np.exp(-x * x / 2.0) / math.sqrt(math.tau) * (x[1] - x[0])
    part = np.maximum(0.0, deviation * (z + x))

    share, mean, variance = positive_part(deviation * z, deviation**2)

    assert share == pytest.approx(density @ (part > 0.0), abs=1e-5)
    assert mean == pytest.approx(density @ part, abs=1e-8)
    assert variance == pytest.approx(density @ (part - density @ part) ** 2, abs=1e-8)


def test_positive_part_of_what_is_certain():
    assert positive_part(0.2, 0.0) == (1.0, 0.2, 0.0)
    assert positive_part(-0.2, 0.0) == (0.0, 0.0, 0.0)


@pytest.mark.parametrize('mu_c', [0.1, 0.5, 1.5])
def test_beyond_the_motion_cone_is_the_slip_and_goes_on_evenly_inside(mu_c):
    alpha = math.atan(mu_c)
    case = 0.008, -HALF, math.cos(alpha), math.sin(alpha), C
    angles = np.linspace(-1.2, 1.2, 2401)  # of the finger from the normal, to the right
    slips, left, right = [], [], []
    for angle in angles:
        v_t, v_n = 0.005 * math.sin(angle), 0.005 * math.cos(angle)
        slips.append(pushed_twist(v_t, v_n, *case)[3])
        beyond = beyond_motion_cone(v_t, v_n, slips[-1], *case)
        left.append(beyond[0])
        right.append(beyond[1])
    slips = np.array(slips)

    for beyond, slip in ((np.array(left), -slips), (np.array(right), slips)):
        assert beyond[slip > 0.0] == pytest.approx(slip[slip > 0.0])
        assert (beyond[slip <= 0.0] <= 0.0).all()
        slopes = np.diff(beyond)
        (edges,) = np.nonzero(np.diff(slip > 0.0))
        for edge in edges:
            inside, outside = slopes[edge - 3], slopes[edge + 3]
            assert inside == pytest.approx(outside, rel=0.03)
    assert (slips > 0.0).any()


def test_a_finger_that_leaves_is_beyond_no_edge():
    left, right = beyond_motion_cone(0.001, -0.005, 0.0, 0.008, -HALF, math.cos(0.5), 0.4, C)
    assert left == right < 0.0


@pytest.mark.slow
@pytest.mark.parametrize('off', [-1.5, 0.0, 1.5])  # of the middle from the onset, in deviations
@pytest.mark.parametrize('side', [1.0, -1.0])
def test_a_gaussian_that_begins_to_slip_is_that_of_many_pushed_objects(off, side):
    once = Push(0.001 * side, 0.005, 0.1)
    middle, deviations = np.zeros(UNKNOWNS), np.zeros(UNKNOWNS)
    middle[[LOG_C, ALPHA, L, R, TILT]] = math.log(C), math.atan(0.4), HALF, RADIUS, 0.002
    deviations[[THETA, D, LOG_C, ALPHA]] = 0.003, 0.0008, 0.1, 0.03
    deviations[[L, R, TILT]] = 0.001, 0.0005, 0.0005

    def end(row):
        theta, d, log_c, alpha, l, r, growth, shape, tilt = row
        pressure = Pressure(math.exp(2.0 * log_c), growth, shape, MOMENTS, tilt)
        return advance(theta, d, alpha, l, r, pressure, once, False)

    low, high = 0.0, 0.02 * side
    for _ in range(40):  # where the middle begins to slip
        middle[D] = (low + high) / 2.0
        low, high = (low, middle[D]) if end(middle).slip != 0.0 else (middle[D], high)
    across = np.linalg.norm(deviations[[D, ALPHA]] * [1.0, HALF / math.cos(middle[ALPHA]) ** 2])
    middle[D] += off * side * across
    half = np.random.default_rng(5).standard_normal((3000, UNKNOWNS))
    half = np.linalg.solve(np.linalg.cholesky(half.T @ half / len(half)), half.T).T
    samples = middle + np.concatenate([half, -half]) * deviations  # with just these moments
    ends = np.array([end(row)[:3] for row in samples])
    slips = ends[:, 2].std()
    assert 0.02 < (ends[:, 2] != 0.0).mean() < 0.98

    means, covariances = middle[np.newaxis].copy(), np.diag(deviations**2)[np.newaxis].copy()
    motions, no_errors = np.full((1, 2), math.nan), ModelErrors(0.0, 0.0, 0.0)
    predict(means, covariances, motions, MOMENTS, once, no_errors, False)

    errors = []
    for j, unit in ((THETA, HALF), (D, 1.0)):
        moved = ends[:, j] - samples[:, j]
        error = means[0, j] - middle[j] - moved.mean()
        errors.append(error * unit / slips)
        for k in (LOG_C, ALPHA, L, R, TILT):
            expected = ((samples[:, k] - middle[k]) * moved).mean() / deviations[k]
            error = covariances[0, j, k] / deviations[k] - expected
            errors.append(error * unit / slips)
        expected = deviations[j] ** 2 + moved.var()
        expected += 2.0 * ((samples[:, j] - middle[j]) * moved).mean()
        error = (covariances[0, j, j] - expected) / deviations[j]
        errors.append(error * unit / slips)
    assert errors == pytest.approx(np.zeros(len(errors)), rel=0, abs=0.12)


@pytest.mark.slow
def test_a_contact_that_slowly_begins_to_slip_leaves_what_is_known_as_it_was():
    # The contact rolls out to d = l mu_c, where a force through the centre of mass is on the edge
    # of the friction cone, and slips from there on. Where it slips tells d/l, and nothing of l.
    noise, steps, seeds = math.radians(0.2), 350, (0, 3, 4)
    prior = Prior((-0.025, 0.025), HALF, 0.085 * HALF, tilt=0.008)
    found = []
    for seed in seeds:
        rng = np.random.default_rng(seed)
        rig = Rig(replace(paper_block(mu_c=0.5), theta=-0.2, d=0.009, tip_turns=True))
        law = PushLaw(0.05, 5.0, math.radians(-10.0))
        estimator = ContactEstimator(prior, noise, radius_sigma=0.085 * RADIUS)
        way, spin, held = 0.0, 0.0, 0
        for k in range(steps):
            reading = rig.theta + noise * rng.standard_normal()
            duration = 0.1 if k else 0.0
            known = estimator.push(reading, way / 0.1, 0.005, duration, spin / 0.1)
            inside = known.d.lower <= rig.d <= known.d.upper
            held += inside
            assert inside or known.d.upper - known.d.lower > KNOWN
            before = rig.finger_x, rig.psi
            rig.step(finger_velocity(law.update(reading), 0.005), 0.1)
            way, spin = rig.finger_x - before[0], rig.psi - before[1]
        assert not rig.at_workspace_limit
        assert rig.d == pytest.approx(HALF * 0.5, rel=0.02)
        assert held >= 0.93 * steps
        found.append(known.l)
    assert np.mean(found) == pytest.approx(HALF, abs=2.0 * 0.085 * HALF / math.sqrt(len(seeds)))
