# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The drift with a tip that turns, against rolling, the equation in x, and its docstring."""

import math

import numpy as np
import pytest

from support.papers_figures import lines_by_label

L, R, BELT = 23.75, 13.5, 5.0  # mm, mm/s
A, B = 60.0, 80.0  # links of the usual finger, whose disk moves at y = 80 [mm]
STRAIGHT, TURNING, STEADIED = 'straight tip', 'turning tip', 'the same, steadied'
LINEAR = 'linear, from step 400'


def psi(x):
    """Return the direction of the second link, bent clockwise, with its end at (x, 80) mm."""
    square = x**2 + B**2
    at_base = np.arccos((A**2 + square - B**2) / (2.0 * A * np.sqrt(square)))
    knuckle = np.arctan2(B, x) + at_base
    return np.arctan2(B - A * np.sin(knuckle), x - A * np.cos(knuckle))


def slope(x):
    return (psi(x + 1e-4) - psi(x - 1e-4)) / 2e-4


@pytest.fixture(scope='module')
def drawn(figures):
    """Return time, theta [rad], d and x of the finger [mm] of each run."""
    angle, location, place = (lines_by_label(axes) for axes in figures['slow_mode'].axes)
    return {
        label: (
            angle[label].get_xdata(),
            np.radians(angle[label].get_ydata()),
            location[label].get_ydata(),
            place[label].get_ydata(),
        )
        for label in (STRAIGHT, TURNING, STEADIED)
    }


def test_all_start_as_figure_8_at_home(drawn):
    for time, theta, d, x in drawn.values():
        assert (time[0], math.degrees(theta[0])) == pytest.approx((0.0, 20.0))
        assert (d[0], x[0]) == pytest.approx((-6.0, -60.0))


def test_a_sticking_contact_keeps_what_it_rolls(drawn):
    for label, (_, theta, d, x) in drawn.items():
        turned = 0.0 if label == STRAIGHT else psi(x)
        assert np.ptp(d + R * (theta - turned)) < 1e-3, label


def test_the_drift_is_that_of_the_equation_in_x(drawn):
    time, theta, d, x = drawn[TURNING]
    place, location, held, now = x[400], d[400], theta[400], time[400]
    while place > -105.0:
        off = math.atan2(location, L)
        v_x = -BELT * math.sin(held + off)
        v_x /= math.cos(held + off) - R * slope(place) * math.cos(off)
        location += R * slope(place) * v_x * 0.01
        place += v_x * 0.01
        now += 0.01
    assert time[-1] == pytest.approx(now, abs=0.3)
    assert x[-1] == pytest.approx(-105.0, abs=0.2)


def test_the_linear_prediction_grows_at_the_rate_where_the_finger_is(figures, drawn):
    _, _, d, x = drawn[TURNING]
    _, location, place = (lines_by_label(axes) for axes in figures['slow_mode'].axes)
    time, predicted = location[LINEAR].get_data()
    assert (time[0], predicted[0]) == pytest.approx((40.0, d[400]))
    theta = math.radians(-10.0)
    off = predicted + L * math.tan(theta)
    rolled = R * slope(x[400])
    rate = -rolled * math.cos(theta) ** 2 * BELT / (L * (1.0 - rolled * math.cos(theta)))
    assert off == pytest.approx(off[0] * np.exp(rate * (time - 40.0)), rel=1e-6)
    assert 1.0 / rate == pytest.approx(31.0, abs=0.5)
    moved = place[LINEAR].get_ydata() - x[400]
    assert moved * rolled == pytest.approx(predicted - d[400], abs=1e-6)


def test_step_400_is_marked(figures):
    for axes in figures['slow_mode'].axes:
        marks = [line for line in axes.get_lines() if list(line.get_xdata()) == [40.0, 40.0]]
        assert len(marks) == 1
    assert 'step 400' in [text.get_text() for text in figures['slow_mode'].axes[0].texts]


def test_what_the_docstring_of_the_slow_mode_says_is_so(drawn):
    assert 1.0 / slope(-60.0) == pytest.approx(-B)  # -12.5 rad/m
    time, theta, _, x = drawn[TURNING]
    assert time[-1] == pytest.approx(74.0, abs=0.5)
    assert np.degrees(theta[400]) == pytest.approx(-10.0, abs=0.5)
    time, theta, _, x = drawn[STRAIGHT]
    assert time[-1] == 150.0
    assert (x[-1] - x[-301]) / 30.0 == pytest.approx(0.65, abs=0.005)
    time, theta, _, x = drawn[STEADIED]
    assert time[-1] == 150.0
    assert np.degrees(theta[-1]) == pytest.approx(-22.0, abs=0.5)
    assert np.ptp(x[-500:]) < 0.1
