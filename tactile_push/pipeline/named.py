# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What a JointState message says whose names and positions may not fit together."""

import math
from collections import Counter
from collections.abc import Iterable, Sequence

from tactile_push.interface import JOINT_STATES

# What a joint state was: taken, with numbers of no use, without a position of each joint.
TAKEN, REFUSED = 'joint states', 'joint states refused'
OTHER_JOINTS = 'joint states of other joints'
FARTHEST = 1e6  # that a joint turns [rad]; sums and sines of larger numbers tell nothing; picked
NAMES_SHOWN, LETTERS_SHOWN = 8, 40  # of names that somebody else chose; picked


def by_name(names: Sequence[str], positions: Sequence[float]) -> dict[str, float]:
    """Return the positions of a JointState message by name.

    A name has a value if it stands exactly once in the message and has a position. Nobody knows
    which value of a repeated name is meant, so such a name is missing, and whoever needs it does
    without the message: the finger stops on its timeouts rather than act on a guess. Names without
    a position and positions without a name are ignored.

    Parameters
    ----------
    names, positions : sequence of str, sequence of float
        Names and their positions.

    Returns
    -------
    dict of str to float
        Values by name.
    """
    values = dict(zip(names, positions, strict=False))
    if len(values) < len(names):
        times = Counter(names)
        values = {name: value for name, value in values.items() if times[name] == 1}
    return values


class Joints:
    """Finds the angles of certain joints in messages of `joint_states`.

    All of them have to be in the same message: angles of different moments make no pose. What
    several drivers publish has to be put together, as `joint_state_publisher` does.

    Parameters
    ----------
    names : sequence of str
        Names of the joints.
    """

    def __init__(self, names: Sequence[str]) -> None:
        self._names = names
        self._others: dict[str, None] = {}  # seen since the last message with all angles
        self._faults: dict[str, str] = {}  # of the joints, since then
        self._complete = True  # the last message

    def angles(self, names: Sequence[str], positions: Sequence[float]) -> list[float] | None:
        """Return the angles in a message.

        Parameters
        ----------
        names, positions : sequence of str, sequence of float
            Names of the message and their positions [rad].

        Returns
        -------
        list of float
            Angles in the order of the joints [rad], NaN for one that no joint has; None if the
            message does not have them all.
        """
        values = by_name(names, positions)
        angles = [values[name] for name in self._names if name in values]
        self._complete = len(angles) == len(self._names)
        if self._complete:
            self._others.clear()
            self._faults.clear()
        else:
            self._note(names, values)
        if not self._complete:
            return None
        usable = [abs(angle) <= FARTHEST for angle in angles]
        if not all(usable):
            for name, angle, is_usable in zip(self._names, angles, usable, strict=True):
                self._faults[name] = '' if is_usable else f'is {angle}'
        return [angle if ok else math.nan for angle, ok in zip(angles, usable, strict=True)]

    @property
    def trouble(self) -> str:
        """Why the last messages were of no use; empty if nothing is wrong with the last one."""
        if not self._complete:
            if not self._faults and not self._others:
                return f'{JOINT_STATES}: no names'
            if missing := [name for name in self._names if name not in self._faults]:
                seen = [name for name in self._names if name in self._faults]
                return (
                    f'joint_names: expected {_listed(self._names)} in {JOINT_STATES}, '
                    f'got no {_listed(missing)}, but {_listed([*seen, *self._others])}'
                )
        faults = [f'{name} {fault}' for name, fault in self._faults.items() if fault]
        if faults:
            return f'{JOINT_STATES}: {", ".join(faults)}'
        if not self._complete:
            return (
                f'joint_names: expected {_listed(self._names)} in one message of {JOINT_STATES}, '
                'got each in another'
            )
        return ''

    def _note(self, names: Sequence[str], values: dict[str, float]) -> None:
        """Remember what a message has that does not have all angles."""
        for name in names:
            if name in self._names:
                more = 'has no position' if names.count(name) == 1 else 'is named more than once'
                self._faults[name] = '' if name in values else more
            elif len(self._others) <= NAMES_SHOWN:
                self._others[name] = None


def _listed(names: Iterable[str]) -> str:
    """Return names for a message that has to stay short."""
    shown = [name[:LETTERS_SHOWN] or "''" for name in names]
    more = ['...'] if len(shown) > NAMES_SHOWN else []
    return ', '.join([*shown[:NAMES_SHOWN], *more])
