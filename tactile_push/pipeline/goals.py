# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Goals that are given one after the other: when the next one is due."""

import math
from collections.abc import Iterable, Mapping

from tactile_push.control.placing.stages import ENDS, STAGES


class GoalsInTurn:
    """Gives a goal when the one before has ended or was refused.

    Parameters
    ----------
    goals : iterable of tuple of float
        Where to let go: x of the centre of mass [m] and theta of the pushed edge [rad].

    Attributes
    ----------
    done : bool
        Whether all have ended.
    """

    def __init__(self, goals: Iterable[tuple[float, float]]) -> None:
        self._waiting = list(goals)
        # Goals that had been taken and refused when the last one was given.
        self._before: tuple[float, float] | None = None
        self.done = not self._waiting

    def state(self, values: Mapping[str, float]) -> tuple[float, float] | None:
        """Take a message of `place/state`.

        Parameters
        ----------
        values : mapping of str to float
            Its numbers by name.

        Returns
        -------
        tuple of float or None
            The goal to give now; None if none is due.
        """
        counts = values.get('goals', math.nan), values.get('refused', math.nan)
        if self.done or not all(map(math.isfinite, counts)):
            return None
        if self._before is not None:
            taken, refused = (now > then for now, then in zip(counts, self._before, strict=True))
            ended = taken and STAGES[int(values['stage'])] in ENDS
            if not (ended or refused):
                return None
        if not self._waiting:
            self.done = True
            return None
        self._before = counts
        return self._waiting.pop(0)
