# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Steers an object across the belt to a place, where it is carried straight ahead.

docs/steering.md derives it.
"""

import math

from tactile_push import paper
from tactile_push.control.edge_observer import EdgeObserver
from tactile_push.control.law import PushLaw

RATE = 0.07  # both poles of the loop [1/s], at least; picked
FASTER = 1.5  # than the slow mode the loop is at least
STEEPEST = math.radians(40.0)  # largest angle of the edge
SPARED = math.radians(3.0)  # of it where an object is to be held
FASTEST = math.radians(4.0)  # turn of the edge that is asked for [rad/s]
AIMED = math.radians(5.0)  # angle from straight ahead at which a distant goal is approached
SURE = 1e-3  # standard deviation of d at which the edge is turned half as fast [m]
LEAST = 0.1  # share of l that the gains' denominators do not fall below
TURNING_WAY = 2e-3  # finger's way over which it is seen how fast the tip turns [m]


class Steering:
    """Trims theta_d so that an object is carried straight ahead at a goal.

    The goal is the x of the object's centre of mass. It takes the place of `Steadying` in
    `PushControl` and begins at once: theta_d does not matter. Without a goal it trims nothing.

    Parameters
    ----------
    law : PushLaw
        The law whose theta_d it trims, for its gains.
    belt_speed : float
        Speed of the belt, v_y [m/s].
    goal : float, optional
        Where the centre of mass shall be across the belt, in `finger_base` [m]; NaN for nowhere.
    l, r : float, optional
        Distance from the edge to the centre of mass, and effective radius of the finger's disk [m].

    Attributes
    ----------
    x : float
        Where the centre of mass is, as far as is known [m]; NaN if nothing is.
    target : float
        The place nearest to the goal where the object can be held without turning its edge too
        far, as far as is known [m]; NaN if nothing is.
    """

    def __init__(
        self,
        law: PushLaw,
        belt_speed: float,
        goal: float = math.nan,
        l: float = paper.BLOCK_L,
        r: float = paper.FINGER_RADIUS,
    ) -> None:
        self.goal = goal
        self.l, self.r = l, r
        self._law, self._belt_speed = law, belt_speed
        self.reset()

    def reset(self) -> None:
        """Forget the object."""
        self.trim = 0.0  #: what is added to theta_d [rad]
        self.x = self.target = math.nan
        self._observer: EdgeObserver | None = None
        self._before = self._seen = math.nan, math.nan
        self._turning = 0.0
        self._aim = math.nan

    def holds(self, turning: float) -> bool:
        """Return whether an object can be held where the tip turns so fast, if c is at most l.

        Parameters
        ----------
        turning : float
            By how much the tip turns for each metre across the belt, dpsi/dx [rad/m].

        Returns
        -------
        bool
            Whether turning the edge moves the contact by more than the tip rolls away.
        """
        rolled = self.r * turning
        return self.l - self.r + 2.0 * self.l * rolled / (1.0 - rolled) > 0.0

    def follow(
        self, theta: float, theta_desired: float, x: float, psi: float, period: float
    ) -> float:
        """Trim theta_d by what has happened since the last reading.

        Parameters
        ----------
        theta, theta_desired : float
            Sensed angle of the edge, and the one from which the trim counts [rad].
        x, psi : float
            Where the finger's disk is across the belt [m], and the angle of its pole [rad]. If one
            of them is NaN the object is forgotten.
        period : float
            Time since the last reading [s].

        Returns
        -------
        float
            The trim [rad].
        """
        if math.isnan(x + psi + self.goal):
            self.reset()
            return self.trim
        observer = self._observer
        if observer is None:
            observer = self._observer = EdgeObserver(self.l, self.r, theta)
            self._seen, self._aim = (x, psi), theta
        else:
            way, turn = x - self._before[0], psi - self._before[1]
            observer.follow(theta, way, turn, period * self._belt_speed)
        self._before = x, psi
        self._see_turning(x, psi)
        before = self._aim
        wanted = before + period * self._turn(observer, x)
        self._aim = min(max(wanted, -STEEPEST), STEEPEST)
        # (18) follows theta_d only by kp; with this lead it follows by kd as well.
        kp, kd = self._law.kp, self._law.kd
        lead = kd / kp * (self._aim - before) if kp > 0.0 else 0.0
        self.trim = self._aim + lead - theta_desired
        return self.trim

    def _see_turning(self, x: float, psi: float) -> None:
        """See how fast the tip turns for each metre across the belt."""
        way = x - self._seen[0]
        if abs(way) >= TURNING_WAY:
            self._turning = (psi - self._seen[1]) / way
            self._seen = x, psi

    def _turn(self, observer: EdgeObserver, x: float) -> float:
        """Return how fast the edge shall turn [rad/s]."""
        l, r, theta, d = self.l, self.r, observer.theta, observer.d
        cos, drift = math.cos(theta), self._belt_speed / l
        rolled = r * self._turning
        q = rolled / (1.0 - rolled * cos)
        gamma = (observer.c_squared + d * d + l * l) / l
        e = d + l * math.tan(theta)
        self.x = x - r * math.sin(theta) - e * cos
        growth = -drift * q  # lambda
        effect = max(l / cos**2 - r + gamma * q, LEAST * l)  # B
        shift = max(l - r + l * q, LEAST * l)
        self.target = self._nearest(theta, e, q, shift)
        p = max(RATE, FASTER * growth)
        by_x = p * p / (drift * shift)
        by_e = (2.0 * p + growth + (gamma - l) * by_x) / effect
        most = l * math.tan(AIMED) * by_e / by_x
        turn = by_x * min(max(self.x - self.target, -most), most) - by_e * e
        turn /= 1.0 + observer.d_variance / SURE**2
        return min(max(turn, -FASTEST), FASTEST)

    def _nearest(self, theta: float, e: float, q: float, shift: float) -> float:
        """Return the place nearest to the goal where the object can be held [m]."""
        if q == 0.0:
            return self.goal
        steepest = STEEPEST - SPARED
        ends = [self.x - (e + shift * (held - theta)) / q for held in (-steepest, steepest)]
        return min(max(self.goal, min(ends)), max(ends))
