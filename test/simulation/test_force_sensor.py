# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What a force/torque sensor under the tip measures."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tactile_push.simulation import ForceReadout, ForceSensor, Mount
from tactile_push.tactile import WrenchReader, WrenchSensing, contact_of_reading

R = 0.0135
CENTRED = Mount(R, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0))


def test_finger_that_points_ahead_is_pushed_back_along_its_pole():
    wrench = CENTRED.wrench((0.0, 2.0), 0.0, math.pi / 2.0)
    assert wrench == pytest.approx([0.0, 0.0, -2.0, 0.0, 0.0, 0.0], abs=1e-15)


def test_force_to_the_side_acts_at_the_contact():
    # The tip points ahead, its x to the left. It drags the object to the left, at its pole.
    wrench = CENTRED.wrench((-1.0, 0.0), 0.0, math.pi / 2.0)
    # The object drags it to the right, -x, with the lever R along z: the moment is R z times -x.
    assert wrench == pytest.approx([-1.0, 0.0, 0.0, 0.0, -R, 0.0], abs=1e-15)


def test_distance_of_the_sensor_is_a_lever():
    above = Mount(R, (0.0, 0.0, 0.02), (0.0, 0.0, 0.0))
    wrench = above.wrench((-1.0, 0.0), 0.0, math.pi / 2.0)
    assert wrench == pytest.approx([-1.0, 0.0, 0.0, 0.0, -0.02 - R, 0.0], abs=1e-15)


angles = st.floats(-0.7, 0.7)


@given(angles, angles, st.floats(-0.9, 0.9), *[st.tuples(*[st.floats(-3.0, 3.0)] * 3)] * 2)
@settings(derandomize=True, deadline=None, max_examples=100)
def test_contact_is_found_from_the_wrench_wherever_the_sensor_sits(theta, turn, sheared, xyz, rpy):
    psi, xyz = math.pi / 2.0 + turn, tuple(0.01 * x for x in xyz)
    normal, tangent = (-math.sin(theta), math.cos(theta)), (math.cos(theta), math.sin(theta))
    force = tuple(1.5 * n + sheared * t for n, t in zip(normal, tangent, strict=True))
    wrench = Mount(R, xyz, rpy).wrench(force, theta, psi)
    reader = WrenchReader(WrenchSensing(R, xyz, rpy), needs_tare=False)
    touch = reader.touch(1.0, '', wrench[:3], wrench[3:])
    assert contact_of_reading(touch.reading, psi, R, 1e-6).theta == pytest.approx(theta, abs=1e-6)
    assert touch.reading.normal_force == pytest.approx(1.5)
    assert touch.tangential_force == pytest.approx(abs(sheared), abs=1e-6)
    assert touch.torsion == pytest.approx(0.0, abs=1e-8)


def test_errors_add_up():
    truth = np.array([1.0, 2.0, 3.0, 0.1, 0.2, 0.3])
    offset, drift = (0.5, 0.0, 0.0, 0.0, 0.0, 0.01), (0.0, 0.1, 0.0, 0.0, 0.0, -0.001)
    sensor = ForceSensor(offset=offset, drift=drift)
    measured = ForceReadout(0).read(sensor, truth, 10.0)
    assert measured - truth == pytest.approx([0.5, 1.0, 0.0, 0.0, 0.0, 0.0])


def test_noise_has_its_deviations():
    sensor, readout = ForceSensor(noise=0.05, moment_noise=0.0005), ForceReadout(3)
    measured = np.array([readout.read(sensor, np.zeros(6), 0.0) for _ in range(4000)])
    expected = [0.05, 0.05, 0.05, 0.0005, 0.0005, 0.0005]
    assert measured.std(axis=0) == pytest.approx(expected, rel=0.05)
    assert np.abs(np.corrcoef(measured.T) - np.eye(6)).max() < 0.07


def test_same_seed_makes_the_same_run():
    sensor = ForceSensor(noise=0.05)
    first, again, other = (ForceReadout(seed).read(sensor, np.zeros(6), 0.0) for seed in (1, 1, 2))
    assert (first == again).all()
    assert (first != other).any()


@pytest.mark.parametrize(
    ('made', 'words'),
    [
        (lambda: ForceSensor(noise=-1.0), 'noise: expected a finite number of 0 or more'),
        (lambda: ForceSensor(moment_noise=math.inf), 'moment_noise: expected a finite'),
        (lambda: ForceSensor(offset=(1.0,)), 'offset: expected six finite numbers'),
        (lambda: ForceSensor(drift=(math.nan,) * 6), 'drift: expected six finite numbers'),
        (lambda: Mount(R, (0.0, 0.0), (0.0, 0.0, 0.0)), 'xyz: expected three finite numbers'),
        (lambda: Mount(R, (0.0,) * 3, (math.inf,) * 3), 'rpy: expected three finite numbers'),
    ],
)
def test_sensor_that_cannot_be_is_refused(made, words):
    with pytest.raises(ValueError, match=words):
        made()
