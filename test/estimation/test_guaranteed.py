# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import math

import numpy as np
import pytest

from support.pushed_block import HALF, OUTLINE, RADIUS, pushed
from tactile_push.estimation.guaranteed import GuaranteedSet, ModelBounds
from tactile_push.estimation.prior import Prior
from tactile_push.mechanics import Slider, Support


@pytest.mark.parametrize('error', [-0.15, 0.15])
def test_the_truth_is_never_outside_while_l_and_r_are_within_their_bounds(error):
    prior = Prior((-0.025, 0.025), HALF / (1.0 + error), 0.075 * HALF, mu_c=(math.inf, math.inf))
    bounds = ModelBounds(math.radians(0.5), 0.0, 0.0)
    told = RADIUS / (1.0 - error)
    for seed in range(6):
        slider = Slider(OUTLINE, 0.006 + 0.005 * seed)
        found, d = follow(slider, math.inf, prior, bounds, seed, radii=(0.775 * told, 1.225 * told))

        (least, most), (least_c, most_c), _ = found.ranges()
        assert least <= d <= most
        assert least_c <= slider.c <= most_c
        assert most - least < 0.04


def follow(slider, mu_c, prior, bounds, seed, steps=120, radii=(RADIUS, RADIUS), turning=0.0):
    """Steer a block with noisy readings: give the set and the true d at the end."""
    rng = np.random.default_rng(seed)
    theta, d, v_x = rng.uniform(-0.3, 0.3), rng.uniform(-0.015, 0.015), 0.0
    noise = rng.uniform(-bounds.noise, bounds.noise, steps + 1)
    found = GuaranteedSet(prior, bounds, radii, theta + noise[0])
    for k in range(steps):
        v_x = float(np.clip(-0.01 * (theta + noise[k]), -0.004, 0.004))
        spin = turning * v_x
        theta, d = pushed(slider, theta, d, mu_c, v_x, spin=spin)
        found.push(v_x, 0.005, 0.1, spin)
        found.read(theta + noise[k + 1])
    return found, d


@pytest.mark.parametrize('turning', [0.0, -13.0])  # of the finger's disk over its way [rad/m]
@pytest.mark.parametrize('support', [None, 'corners', 'uniform'])
def test_the_truth_is_never_outside_and_a_sticking_contact_is_found(support, turning):
    prior = Prior((-0.025, 0.025), HALF, mu_c=(math.inf, math.inf))
    bounds = ModelBounds(math.radians(0.5))
    for seed in range(6):
        if support is None:
            slider = Slider(OUTLINE, 0.006 + 0.005 * seed)
        else:
            count = () if support == 'corners' else (60,)
            slider = Slider.on(OUTLINE, getattr(Support, support)(OUTLINE, *count), exact=True)
        found, d = follow(slider, math.inf, prior, bounds, seed, turning=turning)

        (least, most), _, _ = found.ranges()
        assert least <= d <= most
        assert most - least < 0.02


@pytest.mark.parametrize('mu_c', [0.0, 0.1, 0.5, math.inf])
def test_the_truth_is_never_outside_while_the_push_is_no_higher_than_stated(mu_c):
    prior = Prior((-0.025, 0.025), HALF, mu_c=(mu_c, mu_c), tilt=0.005)
    bounds = ModelBounds(math.radians(0.5))
    for seed in range(4):
        support = Support.corners(OUTLINE)
        slider = Slider.on(OUTLINE, support, exact=True, tilt=0.005 * (1.0 - seed / 3.0))
        found, d = follow(slider, mu_c, prior, bounds, seed, 80)

        (least, most), _, _ = found.ranges()
        assert least <= d <= most
        assert not found.empty


@pytest.mark.parametrize('turning', [0.0, -13.0])
@pytest.mark.parametrize('mu_c', [0.0, 0.2, 0.6])
def test_the_truth_is_never_outside_when_it_may_slip(mu_c, turning):
    prior = Prior((-0.025, 0.025), HALF)
    bounds = ModelBounds(math.radians(0.5), 0.0, 0.0)
    for seed in range(6):
        c = 0.006 + 0.005 * seed
        found, d = follow(Slider(OUTLINE, c), mu_c, prior, bounds, seed, 40, turning=turning)

        truths = (d, c, mu_c)
        for (least, most), truth in zip(found.ranges(), truths, strict=True):
            assert least <= truth <= most


def test_readings_that_no_object_gives_leave_nothing_and_then_the_prior():
    prior = Prior((-0.025, 0.025), HALF, mu_c=(math.inf, math.inf))
    found = GuaranteedSet(prior, ModelBounds(0.01), (RADIUS, RADIUS), 0.0)
    assert not found.empty

    found.push(0.0, 0.005, 0.1, 0.0)
    found.read(0.5)

    assert found.empty
    assert found.ranges() == pytest.approx(np.array([prior.d, prior.c, prior.mu_c]))


@pytest.mark.parametrize(
    ('name', 'value'), [('noise', -0.1), ('turn', 1.0), ('cone', math.inf), ('noise', math.nan)]
)
def test_bounds_that_are_none_are_refused(name, value):
    with pytest.raises(ValueError, match=name):
        ModelBounds(**{'noise': 0.01, name: value})


@pytest.mark.parametrize('way', [-0.012, 0.012])
def test_the_truth_is_never_outside_after_another_touch(way):
    # The finger starts on one side of a wide edge, so that it stays on it.
    prior = Prior((-0.04, 0.04), HALF, mu_c=(math.inf, math.inf))
    bounds = ModelBounds(math.radians(0.5))
    slider = Slider(OUTLINE, 0.02)
    for seed in range(4):
        rng = np.random.default_rng(seed)
        theta, d = rng.uniform(-0.4, 0.4), -math.copysign(0.005, way)
        found = GuaranteedSet(prior, bounds, (RADIUS, RADIUS), theta)
        for k in range(60):
            if k == 30:
                # It leaves the object and comes back; half a millimetre of each is not felt.
                before = found.ranges()[0]
                theta, d = pushed(slider, theta, d, math.inf, 0.0)
                d += way / math.cos(theta)
                theta, d = pushed(slider, theta, d, math.inf, 0.0)
                found.touch_again(way, 1e-3 * 0.5 / HALF, 1e-3)
                after = found.ranges()[0]
                assert after[1] - after[0] < before[1] - before[0] + 4e-3  # of which 2 mm are slip
            else:
                theta, d = pushed(slider, theta, d, math.inf, 0.003 * math.cos(k / 6.0))
                found.push(0.003 * math.cos(k / 6.0), 0.005, 0.1, 0.0)
            found.read(theta + rng.uniform(-bounds.noise, bounds.noise))
            least, most = found.ranges()[0]
            assert least <= d <= most
