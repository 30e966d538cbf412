# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The pushed object over the belt's way, as the planner sees it.

The belt's way s takes the place of time: rates are per metre of belt, and the finger's velocity is
u = v_x / v_y = cot(phi). The object is pushed at one straight edge, under the ellipsoid.
"""

import math
from typing import NamedTuple

from tactile_push.mechanics.compiled import compiled, equation
from tactile_push.mechanics.resistance import LEAST_COSINE, Pressure, settled
from tactile_push.mechanics.turning_tip import TurningTip, tip_direction, tip_turning

LONGEST_STEP = 5e-4  # of `follow` [m]: the belt's way in a control period of the paper
ROUNDING = 1e-6  # of a number of steps


class Pushed(NamedTuple):
    """The object and the finger that pushes it."""

    l: float  #: distance from the edge to the centre of mass [m]
    r: float  #: effective radius of the finger's disk [m]
    pressure: Pressure  #: how the object resists its turning
    cos_alpha: float  #: of the friction cone, see `friction_cone`
    sin_alpha: float  #: the same
    tip: TurningTip  #: how the tip turns on its way across the belt
    lag: float  #: belt on which the finger gets near to its command by a factor of e [m]


class Situation(NamedTuple):
    """Where finger and object are."""

    x: float  #: centre of the finger's disk across the belt [m]
    theta: float  #: angle of the pushed edge [rad]
    d: float  #: contact along the edge [m]
    u: float  #: velocity of the finger across the belt, by the belt's speed
    command: float  #: the one it was told last


class Goal(NamedTuple):
    """Where the object shall be let go."""

    x: float  #: of its centre of mass across the belt [m]
    theta: float  #: angle of the pushed edge [rad]


class Bounds(NamedTuple):
    """What a plan keeps to."""

    steepest: float  #: largest |cot(phi)|
    rate: float  #: largest change of the command for each metre of belt [1/m]
    x_min: float  #: least x of the finger's disk [m]
    x_max: float  #: greatest x of the finger's disk [m]
    d_min: float  #: end of the edge where d is least, a margin inside [m]
    d_max: float  #: the other end [m]
    theta_max: float  #: largest |theta| [rad]
    felt: float = math.inf  #: largest angle between the tip's pole and the contact [rad]


@compiled
def centre_of_mass(now: Situation, pushed: Pushed) -> float:
    """Return where the centre of mass is across the belt [m]."""
    way = now.d * math.cos(now.theta) + (pushed.l + pushed.r) * math.sin(now.theta)
    return now.x - way


@equation
def _rates(
    x: float, theta: float, d: float, u: float, pushed: Pushed
) -> tuple[float, float, float, float, bool]:
    """Compute theta' and d' under a velocity of the finger, and how d follows a slip.

    Then come the lever by which theta' takes from d', the rate at which d gets to where the slip
    would leave it, 0 if there is none, and whether the finger pushes.
    """
    cos, sin, spin = math.cos(theta), math.sin(theta), tip_turning(x, pushed.tip) * u
    v_t, v_n = cos * u + sin - pushed.r * spin, cos - sin * u
    c_squared, _, _, omega, v_slip = settled(
        v_t, v_n, d, pushed.l, pushed.cos_alpha, pushed.sin_alpha, pushed.pressure
    )
    pushes = v_n > 0.0 or omega != 0.0 or v_slip != v_t
    lever, rate = pushed.l + pushed.r, 0.0
    if v_slip != 0.0 and omega != 0.0:
        # By (13) and (15) omega = v_n (d + steep l)/(c^2 + d^2 + steep l d), and by (14) v_slip =
        # v_t - steep v_n - (l - steep d) omega.
        steep = math.copysign(pushed.sin_alpha / max(pushed.cos_alpha, LEAST_COSINE), v_slip)
        lever = max(lever - steep * d, pushed.r)
        rate = lever * v_n / (c_squared + d * (d + steep * pushed.l))
    return omega, v_slip - pushed.r * (omega - spin), lever, max(rate, 0.0), pushes  # (16)


@equation
def _reached(h: float, rate: float) -> float:
    """Return the integral of exp(-rate s) over a way h."""
    return -math.expm1(-rate * h) / rate if rate > 0.0 else h


@equation
def step(now: Situation, command: float, h: float, pushed: Pushed) -> tuple[Situation, bool]:
    """Move by a piece of belt under one command; the midpoint rule.

    A contact that slips gets to where it slips no more within c^2/(l + r) of belt, which may be
    shorter than a step. So d is taken to get there exponentially, and theta by what d has left of
    the finger's way along the edge.

    Parameters
    ----------
    now : Situation
        At its start.
    command : float
        What the finger is told.
    h : float
        Its length [m].
    pushed : Pushed
        The object.

    Returns
    -------
    after : Situation
        At its end.
    pushes : bool
        Whether the finger touched the object in its middle.
    """
    decay = math.exp(-h / pushed.lag) if pushed.lag > 0.0 else 0.0
    gap = now.u - command
    u = command + (gap * (1.0 - decay) * pushed.lag / h if h > 0.0 else 0.0)  # on the mean
    turn, slide, lever, rate, _ = _rates(now.x, now.theta, now.d, u, pushed)
    aside = _reached(h / 2.0, rate) * slide
    theta = now.theta + h / 2.0 * turn + (h / 2.0 * slide - aside) / lever
    turn, slide, lever, later, pushes = _rates(now.x + h / 2.0 * u, theta, now.d + aside, u, pushed)
    rate = max(rate, later)
    moved = _reached(h, rate) * (slide + rate * aside)
    after = Situation(
        *(now.x + h * u, now.theta + h * turn + (h * slide - moved) / lever, now.d + moved),
        *(command + gap * decay, command),
    )
    return after, pushes


@equation
def outside(now: Situation, pushed: Pushed, bounds: Bounds) -> tuple[float, float, float]:
    """Return by how much d, x and theta are beyond their bounds, 0 if they are not [m, m, rad].

    theta has two bounds, its own and that of the angle between the edge's normal and the pole.
    """
    from_pole = now.theta + math.pi / 2.0 - tip_direction(now.x, pushed.tip)
    return (
        max(bounds.d_min - now.d, now.d - bounds.d_max, 0.0),
        max(bounds.x_min - now.x, now.x - bounds.x_max, 0.0),
        max(abs(now.theta) - bounds.theta_max, abs(from_pole) - bounds.felt, 0.0),
    )


@equation
def bounded_step(
    now: Situation, command: float, h: float, pushed: Pushed, bounds: Bounds
) -> tuple[Situation, bool]:
    """Move as `step` does while the command changes no faster than it may."""
    change = bounds.rate * h
    allowed = min(max(command, now.command - change), now.command + change)
    return step(now, allowed, h, pushed)


@equation
def rolled(now: Situation, pushed: Pushed) -> float:
    """Return how far the tip's surface passes the contact for each metre across the belt."""
    return pushed.r * tip_turning(now.x, pushed.tip)


