# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""When the finger leaves the object for another contact, and where it is meanwhile."""

from collections.abc import Iterator

from tactile_push.control.placing.model import Goal
from tactile_push.control.placing.reachability import Task
from tactile_push.control.placing.regrasp import THERE, Moves, Regrasp, Touch, detour, fits, touches

# Control periods in a row without a plan that arrives, after which another contact is looked for:
# by then the planner has looked with reserve and without. Later the object may have drifted to the
# end of the workspace. If there is none, as many pass again, and twice as many after another touch;
# picked.
IN_VAIN = 8


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
        self._found: list[Touch] = []

    def count(self, arrives: bool) -> None:
        """Take note whether the plan of a period arrives as things most likely are."""
        self._in_vain = 0 if arrives else self._in_vain + 1

    @property
    def is_due(self) -> bool:
        """Whether it is time to look for another contact."""
        return self._moves is not None and self._in_vain >= IN_VAIN

    def look(self, task: Task, goal: Goal) -> bool:
        """Try one contact, which is what there is time for in a period; leave when all are tried.

        Parameters
        ----------
        task, goal : Task, Goal
            From where and where to.

        Returns
        -------
        bool
            Whether the finger leaves the object.
        """
        assert self._moves is not None
        room = self._room - self._behind
        if self._tries is None:
            self._tries, self._found = touches(task, goal, self._moves, room), []
        for touch in self._tries:
            if touch is not None:
                self._found.append(touch)
            return False
        self._in_vain, self._tries = 0, None
        for touch in sorted(self._found, key=lambda one: one.belt):
            way = detour(task.now, touch.d, self._moves)
            if fits(way, task.now, task.bounds, room):  # from where the tries have led, too
                self._regrasp = Regrasp(way, self._moves)
                self.regrasps += 1
                self._in_vain = -IN_VAIN
                return True
        return False

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
