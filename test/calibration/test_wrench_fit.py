# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import math

import numpy as np
import pytest

from support.touches import RADIUS, unit, wrench
from tactile_push.calibration.coverage import suggested_touches
from tactile_push.calibration.wrench_fit import fit_tip

CENTRE = np.array([0.002, -0.001, 0.035])
UPRIGHT = np.eye(3)
TURNED = np.array([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])  # z of the tip along x
NORMALS = np.array([unit(*at) for at in suggested_touches()])


def touches(sideways=0.5, torsion=0.0, axes=UPRIGHT, seed=0):
    """Return forces and moments of touches of 2 N that also push sideways, each in its own way."""
    random = np.random.default_rng(seed)
    wrenches = []
    for normal in NORMALS @ axes.T:
        angle = random.uniform(0.0, 2.0 * math.pi)
        shear = 2.0 * sideways * math.cos(angle), 2.0 * sideways * math.sin(angle)
        twist = torsion * random.uniform(-1.0, 1.0)
        wrenches.append(wrench(normal, 2.0, shear, twist, CENTRE))
    forces, moments = map(np.array, zip(*wrenches, strict=True))
    return forces, moments


@pytest.mark.parametrize('axes', [UPRIGHT, TURNED])
@pytest.mark.parametrize('sign', [1.0, -1.0])
def test_tip_is_found_whatever_its_orientation_and_the_sign_of_the_wrench(axes, sign):
    forces, moments = touches(axes=axes)
    fit = fit_tip(sign * forces, sign * moments, NORMALS, axes)
    assert fit.centre == pytest.approx(CENTRE, abs=1e-9)
    assert fit.radius == pytest.approx(RADIUS, abs=1e-9)
    assert fit.reaction == (sign < 0.0)
    assert fit.errors == pytest.approx(0.0, abs=1e-6)
    assert fit.found == pytest.approx(NORMALS, abs=1e-6)


def test_torsion_of_a_soft_tip_does_no_harm():
    fit = fit_tip(*touches(torsion=0.005), NORMALS, UPRIGHT)
    assert fit.centre == pytest.approx(CENTRE, abs=1e-9)
    assert fit.radius == pytest.approx(RADIUS, abs=1e-9)


def test_noise_spreads_the_radius_as_its_deviation_says():
    off = []
    for seed in range(40):
        random = np.random.default_rng(100 + seed)
        forces, moments = touches(seed=seed)
        forces = forces + 0.01 * random.standard_normal(forces.shape)
        moments = moments + 0.0002 * random.standard_normal(moments.shape)
        fit = fit_tip(forces, moments, NORMALS, UPRIGHT)
        off.append((fit.radius - RADIUS) / fit.radius_deviation)
    # Forty standard deviations are known to 11 %; noise of the force in the equations adds a bias.
    assert np.sqrt(np.mean(np.square(off))) == pytest.approx(1.0, abs=0.4)


@pytest.mark.parametrize('noise', [0.0, 0.001])
def test_touches_that_do_not_push_sideways_do_not_tell_the_radius(noise):
    forces, moments = touches(sideways=0.0)
    moments = moments + noise * np.random.default_rng(1).standard_normal(moments.shape)
    with pytest.raises(ValueError, match='^touches: expected some that push sideways as well'):
        fit_tip(forces, moments, NORMALS, UPRIGHT)


def test_wrong_places_are_refused():
    wrong = np.roll(NORMALS, 1, axis=0)
    with pytest.raises(ValueError, match='^touches: expected'):
        fit_tip(*touches(), wrong, UPRIGHT)


def test_wrong_orientation_is_refused():
    with pytest.raises(ValueError, match='^touches: expected'):
        fit_tip(*touches(axes=TURNED), NORMALS, UPRIGHT)


def test_touches_that_do_not_cover_the_tip_are_refused():
    forces, moments = touches()
    with pytest.raises(ValueError, match='got none at'):
        fit_tip(forces[:9], moments[:9], NORMALS[:9], UPRIGHT)
