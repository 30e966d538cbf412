# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The paper's block, pushed by the mechanics, for the tests of estimators."""

import math

from tactile_push.mechanics import Outline, friction_cone, push, pushed_twist, tangent_angle

RADIUS = 0.0135
HALF = 0.02375  # from the pushed edge to the centre of mass [m]
OUTLINE = Outline.rectangle(0.05, 2.0 * HALF)
PATH = OUTLINE.path(RADIUS)


def pushed(slider, theta, d, mu_c, v_x, v_y=0.005, duration=0.1, spin=0.0):
    """Return theta and d after a push, which the mechanics integrates to convergence."""
    sigma = OUTLINE.sigma(RADIUS, d=d)
    turn = tangent_angle(sigma, PATH)
    angle, after, _, _ = push(
        *(theta - turn, sigma, v_x, v_y, duration, PATH, slider.c, slider.points),
        *(*friction_cone(mu_c), RADIUS, spin),
    )
    return angle + turn, d + after - sigma


def pushed_above(tilt, theta, d, c, mu_c, v_x, l=HALF, duration=0.1, parts=20):
    """Return theta and d after a push above the support, on an ellipsoid about a shifted centre.

    The shift, tilt f / f_max along the force, and the motion about the shifted centre are found by
    repetition; the push by the midpoint rule.
    """
    cone, step = friction_cone(mu_c), duration / parts

    def rates(theta, d):
        v_t = math.cos(theta) * v_x + math.sin(theta) * 0.005
        v_n = math.cos(theta) * 0.005 - math.sin(theta) * v_x
        aside, ahead = 0.0, 0.0
        for _ in range(60):
            u_t, u_n, omega, v_slip, _ = pushed_twist(v_t, v_n, d - aside, -l - ahead, *cone, c)
            size = math.hypot(u_t, u_n, c * omega) or 1.0
            aside, ahead = tilt * u_t / size, tilt * u_n / size
        return omega, v_slip - omega * RADIUS

    for _ in range(parts):
        turn, along = rates(theta, d)
        turn, along = rates(theta + turn * step / 2.0, d + along * step / 2.0)
        theta, d = theta + turn * step, d + along * step
    return theta, d
