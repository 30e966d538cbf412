# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
import math
import random
from dataclasses import replace

import pytest

from support.finger_seen import WELL, changed, faults
from tactile_push.doctor import RIGHT, WRONG, findings
from tactile_push.doctor.noise import noise_of
from tactile_push.interface import CONTROLLER_STATE, PUSH_CONTROLLER

HALF_A_DEGREE = math.radians(0.5)


def noisy(sigma, rate=0.0, n=3000):
    draw = random.Random(1)
    return [rate * k + draw.gauss(0.0, sigma) for k in range(n)]


@pytest.mark.parametrize('rate', [0.0, 0.01])
def test_noise_is_found_whether_the_edge_turns_or_not(rate):
    assert noise_of(noisy(HALF_A_DEGREE, rate)) == pytest.approx(HALF_A_DEGREE, rel=0.05)


def test_periods_without_a_contact_do_not_count():
    theta = noisy(HALF_A_DEGREE)
    theta[::7] = [math.nan] * len(theta[::7])
    assert noise_of(theta) == pytest.approx(HALF_A_DEGREE, rel=0.05)
    assert math.isnan(noise_of([0.0] * 5))
    assert math.isnan(noise_of([math.nan] * 50))


def seen(sigma, kd):
    ticks = tuple({'theta': theta} for theta in noisy(sigma))
    heard = replace(WELL.heard[CONTROLLER_STATE], values=ticks)
    values = {**WELL.parameters[PUSH_CONTROLLER], 'kd': kd}
    return changed(heard={CONTROLLER_STATE: heard}, parameters={PUSH_CONTROLLER: values})


def test_paper_s_gains_just_bear_half_a_degree():
    # kd times the noise: 5 times 0.5 degrees, 2.5 degrees as in docs/studies.md.
    (finding,) = [
        one for one in findings(seen(HALF_A_DEGREE * 0.95, 5.0)) if one.subject == 'theta'
    ]
    assert finding.verdict == RIGHT
    jitter = float(finding.words.partition('jitter by ')[2].partition('°')[0])
    assert jitter == pytest.approx(0.95 * 2.5, rel=0.05)
    (fault,) = faults(seen(2.0 * HALF_A_DEGREE, 5.0))
    assert (fault.verdict, fault.subject) == (WRONG, 'theta')
    assert 'kd up to 2.5' in fault.remedy


def test_no_noise_allows_any_gain():
    (finding,) = [one for one in findings(seen(0.0, 1000.0)) if one.subject == 'theta']
    assert finding.verdict == RIGHT
