# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The law that brings the edge to an angle by all that is known of the object.

docs/steering.md says how.
"""

import math

from tactile_push.control.law import AHEAD, PushLaw, finger_velocity, motion_angle
from tactile_push.control.placing.law import D_MARGIN, X_MARGIN, Belief
from tactile_push.control.placing.model import Bounds, Situation, follow
from tactile_push.control.placing.turning import turning_command


class SettleLaw(PushLaw):
    """Brings the edge to an angle as soon as it can, and keeps it there.

    It takes the place of law (18) in `PushControl`. Until something is believed it pushes straight
    ahead. Then it chooses each push from the newest belief moved on to the present: c, mu_c and d
    are those of the belief, however little is known of them. What turns the edge tells them.

    Parameters
    ----------
    theta : float
        Angle that the edge shall have [rad].
    belt_speed, period : float
        Speed of the belt [m/s] and control period [s].
    lag : float, optional
        Time constant with which the finger follows [s].
    workspace : tuple of float, optional
        Least and greatest x of the finger's disk [m].
    rate : float, optional
        Largest change of v_x [m/s^2].
    phi_min, phi_max : float, optional
        Bounds of phi [rad], alike on both sides of straight ahead.
    """

    def __init__(
        self,
        theta: float,
        belt_speed: float,
        period: float,
        *,
        lag: float = 0.0,
        workspace: tuple[float, float] = (-0.105, 0.105),
        rate: float = 0.05,
        phi_min: float = math.radians(33.0),
        phi_max: float = math.radians(147.0),
    ) -> None:
        super().__init__(0.0, 0.0, theta, phi_min, phi_max)
        self._piece, self._lag = period * belt_speed, lag * belt_speed
        steepest = min(1.0 / math.tan(phi_min), -1.0 / math.tan(phi_max))
        self._bounds = Bounds(
            *(steepest, rate / belt_speed**2, workspace[0] + X_MARGIN, workspace[1] - X_MARGIN),
            *(-math.inf, math.inf, math.inf),
        )
        self._belief: Belief | None = None
        self._u = 0.0

    def reset(self, phi: float = AHEAD) -> None:
        """Forget the last reading and what was believed, as when the finger has stopped."""
        super().reset(phi)
        self._belief = None
        self._u = 0.0

    def believe(self, belief: Belief | None) -> None:
        """Take what is believed at the last update's reading; None if nothing is."""
        self._belief = belief

    def update(self, theta: float) -> float:
        """Give the push angle of the next period, as in `PushLaw`."""
        first = self._theta_before is None
        self._theta_before = theta
        belief = self._belief
        if first or belief is None:
            self.phi = AHEAD
            return self.phi
        command = finger_velocity(self.phi, 1.0)
        pushed = belief.pushed._replace(lag=self._lag)
        then = Situation(belief.x, belief.theta, belief.d, self._u, command)
        now = follow(then, command, self._piece, pushed)
        self._u = now.u
        bounds = self._bounds._replace(
            d_min=belief.ends[0] + D_MARGIN, d_max=belief.ends[1] - D_MARGIN
        )
        u = turning_command(now, self.theta_desired, self._piece, pushed, bounds)
        self.phi = motion_angle(u, 1.0)
        return self.phi
