# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The law that brings the edge to an angle by all that is known of the object.

docs/steering.md says how.
"""

from tactile_push.control.law import AHEAD, motion_angle
from tactile_push.control.placing.believing import D_MARGIN, BelievingLaw
from tactile_push.control.placing.turning import turning_command


class SettleLaw(BelievingLaw):
    """Brings the edge to an angle as soon as it can, and keeps it there.

    It takes the place of law (18) in `PushControl`. Until something is believed it pushes straight
    ahead. Then it chooses each push from the newest belief moved on to the present: c, mu_c and d
    are those of the belief, however little is known of them. What turns the edge tells them.
    """

    def update(self, theta: float) -> float:
        """Give the push angle of the next period, as in `PushLaw`."""
        self._theta_before = theta
        self.phi = AHEAD
        present = self.present()
        if present is not None:
            now, belief = present
            bounds = self._inside(belief, D_MARGIN)
            u = turning_command(now, self.theta_desired, self._piece, belief.pushed, bounds)
            self.phi = motion_angle(u, 1.0)
        return self.phi
