# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What `bench_nodes.py` makes of its measurements: statistics, and a table beside the goals."""

from collections.abc import Sequence
from itertools import pairwise
from typing import Any

import numpy as np


def delays(
    sent: Sequence[float], heard: Sequence[tuple[int | None, float]], first: int
) -> dict[int, float]:
    """Give the time from writing each reading to the first message that tells of it.

    Parameters
    ----------
    sent : sequence of float
        When each reading was written [s], by its number.
    heard : sequence of tuple
        Number of a reading, or None, and when it was heard [s], in the order heard.
    first : int
        Number of the first reading that counts.

    Returns
    -------
    dict of int to float
        Delays [s] of the readings that were heard of, by number.
    """
    found: dict[int, float] = {}
    for number, at in heard:
        if number is not None and number >= first and number not in found:
            found[number] = at - sent[number]
    return found


def gaps(numbers: Sequence[int | None], first: int, last: int) -> tuple[int, int]:
    """Count the numbers that are missing, and those that are not greater than the one before.

    Parameters
    ----------
    numbers : sequence of int or None
        What was heard, in the order heard; what lies before `first` does not count.
    first, last : int
        The numbers that were sent, both included.

    Returns
    -------
    lost, disordered : int
        How many.
    """
    counted = [number for number in numbers if number is not None and first <= number <= last]
    disordered = sum(later <= earlier for earlier, later in pairwise(counted))
    return last - first + 1 - len(set(counted)), disordered


def spread(times: np.ndarray, period: float) -> tuple[float, int]:
    """Give the standard deviation of the periods between ticks, and the ticks missing.

    Parameters
    ----------
    times : numpy.ndarray
        When the ticks came [s].
    period : float
        How far apart they should be [s].

    Returns
    -------
    deviation : float
        Root of the mean square of the periods' distance from `period` [s].
    lost : int
        Periods that passed without a tick.
    """
    periods = np.diff(times)
    lost = np.maximum(np.round(periods / period) - 1.0, 0.0).sum()
    return float(np.sqrt(np.mean((periods - period) ** 2))), int(lost)


class Report:
    """What was measured, beside its goal."""

    def __init__(self) -> None:
        self._rows: list[dict[str, Any]] = []
        self._saved = 0

    def add(self, what: str, detail: str, value: float, goal: float | None, unit: str) -> None:
        """Add a row; the goal is the largest value that is good, None if there is none."""
        met = None if goal is None else bool(value <= goal)
        self._rows.append(
            dict(what=what, detail=detail, value=float(value), goal=goal, unit=unit, met=met)
        )

    def save(self, benchmark: Any) -> None:
        """Put the rows since the last time into a benchmark's JSON."""
        benchmark.extra_info['rows'] = self._rows[self._saved :]
        self._saved = len(self._rows)

    def table(self) -> str:
        """Write all rows for a person."""
        cells = [('what', 'measured', '', 'goal', '')]
        for row in self._rows:
            goal = '' if row['goal'] is None else f'<= {row["goal"]:g} {row["unit"]}'
            met = {True: 'met', False: 'NOT MET', None: ''}[row['met']]
            value = f'{row["value"]:.2f} {row["unit"]}'
            cells.append((row['what'], row['detail'], value, goal, met))
        widths = [max(map(len, column)) for column in zip(*cells, strict=True)]
        return '\n'.join(
            '  '.join(cell.ljust(width) for cell, width in zip(line, widths, strict=True)).rstrip()
            for line in cells
        )
