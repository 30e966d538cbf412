# Copyright 2026 The tactile_push authors
#
# Licensed under the Apache License, Version 2.0 (the "License");
# you may not use this file except in compliance with the License.
# You may obtain a copy of the License at
#
#     http://www.apache.org/licenses/LICENSE-2.0
#
# Unless required by applicable law or agreed to in writing, software
# distributed under the License is distributed on an "AS IS" BASIS,
# WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
# See the License for the specific language governing permissions and
# limitations under the License.
"""One push: the motion of Section II.C integrated while the finger moves straight on.

The rates have kinks where the contact changes between sticking and slipping, so the step is
controlled by an embedded error estimate (Bogacki and Shampine, 1989, order 3 with 2).
"""

import math

from tactile_push.mechanics.compiled import compiled
from tactile_push.mechanics.motion import FREE, contact_rates, pushed_twist

TOLERANCE = 1e-9  # of theta [rad], and of s in units of the greater of l and r, per step
SMALLEST_STEP = 1e-9  # of the push; how finely the end of contact is located


@compiled
def push_rates(
    theta: float,
    s: float,
    v: float,
    phi: float,
    curvature: float,
    l: float,
    c: float,
    cos_alpha: float,
    sin_alpha: float,
    r: float,
) -> tuple[float, float, int]:
    """Give the rates of the contact coordinates during a push.

    Parameters
    ----------
    theta : float
        Angle of the pushed edge or tangent [rad].
    s : float
        Contact along the outline [m].
    v, phi : float
        Speed [m/s] and direction [rad] of the finger relative to the support.
    curvature : float
        Curvature of the outline [1/m]: 0 for an edge.
    l : float
        Distance from edge or tangent to the centre of mass [m].
    c : float
        Ratio m_max / f_max [m].
    cos_alpha, sin_alpha : float
        The friction cone, see `friction_cone`.
    r : float
        Radius of the finger's disk [m].

    Returns
    -------
    theta_dot : float
        Rate of theta [rad/s].
    s_dot : float
        Rate of s [m/s].
    mode : int
        `FREE`, `STICK`, `SLIP_LEFT` or `SLIP_RIGHT`.
    """
    d = s if curvature == 0.0 else 0.0
    beta = phi - theta
    _, _, omega, v_slip, mode = pushed_twist(
        v * math.cos(beta), v * math.sin(beta), d, -l, cos_alpha, sin_alpha, c
    )
    s_dot, theta_dot = contact_rates(v_slip, omega, curvature, r)
    return theta_dot, s_dot, mode


@compiled
def push(
    theta: float,
    s: float,
    v: float,
    phi: float,
    duration: float,
    curvature: float,
    l: float,
    c: float,
    cos_alpha: float,
    sin_alpha: float,
    r: float,
) -> tuple[float, float, float, int]:
    """Push an object that the finger touches, straight on for a while.

    Parameters
    ----------
    theta : float
        Angle of the pushed edge or tangent at the start [rad].
    s : float
        Contact along the outline at the start [m].
    v, phi : float
        Speed [m/s] and direction [rad] of the finger relative to the support.
    duration : float
        Duration of the push [s].
    curvature : float
        Curvature of the outline [1/m]: 0 for an edge.
    l : float
        Distance from edge or tangent to the centre of mass [m].
    c : float
        Ratio m_max / f_max [m].
    cos_alpha, sin_alpha : float
        The friction cone, see `friction_cone`.
    r : float
        Radius of the finger's disk [m].

    Returns
    -------
    theta, s : float
        Contact coordinates at the end [rad, m].
    elapsed : float
        How long the finger pushed [s]: less than `duration` if it came to move along or away from
        the object, for instance because the object turned out of its way.
    mode : int
        How the contact moved at the end: `FREE`, `STICK`, `SLIP_LEFT` or `SLIP_RIGHT`.
    """
    scale = 1.0 / max(l, r)
    elapsed = 0.0
    step = duration
    a1, b1, mode = push_rates(theta, s, v, phi, curvature, l, c, cos_alpha, sin_alpha, r)
    while elapsed < duration and mode != FREE:
        last = elapsed + step >= duration
        if last:
            step = duration - elapsed
        theta_2, s_2 = theta + step / 2 * a1, s + step / 2 * b1
        a2, b2, _ = push_rates(theta_2, s_2, v, phi, curvature, l, c, cos_alpha, sin_alpha, r)
        theta_3, s_3 = theta + step * 3 / 4 * a2, s + step * 3 / 4 * b2
        a3, b3, _ = push_rates(theta_3, s_3, v, phi, curvature, l, c, cos_alpha, sin_alpha, r)
        theta_4 = theta + step * (2 * a1 + 3 * a2 + 4 * a3) / 9
        s_4 = s + step * (2 * b1 + 3 * b2 + 4 * b3) / 9
        a4, b4, mode_4 = push_rates(theta_4, s_4, v, phi, curvature, l, c, cos_alpha, sin_alpha, r)
        theta_error = step * (-5 * a1 + 6 * a2 + 8 * a3 - 9 * a4) / 72
        s_error = step * (-5 * b1 + 6 * b2 + 8 * b3 - 9 * b4) / 72
        error = max(abs(theta_error), abs(s_error) * scale) / TOLERANCE
        smallest = step <= SMALLEST_STEP * duration
        if mode_4 == FREE and not smallest:
            step /= 2.0  # up to where the finger stops pushing, no further
            continue
        if error <= 1.0 or smallest:
            theta, s, mode, a1, b1 = theta_4, s_4, mode_4, a4, b4
            elapsed = duration if last else elapsed + step
        step *= min(5.0, max(0.2, 0.9 / max(error, 1e-6) ** (1.0 / 3.0)))
    return theta, s, elapsed, mode
