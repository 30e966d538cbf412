# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""A finger that lets go of its object by lifting, and is put down at the next one."""

import math
from abc import ABC, abstractmethod

from tactile_push.simulation.faults import Faults


class Lift(ABC):
    """What every rig knows of its finger's lift: it takes the servo's lift delay.

    Attributes
    ----------
    faults : Faults
        How far the rig is from a perfect one.
    lifted : bool
        Whether the finger is lifted off the object.
    free_in : float
        After how long it is, if its lift has begun [s]; otherwise infinite.
    """

    faults: Faults

    def __init__(self) -> None:
        self.lifted = False
        self.free_in = math.inf

    def lift(self, after: float = 0.0) -> None:
        """Lift the finger off the object, which the belt carries on as it lies.

        Parameters
        ----------
        after : float, optional
            When it is told to [s]. The object is free by the servo's lift delay later.
        """
        self.free_in = after + self.faults.servo.lift_delay
        self._go_on_lifting(0.0)

    def put_down(self) -> None:
        """Put the finger down at the next object, which it touches as it did the first one.

        A finger that is down stays there.
        """
        self.free_in = math.inf
        if self.lifted:
            self.lifted = False
            self._touch_next()

    def _go_on_lifting(self, duration: float) -> None:
        """Let time pass [s]; if the lift is over by then, the object is free."""
        self.free_in -= duration
        if self.free_in > 0.0:
            return
        self.free_in = math.inf
        if not self.lifted:
            self._come_off()

    @abstractmethod
    def _come_off(self) -> None:
        """Take the finger off the object; `lifted` from then on."""

    @abstractmethod
    def _touch_next(self) -> None:
        """Let the finger touch another object as it did the first one."""
