# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The rule against jumps: the bound against the mechanics, and noise and outliers against it."""

import math

import numpy as np
import pytest

from tactile_push.mechanics import Outline, Slider
from tactile_push.simulation import Rig, RigConfig
from tactile_push.tactile import JUMP_TOLERANCE, MAX_THETA_RATE, ReadingRejectedError
from tactile_push.tactile.jumps import JumpGuard

DEGREE = math.radians(1.0)
NOISE = 0.5 * DEGREE


def verdicts(guard, stamps, thetas):
    """Return for each theta whether it is accepted."""
    accepted = []
    for stamp, theta in zip(stamps, thetas, strict=True):
        try:
            guard.check(stamp, theta)
            accepted.append(True)
        except ReadingRejectedError as refused:
            assert str(refused) == 'isolated jump'
            accepted.append(False)
    return accepted


def test_first_theta_is_accepted_at_once():
    assert verdicts(JumpGuard(), [5.0], [1.0]) == [True]


def test_bound_is_the_tolerance_and_what_theta_can_turn_in_the_time_between():
    for sign in (-1.0, 1.0):
        for step, accepted in ((0.2999, True), (0.3001, False)):
            guard = JumpGuard(max_rate=2.0, tolerance=0.1)
            assert verdicts(guard, [7.0, 7.1], [0.0, sign * step]) == [True, accepted]


def test_isolated_jump_is_refused_and_what_follows_is_not():
    thetas = [0.0, 0.0, 1.0, 0.0, 0.0, -1.0, 1.0, 0.0]
    expected = [True, True, False, True, True, False, False, True]
    assert verdicts(JumpGuard(), [0.02 * k for k in range(8)], thetas) == expected


def test_another_place_is_believed_at_the_third_that_agrees():
    thetas = [0.0, 0.0, 1.0, 1.05, 0.97, 1.0, 0.0]
    expected = [True, True, False, False, True, True, False]
    assert verdicts(JumpGuard(), [0.02 * k for k in range(7)], thetas) == expected


def test_three_that_do_not_agree_are_not_believed():
    thetas = [0.0, 1.0, -1.0, 1.0, 1.0, -1.0, 1.0, 1.0, 1.0]
    expected = [True] + 7 * [False] + [True]
    assert verdicts(JumpGuard(), [0.02 * k for k in range(9)], thetas) == expected


def test_good_one_between_outliers_that_agree_keeps_them_out():
    thetas = [0.0, 1.0, 1.0, 0.0, 1.0, 1.0, 0.0]
    expected = [True, False, False, True, False, False, True]
    assert verdicts(JumpGuard(), [0.02 * k for k in range(7)], thetas) == expected


def test_reading_without_a_theta_between_outliers_keeps_them_out():
    guard = JumpGuard()
    assert verdicts(guard, [0.0, 0.01, 0.02], [0.0, 1.0, 1.0]) == [True, False, False]
    guard.interrupt()
    assert verdicts(guard, [0.04, 0.05, 0.06], [1.0, 1.0, 1.0]) == [False, False, True]


def test_after_a_long_silence_everything_is_believed_at_once():
    silence = math.pi / MAX_THETA_RATE
    assert verdicts(JumpGuard(), [0.0, silence], [-1.5, 1.6]) == [True, True]


def test_angles_a_turn_apart_are_the_same():
    assert verdicts(JumpGuard(), [0.0, 0.002], [3.14, -3.14]) == [True, True]


def test_restart_forgets_all():
    guard = JumpGuard()
    assert verdicts(guard, [10.0, 10.01], [0.0, 1.0]) == [True, False]
    guard.restart()
    assert verdicts(guard, [0.0, 0.01], [-1.0, 1.0]) == [True, False]


def fastest_turn(theta, phi, mu_c, c):
    """Return the largest rate of theta while the paper's finger pushes the block off itself."""
    slider = Slider(Outline.rectangle(0.05, 0.0475), c)
    rig = Rig(RigConfig(slider, mu_c, theta, -0.02 if phi < math.pi / 2.0 else 0.02))
    period, fastest, before = 2e-3, 0.0, rig.theta
    for _ in range(6000):
        rig.step(0.005 / math.tan(phi), period)
        if not rig.touching:
            break
        fastest = max(fastest, abs(rig.theta - before) / period)
        before = rig.theta
    return fastest


