# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""When the finger leaves the object for another contact, and where it is meanwhile."""

from collections.abc import Iterator

from tactile_push.control.placing.model import Goal
from tactile_push.control.placing.reachability import Task
from tactile_push.control.placing.regrasp import (
    THERE,
    Detour,
    Moves,
    Regrasp,
    Touch,
    detour,
    touches,
)

# Control periods in a row without a plan that arrives, after which the finger leaves: later the
# object may have drifted to the end of the workspace. After another touch more of them; picked.
IN_VAIN, AFTER_TOUCH = 4, 24
STAY = Detour(0.0, 0.0, 0.0, 0.0)  # at the contact that was left


class Elsewhere:
    """Brings a finger to another contact if no push from the one that it has leads to the goal.

    Parameters
    ----------
    moves : Moves or None
        How the finger gets about off the object; None if it never leaves it.
    room : float
        How far it may go back from its line [m].
    period : float
        Control period [s].

    Attributes
    ----------
    regrasps : int
        How often the finger has left the object for the goal.
    """

    def __init__(self, moves: Moves | None, room: float, period: float) -> None:
        self._moves = moves
        self._room = room
        self._period = period
        self._behind = 0.0  # how far the finger has gone back [m]
        self._regrasp: Regrasp | None = None
        self.begin()

    def begin(self) -> None:
        """Begin with a goal."""
        self.regrasps = 0
        self._in_vain = 0  # periods in a row without a plan that arrives
        self._tries: Iterator[Touch | None] | None = None
        self._tried: list[Touch] = []

    def count(self, arrives: bool) -> None:
        """Take note whether the plan of a period arrives as things most likely are."""
        self._in_vain = 0 if arrives else self._in_vain + 1

    @property
    def is_due(self) -> bool:
        """Whether it is time to look for another contact."""
        return self._moves is not None and self._in_vain >= IN_VAIN

    def leave(self, task: Task, nearest: float) -> bool:
        """Leave the object for another contact; return whether there is room for it.

        Where that is shows meanwhile: the object lies still, while the finger has time to look.

        Parameters
        ----------
        task : Task
            From where.
        nearest : float
            How near to the goal a plan from this contact comes, see `Plan.merit`.
        """
        assert self._moves is not None
        self._left, self._nearest = task, nearest
        self._in_vain = IN_VAIN - AFTER_TOUCH
        if detour(task.now, task.now.d, self._moves).back > self._room - self._behind:
            return False
        self._regrasp, self._tries = Regrasp(self._moves), None
        self.regrasps += 1
        return True

    def look(self, goal: Goal) -> None:
        """Try one contact, which is what there is time for in a period, until one is gone for.

        Parameters
        ----------
        goal : Goal
            Where to.
        """
        assert self._moves is not None and self._regrasp is not None
        if self._regrasp.goes:
            return
        room = self._room - self._behind
        if self._tries is None:
            self._tries, self._tried = touches(self._left, goal, self._moves, room), []
        try:
            touch = next(self._tries)
        except StopIteration:
            self._go()
            return
        if touch is not None:
            self._tried.append(touch)
        found = self._regrasp.is_nearly_back and any(one.arrives for one in self._tried)
        if found or room < self._moves.belt_speed * self._period:
            self._go()

    def _go(self) -> None:
        """Go for the best contact, or back to the one that was left if none comes nearer."""
        assert self._regrasp is not None
        room, self._tries = self._room - self._behind, None
        for one in sorted(self._tried, key=_rank):
            is_nearer = one.arrives or one.plan.merit < self._nearest
            if is_nearer and self._regrasp.more(one.detour) <= room:
                self._regrasp.go(one.detour)
                return
        self._regrasp.go(STAY)

    @property
    def is_clear(self) -> bool:
        """Whether the finger has gone back, so that what it feels is another contact."""
        return self._regrasp is not None and self._regrasp.is_clear

    @property
    def is_late(self) -> bool:
        """Whether the object should have come to the finger by now."""
        return self._regrasp is not None and self._regrasp.is_late

    @property
    def is_home(self) -> bool:
        """Whether the finger is on its line."""
        return self._behind <= THERE

    def velocity(self) -> tuple[float, float]:
        """Return the velocity to the other contact for a period, across and along [m/s]."""
        assert self._regrasp is not None
        return self._regrasp.velocity(self._period)

    def velocity_home(self) -> tuple[float, float]:
        """Return the velocity to the line for a period, across and along the belt [m/s]."""
        assert self._moves is not None
        return 0.0, self._moves.towards(self._behind, self._period)

    def pass_time(self, seconds: float, velocity: tuple[float, float]) -> None:
        """Take note of the time [s] for which the finger had a velocity across and along [m/s]."""
        self._behind -= velocity[1] * seconds
        if self._regrasp is not None:
            self._regrasp.pass_time(seconds, velocity)


def _rank(one: Touch) -> tuple[bool, float]:
    """Return what speaks against a contact: not to lead to the goal, and belt or misses."""
    return not one.arrives, one.belt if one.arrives else one.plan.merit
