# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The settling of two laws: what is drawn, and what its docstring says."""

import math

import numpy as np
import pytest

from support.papers_figures import lines_by_label

pytestmark = pytest.mark.slow

LAW_18, SETTLE = 'law (18)', 'settle'


@pytest.fixture(scope='module')
def drawn(figures):
    """Return theta and phi - 90 degrees of each law [deg]."""
    upper, lower = figures['settling'].axes
    pushes = [line for line in lower.get_lines() if len(line.get_xdata()) > 2]
    return {
        name: (lines_by_label(upper)[name].get_ydata(), push.get_ydata())
        for name, push in zip((LAW_18, SETTLE), pushes, strict=True)
    }


def settled(theta):
    """Return the first step from which on theta stays within 3 degrees of -10."""
    step = len(theta)
    while step > 0 and abs(theta[step - 1] + 10.0) <= 3.0:
        step -= 1
    return step


def test_both_start_as_figure_8(drawn):
    for theta, phi in drawn.values():
        assert (theta[0], phi[0]) == pytest.approx((20.0, 0.0), abs=1e-9)
        assert len(theta) == len(phi) == 301


def test_what_the_docstring_says_is_so(drawn):
    theta, phi = drawn[SETTLE]
    assert settled(theta) == 24
    assert list(phi[2:20]) == pytest.approx([57.0] * 18)
    assert np.abs(phi[:2]).max() < 57.0
    assert settled(drawn[LAW_18][0]) == 192


def test_the_steps_of_settling_are_marked(figures, drawn):
    marks = {line.get_xdata()[0] for line in figures['settling'].axes[1].get_lines()}
    assert {settled(theta) for theta, _ in drawn.values()} <= marks
    words = {text.get_text() for text in figures['settling'].axes[0].texts}
    assert {'24', '192'} <= words


def test_law_18_is_followed_through_sensor_and_finger(drawn):
    theta, phi = (np.radians(values) for values in drawn[LAW_18])
    # kd times the noise of two readings is what phi differs by from law (18) on the true theta.
    by_law = np.diff(phi) - 0.05 * (theta[1:] + math.radians(10.0)) - 5.0 * np.diff(theta)
    assert np.degrees(by_law[100:].std()) == pytest.approx(5.05 * 0.2 * math.sqrt(2.0), rel=0.2)