@equation
def translating(now: Situation, pushed: Pushed) -> float:
    """Return the command under which the object translates if the contact sticks.

    The edge moves as the tip's surface does there, which is the velocity of the tip's centre less
    `rolled` times the command along the edge. It has to point through the centre of mass.
    """
    cos, sin, d, l = math.cos(now.theta), math.sin(now.theta), now.d, pushed.l
    return -(d * cos + l * sin) / (l * cos - d * sin - l * rolled(now, pushed))


@equation
def ahead(now: Situation, pushed: Pushed, bounds: Bounds) -> float:
    """Return that command, or the steepest that comes nearest to it."""
    return min(max(translating(now, pushed), -bounds.steepest), bounds.steepest)


def narrowed(bounds: Bounds, steepness: float, x: float, d: float, theta: float) -> Bounds:
    """Return bounds that spare a share of the steepness, and of x, d [m] and theta [rad]."""
    return bounds._replace(
        steepest=(1.0 - steepness) * bounds.steepest,
        x_min=bounds.x_min + x,
        x_max=bounds.x_max - x,
        d_min=bounds.d_min + d,
        d_max=bounds.d_max - d,
        theta_max=bounds.theta_max - theta,
        felt=bounds.felt - theta,
    )


@compiled
def follow(now: Situation, command: float, way: float, pushed: Pushed) -> Situation:
    """Move by a piece of belt under one command, as long as one likes."""
    count = max(1, math.ceil(way / LONGEST_STEP - ROUNDING))
    for _ in range(count):
        now, pushes = step(now, command, way / count, pushed)
        if not pushes:
            break
    return now
