# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The law that brings the edge to an angle by all that is known of the object.

docs/steering.md says how.
"""

import math

from tactile_push.control.law import motion_angle
from tactile_push.control.placing.believing import D_MARGIN, BelievingLaw
from tactile_push.control.placing.turning import turning_command


class SettleLaw(BelievingLaw):
    """Brings the edge to an angle as soon as it can, and keeps it there.

    It takes the place of law (18) in `PushControl`, and does what that one does while nothing is
    believed. Otherwise it chooses each push from the newest belief moved on to the present: c, mu_c
    and d are those of the belief, however little is known of them. What turns the edge tells them.

    Attributes
    ----------
    goal : float
        Angle that the edge shall have instead of theta_desired [rad]; NaN for that one.
    """

    goal = math.nan

    @property
    def aim(self) -> float:
        """The angle that it steers to [rad]."""
        return super().aim if math.isnan(self.goal) else self.goal

    def update(self, theta: float) -> float:
        """Give the push angle of the next period, as in `PushLaw`."""
        present = self.present()
        if present is None:
            return super().update(theta)
        self._theta_before = theta
        now, belief = present
        bounds = self._inside(belief, D_MARGIN)
        u = turning_command(now, self.aim, self._piece, belief.pushed, bounds)
        self.phi = motion_angle(u, 1.0)
        return self.phi
