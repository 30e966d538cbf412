# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Laws that act on what is believed of finger and object, moved on to the present."""

import math
from dataclasses import dataclass, replace

from tactile_push.control.law import AHEAD, PushLaw, finger_velocity
from tactile_push.control.placing.learning import Spread
from tactile_push.control.placing.model import Bounds, Pushed, Situation
from tactile_push.control.placing.past import Past, on_grid

D_MARGIN = 2e-3  # kept from the edge's ends [m]
X_MARGIN = 1e-3  # kept from the ends of the workspace [m]
FELT_MARGIN = math.radians(3.0)  # kept from where the sensor feels nothing any more; picked


@dataclass(frozen=True)
class Belief:
    """What is believed at a reading."""

    x: float  #: centre of the finger's disk across the belt [m]
    theta: float  #: angle of the pushed edge [rad]
    d: float  #: contact along the edge [m]
    pushed: Pushed  #: numbers of object and finger
    friction: tuple[float, float]  #: least and most mu_c that are to be thought of
    ends: tuple[float, float]  #: of the edge, least and most d [m]
    spread: Spread  #: how well they are known


class BelievingLaw(PushLaw):
    """What laws that believe have in common. Each of them gives its own push angles.

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
    felt : float, optional
        Largest angle between the tip's pole and a contact that the sensor feels [rad].
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
        felt: float = math.pi / 2.0,
    ) -> None:
        super().__init__(0.0, 0.0, theta, phi_min, phi_max)
        self._belt_speed = belt_speed
        self._piece = period * belt_speed
        self._lag = lag * belt_speed
        steepest = min(1.0 / math.tan(phi_min), -1.0 / math.tan(phi_max))
        self._bounds = Bounds(
            *(steepest, rate / belt_speed**2, workspace[0] + X_MARGIN, workspace[1] - X_MARGIN),
            *(-math.inf, math.inf, math.inf, felt - FELT_MARGIN),
        )
        self._past = Past(self._lag)
        self._belief: Belief | None = None
        self._believed_at = 0.0  # on the belt's way [m]

    def reset(self, phi: float = AHEAD) -> None:
        """Forget the last reading and what was believed, as when the finger has stopped."""
        super().reset(phi)
        self._belief = None

    def believe(self, belief: Belief | None, age: float = 0.0) -> None:
        """Take what is believed; None if nothing is.

        Parameters
        ----------
        belief : Belief or None
            What is believed at a reading.
        age : float, optional
            How long before the last update the reading was taken [s].
        """
        self._belief = belief
        if belief is not None:
            self._believed_at = self._past.way - on_grid(age * self._belt_speed)

    def pass_time(self, seconds: float) -> None:
        """Take note of the time since the last period [s], in which phi was in force."""
        u = finger_velocity(self.phi, 1.0)
        if self.away is not None:
            u = self.away[0] / self._belt_speed
        self._past.add(u, seconds * self._belt_speed)

    def present(self) -> tuple[Situation, Belief] | None:
        """Return where finger and object are now by what is believed; None if nothing is."""
        belief = self._belief
        if belief is None:
            return None
        belief = replace(belief, pushed=belief.pushed._replace(lag=self._lag))
        where = belief.x, belief.theta, belief.d
        return self._past.present(*where, self._believed_at, belief.pushed), belief

    def _inside(self, belief: Belief, margin: float) -> Bounds:
        """Return the bounds, with a margin inside the ends of the edge [m]."""
        low, high = belief.ends
        return self._bounds._replace(d_min=low + margin, d_max=high - margin)
