# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import math

import numpy as np
import pytest

from tactile_push.estimation.contact_estimator import Estimate, Quantity
from tactile_push.estimation.pose import object_pose
from tactile_push.mechanics.contact import reach
from tactile_push.mechanics.resistance import Pressure

RADIUS = 0.0135
PRESSURE = Pressure(4e-4, 1.5, 0.0, np.array((1.0, 0.0, 1.0)))


def estimate_of(theta, d, l, covariance):
    numbers = Quantity(d, d, d, d, d)
    return Estimate(numbers, numbers, numbers, theta, covariance, l, RADIUS, 1.0, '', PRESSURE)


@pytest.mark.parametrize(('theta', 'd'), [(0.0, 0.0), (0.3, -0.006), (-0.5, 0.01)])
def test_the_pose_is_where_the_mechanics_has_the_object(theta, d):
    pose, _ = object_pose(estimate_of(theta, d, 0.02375, np.zeros((4, 4))))

    x, y = reach(theta, d, 0.02375, RADIUS)  # from the centre of mass to the disk
    assert pose == pytest.approx([-x, -y, theta], abs=1e-15)


def test_the_covariance_is_that_of_many_poses():
    rng = np.random.default_rng(0)
    mean = np.array([0.3, -0.006, 0.02375, RADIUS])
    root = np.diag([0.01, 0.001, 0.0005, 0.0007])
    root[1, 0], root[3, 2] = -0.0004, 0.0002
    _, covariance = object_pose(estimate_of(*mean[:3], root @ root.T))

    poses = [
        (*(-value for value in reach(*row)), row[0])
        for row in mean + rng.standard_normal((8000, 4)) @ root.T
    ]
    scale = np.sqrt(np.diag(covariance))
    difference = (np.cov(np.array(poses).T) - covariance) / np.outer(scale, scale)
    assert difference == pytest.approx(0.0, rel=0, abs=0.05)


def test_before_any_data_the_pose_is_none():
    pose, _ = object_pose(estimate_of(math.nan, 0.0, 0.02375, np.zeros((4, 4))))

    assert np.isnan(pose).all()
