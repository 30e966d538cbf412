# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The law that carries an object straight ahead at a place, by all that is known of it.

docs/steering.md derives it.
"""

import math

import numpy as np

from tactile_push.control.law import AHEAD, motion_angle
from tactile_push.control.placing.believing import D_MARGIN, BelievingLaw
from tactile_push.control.placing.holding import (
    BEGINNINGS,
    COUNT,
    holding_push,
    later,
    linear_command,
    linear_holds,
)
from tactile_push.control.placing.model import ahead
from tactile_push.control.steering import STEEPEST
from tactile_push.mechanics.compiled import Array


class SteerLaw(BelievingLaw):
    """Brings the centre of mass to a place across the belt and holds it there.

    It takes the place of law (18) in `PushControl`, and does what that one does, `Steering` as its
    trim, while nothing is believed. Otherwise it is the linear law as long as the contact will
    stick under that. If not, it improves in each control period the push that is left of the last
    one, on the mechanics with friction, and begins it. c, mu_c and d are those of the belief,
    however little is known of them.

    Attributes
    ----------
    goal : float
        Where the centre of mass shall be, in `finger_base` [m]; NaN for nowhere.
    """

    goal = math.nan
    _push: Array | None = None
    _planned_at = 0.0  # on the belt's way [m]
    _looks = 0

    def reset(self, phi: float = AHEAD) -> None:
        """Forget the last reading and what was believed, as when the finger has stopped."""
        super().reset(phi)
        self._push = None

    def update(self, theta: float) -> float:
        """Give the push angle of the next period, as in `PushLaw`."""
        present = None if math.isnan(self.goal) else self.present()
        if present is None:
            self._push = None
            return super().update(theta)
        self._theta_before = theta
        now, belief = present
        pushed = belief.pushed
        bounds = self._inside(belief, D_MARGIN)._replace(theta_max=STEEPEST)
        if linear_holds(now, self.goal, pushed, bounds):
            self._push = None
            u, _ = linear_command(now, self.goal, pushed, bounds)
            self.phi = motion_angle(u, 1.0)
            return self.phi
        left = np.zeros(COUNT)
        if self._push is not None:
            left = later(self._push, self._past.way - self._planned_at)
        self._planned_at = self._past.way
        beginning = self._looks % BEGINNINGS
        self._looks += 1
        self._push = holding_push(left, beginning, now, self.goal, pushed, bounds)
        u = ahead(now, pushed, bounds) + float(self._push[0])
        self.phi = motion_angle(min(max(u, -bounds.steepest), bounds.steepest), 1.0)
        return self.phi
