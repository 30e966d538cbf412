# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The parameters of `experiment`."""

from dataclasses import dataclass

from tactile_push.parameters.parameter import NodeParameters, parameter


@dataclass(frozen=True)
class ExperimentParameters(NodeParameters):
    """What to record and for how long."""

    # fmt: off
    bag: str = parameter('', '', 'folder of the bag, which must not exist yet', read_only=True)
    steps: int = parameter(600, '', 'control periods to run', 1, 1000000000, read_only=True)
    goals: list[str] = parameter([], '',
        'where to let objects go, one after the other: texts of two numbers, x of the centre of '
        'mass in finger_base [m] and theta of the pushed edge [rad]; the run ends after the last',
        read_only=True)
    # fmt: on


def goals(p: ExperimentParameters) -> list[tuple[float, float]]:
    """Return x [m] and theta [rad] of each goal.

    Raises
    ------
    ValueError
        If a text is not two numbers.
    """
    found = []
    for text in p.goals:
        try:
            x, theta = map(float, text.split())
        except ValueError:
            raise ValueError(
                f'goals: expected texts of two numbers, x [m] and theta [rad], got {text!r}'
            ) from None
        found.append((x, theta))
    return found
