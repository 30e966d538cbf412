# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Numbers that the package has to reproduce. docs/numbers.md says where they come from."""

import math

import pytest

# Fig. 8 with kp = 0.05 and kd = 5: step, theta and phi [deg].
FIGURE_8 = (
    (0, 20.0, 90.0),
    (20, 18.19, 110.5),
    (50, 10.73, 109.8),
    (100, 0.83, 98.5),
    (173, -6.10, 88.5),
)
FIGURE_8_SETTLE_STEP = 192  # within 3 degrees of theta_d from here on
FIGURE_8_END = (-10.0, 82.6, 0.00107)  # theta, phi [deg] and d [m] at step 600
BLOCK_L = 0.02375  # from the pushed edge to the centre of mass [m]

each_step_of_figure_8 = pytest.mark.parametrize(('k', 'theta', 'phi'), FIGURE_8)


def assert_is_end_of_figure_8(theta, phi, d):
    """Check angles [rad] and place [m] after 600 steps, and that they agree with equation (17)."""
    assert math.degrees(theta) == pytest.approx(FIGURE_8_END[0], abs=0.05)
    assert math.degrees(phi) == pytest.approx(FIGURE_8_END[1], abs=0.05)
    assert d == pytest.approx(FIGURE_8_END[2], abs=0.00001)
    # (17): the ray of pushing passes through the centre of mass.
    assert BLOCK_L / math.tan(theta - phi) == pytest.approx(d, abs=0.00005)
