# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""How the drift across the belt grows while a turning finger tip rolls along the edge.

docs/theory.md, "The slow mode", derives it.
"""

import math
from typing import NamedTuple

from tactile_push import paper
from tactile_push.control.states import PUSHING
from tactile_push.control.tick_state import Tick

# Over how long the drift is averaged [s]; picked. Long against a control period, whose v_x is
# mostly noise times kd, and short against the time in which the drift grows by e, 24 s and more.
AVERAGED = 5.0
# With less time in the workspace there is a warning [s]; picked. The drift of the usual finger
# about trebles in it, and somebody can still come and see.
SOON = 30.0


class Outlook(NamedTuple):
    """Where the drift leads."""

    growth: float  #: rate at which the drift grows [1/s]; negative if it dies away, NaN if unknown
    #: mean velocity of the finger across the belt [m/s]; NaN until theta was near its desired value
    #: for so long
    drift: float
    lasts: float  #: how long the finger stays in its workspace [s]; may be infinite; NaN as drift

    @property
    def e_fold(self) -> float:
        """In which time the drift grows by e [s]; infinite if it does not grow, NaN if unknown."""
        return 1.0 / self.growth if not self.growth <= 0.0 else math.inf

    @property
    def soon(self) -> bool:
        """Whether the finger will soon be at the end of its workspace."""
        return self.lasts < SOON


UNKNOWN = Outlook(math.nan, math.nan, math.nan)


class Drift:
    """Averages the finger's drift over the ticks and looks ahead.

    Parameters
    ----------
    l, r : float
        Distance from the edge to the centre of mass, and effective radius of the finger's disk [m].
    belt_speed : float
        Speed of the belt, v_y [m/s].
    period : float
        Control period [s].
    workspace_min, workspace_max : float
        The ends of the workspace, x of the disk [m].
    """

    def __init__(
        self,
        l: float,
        r: float,
        belt_speed: float,
        period: float,
        workspace_min: float,
        workspace_max: float,
    ) -> None:
        self._l, self._r = l, r
        self._belt_speed = belt_speed
        self._period = period
        self._enough = math.ceil(AVERAGED / period)
        self._ends = workspace_min, workspace_max
        self._x = math.nan
        self._drift, self._count = 0.0, 0

    def follow(self, tick: Tick, theta_desired: float, turning: float) -> Outlook:
        """Take a control period.

        Parameters
        ----------
        tick : Tick
            The control period.
        theta_desired : float
            Angle that the law aims at [rad].
        turning : float
            By how much the tip turns for each metre across the belt, dpsi/dx [rad/m]; NaN if
            unknown.

        Returns
        -------
        Outlook
            What is known after it.
        """
        near = abs(tick.theta - theta_desired) <= paper.TOLERANCE
        before, self._x = self._x, tick.finger_x
        growth = growth_rate(theta_desired, self._l, self._r, turning, self._belt_speed)
        v_x = (self._x - before) / self._period
        if tick.state != PUSHING or not near:
            self._drift, self._count = 0.0, 0
        elif math.isfinite(v_x):
            self._count = min(self._count + 1, self._enough)
            self._drift += (v_x - self._drift) / self._count
        if self._count < self._enough:
            return Outlook(growth, math.nan, math.nan)
        low, high = self._ends
        way = high - self._x if self._drift > 0.0 else self._x - low
        return Outlook(growth, self._drift, time_left(way, abs(self._drift), growth))


def growth_rate(theta: float, l: float, r: float, turning: float, belt_speed: float) -> float:
    """Return the rate at which the drift of an object grows that is held at an angle.

    Parameters
    ----------
    theta : float
        Angle of the edge [rad].
    l, r : float
        Distance from the edge to the centre of mass, and effective radius of the finger's disk [m].
    turning : float
        By how much the tip turns for each metre across the belt, dpsi/dx [rad/m].
    belt_speed : float
        Speed of the belt, v_y [m/s].

    Returns
    -------
    float
        The rate [1/s]; negative if the drift dies away.
    """
    if turning == 0.0:
        return 0.0
    return belt_speed / l * math.cos(theta) ** 2 / (math.cos(theta) - 1.0 / (r * turning))


def time_left(way: float, speed: float, growth: float) -> float:
    """Return how long a drift needs for a way if it grows at a rate.

    Parameters
    ----------
    way, speed : float
        How far it is [m], and how fast the drift is now [m/s], both 0 or more.
    growth : float
        Rate at which the drift grows [1/s]; NaN counts as 0.

    Returns
    -------
    float
        The time [s]; infinite if the drift does not come so far; NaN if the way or the speed is.
    """
    if speed == 0.0:
        return math.inf
    at_this_speed = way / speed
    if math.isnan(growth) or growth == 0.0:
        return at_this_speed
    grown = growth * at_this_speed
    return math.log1p(grown) / growth if grown > -1.0 else math.inf
