# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The step response of fig. 8 with a finger tip that turns, by plane geometry alone.

It shares no code with the package: two circles meet at the knuckle, and a contact that sticks takes
the velocity of the finger's material there.
"""

import math

A, B, Y = 0.06, 0.08, 0.08  # links of the finger, and where its disk stays along the belt [m]
X = -0.06  # where it starts across the belt [m]
R, L, C, V_Y, PERIOD = 0.0135, 0.02375, 0.0187, 0.005, 0.1
LOWER, UPPER = math.radians(33.0), math.radians(147.0)


def psi(x, y=Y, a=A, b=B):
    """Return the direction of the second link [rad] where the circles meet left of the belt."""
    distance = math.hypot(x, y)
    along = (a**2 - b**2 + distance**2) / (2.0 * distance)
    height = math.sqrt(a**2 - along**2)
    knuckle_x = (along * x - height * y) / distance
    knuckle_y = (along * y + height * x) / distance
    return math.atan2(y - knuckle_y, x - knuckle_x)


def slope(x):
    """Return dpsi/dx [rad/m] by a difference."""
    return (psi(x + 1e-6) - psi(x - 1e-6)) / 2e-6


def rates(theta, d, x, v_x, point):
    """Return the rates of theta, d and the disk's place; `v_x` is the commanded velocity."""
    # A point at r (cos a, sin a) from the centre has x' - r psi' sin(a) across the belt.
    sine = {'centre': 0.0, 'pole': math.sin(psi(x)), 'contact': math.cos(theta)}[point]
    x_dot = v_x / (1.0 - R * sine * slope(x))
    spin = slope(x) * x_dot
    t, n = (math.cos(theta), math.sin(theta)), (-math.sin(theta), math.cos(theta))
    v = (x_dot - R * spin * t[0], V_Y - R * spin * t[1])
    x_c = (d * t[0] - L * n[0], d * t[1] - L * n[1])
    omega = (x_c[0] * v[1] - x_c[1] * v[0]) / (C**2 + d**2 + L**2)
    return omega, -R * (omega - spin), x_dot


def step_response(steps, point='centre', parts=10):
    """Return theta [deg], phi [deg] and d [m] at the start of every step."""
    state, phi, before, rows = (math.radians(20.0), -0.006, X), math.pi / 2.0, None, []
    for _ in range(steps + 1):
        theta = state[0]
        if before is not None:
            phi += 0.05 * (theta + math.radians(10.0)) + 5.0 * (theta - before)
            phi = min(max(phi, LOWER), UPPER)
        before = theta
        rows.append((math.degrees(theta), math.degrees(phi), state[1]))
        h, v_x = PERIOD / parts, V_Y / math.tan(phi)
        for _ in range(parts):  # the classical Runge-Kutta method of order 4
            k, all_k = (0.0, 0.0, 0.0), []
            for share in (0.0, 0.5, 0.5, 1.0):
                now = (s + share * h * r for s, r in zip(state, k, strict=True))
                k = rates(*now, v_x, point)
                all_k.append(k)
            state = tuple(
                s + h / 6.0 * (p + 2.0 * q + 2.0 * r + t)
                for s, p, q, r, t in zip(state, *all_k, strict=True)
            )
    return rows
