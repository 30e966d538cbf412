# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""How likely the last readings are to a bank that begins anew, with a bank of known densities."""

import pytest

from support.simulated_pushes import BELT, NOISE, RADIUS, pushes_by_a_tip
from tactile_push.estimation import Prior
from tactile_push.estimation.bank import Bank, Liberties
from tactile_push.estimation.recent import REMEMBERED, Recent


class Integrator:
    """A bank that moves theta by v_x and spin; a log density is minus the error."""

    def __init__(self):
        self.began = []

    def start(self, theta):
        self.began.append(theta)
        self.theta = theta

    def push(self, v_x, v_y, duration, spin):
        self.theta += (v_x + spin) * duration

    def read(self, theta):
        return -abs(theta - self.theta)


@pytest.fixture
def recent():
    """Return readings of log density -5 after pushes by 1, one of them in two parts."""
    recent = Recent(1.0)
    for theta, parts in ((3.0, [1.0]), (4.0, [1.0]), (8.0, [0.25, 0.75]), (9.0, [1.0])):
        for part in parts:
            recent.push(0.5, 0.0, part, 0.5)
        recent.read(theta, -5.0)
    return recent


@pytest.mark.parametrize(
    ('readings', 'begins', 'errors'),
    [
        (1, 8.0, 0.0),
        (2, 4.0, 3.0 + 3.0),
        (3, 3.0, 0.0 + 3.0 + 3.0),
        (4, 1.0, 1.0 + 1.0 + 4.0 + 4.0),
        (99, 1.0, 1.0 + 1.0 + 4.0 + 4.0),  # all there are
    ],
)
def test_gain_is_that_of_the_last_readings_alone(recent, readings, begins, errors):
    bank = Integrator()
    assert recent.gain(bank, readings) == pytest.approx(5.0 * min(readings, 4) - errors)
    assert bank.began == [begins]


def test_pushes_after_the_last_reading_do_not_count(recent):
    before = recent.gain(Integrator(), 4)
    recent.push(7.0, 0.0, 1.0, 0.0)
    assert recent.gain(Integrator(), 4) == before


def test_memory_is_bounded():
    recent = Recent(0.0)
    for k in range(1, 1000):
        recent.read(float(k), 0.0)
    bank = Integrator()
    recent.gain(bank, 10_000)
    assert bank.began == [1000.0 - REMEMBERED]


def test_bank_that_begins_anew_at_the_first_reading_gains_nothing():
    prior = Prior((-0.025, 0.025), 0.02375, 0.002, (0.005, 0.036), (0.0, 1.0))
    bank = Bank(prior, (RADIUS, 0.001), Liberties(), NOISE, 0.001, False)
    first, *made = pushes_by_a_tip(0, 20)
    recent = Recent(first.theta)
    bank.start(first.theta)
    for one in made:
        bank.push(one.v_x, BELT, one.duration, 0.0)
        recent.push(one.v_x, BELT, one.duration, 0.0)
        recent.read(one.theta, bank.read(one.theta))
    assert recent.gain(bank, len(made)) == 0.0
    assert recent.gain(bank, 10) != 0.0
