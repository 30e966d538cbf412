# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import math

import numpy as np
import pytest

from support.simulated_pushes import BELT, NOISE, PERIOD
from tactile_push.control import PushLaw, finger_velocity
from tactile_push.estimation import DiskEstimator
from tactile_push.estimation.contact_estimator import ContactEstimator
from tactile_push.estimation.prior import Prior
from tactile_push.mechanics import Outline, Slider
from tactile_push.simulation import Rig, RigConfig

DISK = 0.0285


def followed(mu_c, c, theta, seed, steps=150):
    """Push a disk under the paper's law: estimates, and where the disk is and how it turns."""
    rng = np.random.default_rng(seed)
    slider = Slider(Outline.circle(DISK), c)
    rig = Rig(RigConfig(slider, mu_c, theta, 0.0, tip_turns=False))
    law, estimator = PushLaw(0.05, 5.0, math.radians(-10.0)), DiskEstimator(DISK, NOISE)
    x, rows = 0.0, []
    for k in range(steps + 1):
        reading = rig.theta + NOISE * rng.standard_normal()
        estimate = estimator.push(reading, (rig.finger_x - x) / PERIOD, BELT, PERIOD if k else 0.0)
        rows.append((estimate, rig.object_in_finger_disk, rig.theta))
        x = rig.finger_x
        rig.step(finger_velocity(law.update(reading), BELT), PERIOD)
    return rows


@pytest.mark.parametrize('mu_c', [0.0, 0.3, math.inf])
def test_the_disk_is_where_the_mechanics_has_it(mu_c):
    squares, inside = [], 0
    for seed in range(8):
        c = 0.008 + 0.003 * seed
        for estimate, pose, theta in followed(mu_c, c, 0.3 - 0.08 * seed, seed)[20::30]:
            error = estimate.pose[:2] - (pose.x, pose.y)
            squares.append(error @ np.linalg.solve(estimate.covariance[:2, :2], error))
            inside += estimate.c.lower <= c <= estimate.c.upper
            assert estimate.contradiction == ''
            assert (estimate.d.lower, estimate.d.upper) == (0.0, 0.0)
            assert abs(estimate.theta - theta) < 4.0 * NOISE
    assert np.mean(squares) < 3.0  # 2 on average if the covariance is right
    assert inside >= len(squares) * 0.85


def test_how_the_disk_has_turned_stays_unknown():
    estimate = followed(math.inf, 0.019, 0.3, 0, 20)[-1][0]

    assert estimate.covariance[2, 2] == pytest.approx((2.0 * math.pi) ** 2 / 12.0)
    assert estimate.edges == ()
    assert estimate.edge == -1
    assert len(estimate.weights) == 0


def test_pushing_tells_of_c():
    widths = [one.c.upper - one.c.lower for one, _, _ in followed(math.inf, 0.019, 0.3, 1, 100)]
    assert 0.028 < widths[0] < 0.031  # of 0.031 m
    assert widths[-1] < 0.5 * widths[0]


def test_before_any_data_nothing_is_known():
    estimator = DiskEstimator(DISK, NOISE)

    estimate = estimator.push(math.nan, 0.0, BELT, PERIOD)
    assert np.isnan(estimate.pose[:2]).all()
    assert (estimate.c.lower, estimate.c.upper) == (0.005, 0.036)


def test_a_disk_has_no_edge():
    with pytest.raises(ValueError, match='disk'):
        ContactEstimator(Prior((-0.01, 0.01), DISK), NOISE, disk=True)
    with pytest.raises(ValueError, match='l:'):
        DiskEstimator(0.0, NOISE)
