# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The paper's block, pushed by the mechanics, for the tests of estimators."""

from tactile_push.mechanics import Outline, friction_cone, push, tangent_angle

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
