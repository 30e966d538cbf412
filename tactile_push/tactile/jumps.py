# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Separates the sensor's occasional errors (Section V.D) from what a finger can feel.

How fast can theta turn? Let v be the speed of the finger on the belt, the object's limit surface
the ellipsoid with c, f the unit vector of the pushing force, x_c the contact from the centre of
mass. The contact point of the object moves with v_c = A f lambda / c^2, where A = c^2 I + p p^T
and p is x_c turned by 90 degrees, and

    omega = (f . v_c) m / (c^2 + m^2),    m = x_c x f, the moment of a unit force.

Friction takes work and never gives it: f . v_c <= f . v_finger <= v, sticking or slipping. And
m / (c^2 + m^2) is at most 1 / (2 c). So |omega| <= v / (2 c), on an edge the rate of theta.

Where the outline is curved with radius R, theta turns by (slip + R omega) / (R + r), r being the
finger's radius: at a corner, R = 0, by slip / r alone, on anything rounder by a mean of that and
omega. Of the slip v_finger - v_c, the part along f is at most v, the part across f at most
v + |omega| rho, rho being the distance of the corner from the centre of mass. Therefore

    |d theta / d t| <= max(v / (2 c), v sqrt(1 + (1 + rho / (2 c))^2) / r).

A belt at 5 mm/s and push angles from 33 degrees on make v = 5 / sin 33 = 9.2 mm/s. With the
smallest c of an ordinary object, 5 mm, an edge turns by up to 0.92 rad/s; at the paper's block's
corner, rho = 34.5 mm, with r = 13.5 mm, theta turns by up to 3.1 rad/s. `MAX_THETA_RATE` is a
little more. It grows with the speed of the belt.

Two readings with a noise of 0.5 degrees (standard deviation) each differ by more than
`JUMP_TOLERANCE`, 6.5 times the difference's own deviation, once in ten thousand million times.
"""

import math

from tactile_push.tactile.hemisphere import ReadingRejectedError
from tactile_push.tactile.pole_history import BELIEVED

MAX_THETA_RATE = 3.5  # [rad/s]
JUMP_TOLERANCE = 0.08  # [rad]


class JumpGuard:
    """Refuses a theta that the finger cannot have come to feel since the last one.

    The first theta is accepted. One further from the last accepted than
    `tolerance + max_rate * (time between)` is refused, unless it is the last of `BELIEVED` in a
    row each of which lies that near to the one before: another place of the object has come to
    the finger then, or the last accepted was the error. The longer the sensor was silent, the more
    may have changed: after pi / max_rate everything is believed at once.
    """

    def __init__(self, max_rate: float = MAX_THETA_RATE, tolerance: float = JUMP_TOLERANCE) -> None:
        self.max_rate = max_rate  # how fast theta can turn [rad/s]; may be changed
        self.tolerance = tolerance  # how far two readings of one theta may differ [rad]; as above
        self._accepted: tuple[float, float] | None = None
        self._refused: tuple[float, float] | None = None
        self._in_a_row = 0

    def check(self, stamp: float, theta: float) -> None:
        """Accept a theta [rad], read after the last one, or refuse an unconfirmed jump."""
        if self._far(stamp, theta, self._accepted):
            again = self._in_a_row and not self._far(stamp, theta, self._refused)
            self._in_a_row = self._in_a_row + 1 if again else 1
            if self._in_a_row < BELIEVED:
                self._refused = stamp, theta
                raise ReadingRejectedError('isolated jump')
        self._accepted = stamp, theta
        self._in_a_row = 0

    def interrupt(self) -> None:
        """Take note of a reading without a theta: what was refused before it is not confirmed."""
        self._in_a_row = 0

    def restart(self) -> None:
        """Forget all, so that the next theta is the first."""
        self._accepted = None
        self._in_a_row = 0

    def _far(self, stamp: float, theta: float, before: tuple[float, float] | None) -> bool:
        if before is None:
            return False
        turned = abs(math.remainder(theta - before[1], 2.0 * math.pi))
        return turned > self.tolerance + self.max_rate * (stamp - before[0])