@pytest.mark.slow
@pytest.mark.parametrize('mu_c', [0.0, 0.1, 0.3, 1.0, math.inf])
def test_pushed_block_turns_no_faster_than_derived(mu_c):
    # v = 5 mm/s / sin 33 degrees; the corner lies 34.5 mm from the centre of mass.
    v, r, c, rho = 0.005 / math.sin(math.radians(33.0)), 0.0135, 0.005, math.hypot(0.025, 0.02375)
    bound = max(v / (2.0 * c), v * math.hypot(1.0, 1.0 + rho / (2.0 * c)) / r)
    assert bound == pytest.approx(3.1, abs=0.01)
    assert bound < MAX_THETA_RATE
    fastest = max(
        fastest_turn(math.radians(theta), math.radians(phi), mu_c, c)
        for theta in (-40.0, 0.0, 40.0)
        for phi in (33.0, 90.0, 147.0)
    )
    assert 0.3 < fastest <= bound


@pytest.mark.parametrize('rate', [20.0, 50.0, 500.0])
def test_noise_on_a_theta_that_turns_as_fast_as_it_can_is_not_refused(rate):
    # 200,000 readings at a chance of 1e-10 each.
    generator = np.random.default_rng(11)
    stamps = np.arange(200_000) / rate
    thetas = MAX_THETA_RATE * stamps + generator.normal(0.0, NOISE, len(stamps))
    assert all(verdicts(JumpGuard(), stamps.tolist(), thetas.tolist()))


@pytest.mark.parametrize('rate', [20.0, 50.0, 500.0])
def test_outliers_do_not_get_through(rate):
    # 1 % outliers anywhere in the sensor's half plane, among 300,000 readings of a noisy theta
    # that swings by 20 degrees. An outlier within reach of the last reading cannot be told from
    # one; beyond it only three in a row that agree could pass: a chance below 1e-7 a reading.
    generator = np.random.default_rng(int(rate))
    count = 300_000
    stamps = np.arange(count) / rate
    true = 20.0 * DEGREE * np.sin(stamps)
    thetas = true + generator.normal(0.0, NOISE, count)
    outlier = generator.random(count) < 0.01
    thetas[outlier] = generator.uniform(-math.pi / 2.0, math.pi / 2.0, outlier.sum())
    accepted = np.array(verdicts(JumpGuard(), stamps.tolist(), thetas.tolist()))
    # How many periods ago the last good reading was accepted, and how far one may be led since.
    numbers = np.arange(count)
    good = np.maximum.accumulate(np.where(accepted & ~outlier, numbers, 0))
    since = numbers - np.concatenate([[0], good[:-1]])
    reach = since * (JUMP_TOLERANCE + (MAX_THETA_RATE + 20.0 * DEGREE) / rate) + 6.0 * NOISE
    error = np.abs(thetas - true)
    assert not (accepted & (error > reach)).any()
    far = outlier & (error > JUMP_TOLERANCE + MAX_THETA_RATE / rate + 6.0 * NOISE)
    assert far.sum() > 0.6 * outlier.sum()
    assert (far & accepted).sum() <= 0.002 * far.sum()
    assert (~accepted).sum() < 1.02 * outlier.sum()


@pytest.mark.parametrize('rate', [20.0, 50.0, 500.0])
def test_outlier_that_comes_first_is_overcome_within_a_few_readings(rate):
    generator = np.random.default_rng(3)
    needed = []
    for _ in range(2000):
        first = generator.uniform(-math.pi / 2.0, math.pi / 2.0)
        thetas = [first, *generator.normal(0.3, NOISE, 10)]
        accepted = verdicts(JumpGuard(), [k / rate for k in range(11)], thetas)
        assert accepted[0]
        needed.append(1 + accepted[1:].index(True))
        assert all(accepted[needed[-1] :])
    assert max(needed) <= 3
