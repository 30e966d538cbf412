# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Bounds on commands and on what is believed; `push_control` decides when the finger stops."""

import math
from dataclasses import dataclass

RETREAT = 0.04  # how far a finger of two axes may go with the belt [m]; picked


@dataclass
class Limits:
    """When to stop and how fast to go at the most; docs/safety.md has the reasons.

    Raises
    ------
    ValueError
        If a bound is not positive or the workspace is empty.
    """

    contact_timeout: float = 0.3  #: age of the last contact beyond which the finger stops [s]
    #: age of the finger's last known position beyond which it stops, if it was ever known [s]
    joint_state_timeout: float = 0.3
    max_ticks_lost: int = 3  #: control periods in a row without a tick beyond which it stops
    max_speed: float = 0.02  #: bound on |v_x| [m/s]
    max_acceleration: float = 0.05  #: bound on the change of v_x [m/s^2]; a stop is not bounded
    workspace_min: float = -0.105  #: least x of the finger's disk in `finger_base` [m]
    workspace_max: float = 0.105  #: greatest x of the finger's disk in `finger_base` [m]
    #: how far the finger may go with the belt, from where it is at first [m]; 0 if it cannot
    retreat_max: float = 0.0

    def __post_init__(self) -> None:
        for name in ('contact_timeout', 'joint_state_timeout', 'max_speed', 'max_acceleration'):
            if not getattr(self, name) > 0.0:
                raise ValueError(f'{name}: expected a positive number, got {getattr(self, name)}')
        if not self.max_ticks_lost >= 0:
            raise ValueError(f'max_ticks_lost: expected 0 or more, got {self.max_ticks_lost}')
        if not self.retreat_max >= 0.0:
            raise ValueError(f'retreat_max: expected 0 or more [m], got {self.retreat_max}')
        if not self.workspace_min < self.workspace_max:
            raise ValueError(
                'workspace_min: expected less than workspace_max, '
                f'got {self.workspace_min} and {self.workspace_max}'
            )

    def velocity(self, wanted: float, before: float, period: float) -> float:
        """Bound the finger's velocity and its change.

        Parameters
        ----------
        wanted, before, period : float
            What the law asks for, the last command [m/s], and the control period [s].

        Returns
        -------
        float
            The velocity [m/s]; `wanted` itself, to the bit, where no bound is met.
        """
        change = self.max_acceleration * period
        bounded = min(max(wanted, -self.max_speed), self.max_speed)
        return min(max(bounded, before - change), before + change)

    def inward(self, wanted: float, x: float) -> float:
        """Return 0 for a velocity that would move the finger further out of its workspace.

        Parameters
        ----------
        wanted, x : float
            Velocity across the belt [m/s], and where the finger is [m]; NaN if unknown.

        Returns
        -------
        float
            `wanted`, or 0 at a limit that it points to [m/s].
        """
        outward = (x >= self.workspace_max and wanted > 0.0) or (
            x <= self.workspace_min and wanted < 0.0
        )
        return 0.0 if outward else wanted


def plausible(theta: float) -> bool:
    """Return whether an angle can be that of an edge that the finger pushes.

    Parameters
    ----------
    theta : float
        Angle of the pushed edge [rad].

    Returns
    -------
    bool
        Whether it is finite and the edge faces the belt, |theta| <= pi/2.
    """
    return abs(theta) <= math.pi / 2.0  # which NaN is not
