# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Which of many goals can be reached from one start, and why the others cannot."""

from collections.abc import Callable, Sequence
from concurrent.futures import as_completed
from dataclasses import dataclass

from tactile_push.control.placing.model import Goal
from tactile_push.control.placing.reachability import Reach, Task, reach
from tactile_push.threads import on_all_cores


@dataclass(frozen=True)
class ReachableSet:
    """What `reach` says of the goals of a grid."""

    xs: tuple[float, ...]  #: of the centre of mass across the belt [m]
    thetas: tuple[float, ...]  #: angles of the edge [rad]
    #: verdict and reason of each goal, a row for each theta
    told: tuple[tuple[tuple[str, str], ...], ...]

    def count(self, verdict: str, reason: str = '') -> int:
        """Return how many goals have a verdict for a reason."""
        return sum(row.count((verdict, reason)) for row in self.told)


def reachable_set(
    task: Task,
    xs: Sequence[float],
    thetas: Sequence[float],
    progress: Callable[[int], None] = lambda done: None,
) -> ReachableSet:
    """Find out about the goals of a grid, on all cores.

    The plans are compiled functions that let other threads run. An exception, such as that of
    Ctrl-C, ends it after the plans that are being made.

    Parameters
    ----------
    task : Task
        From where.
    xs, thetas : sequence of float
        Places of the centre of mass [m] and angles of the edge [rad].
    progress : callable, optional
        Told how many goals are done.

    Returns
    -------
    ReachableSet
        What is said of them; the same every time.
    """
    found: dict[tuple[int, int], Reach] = {}
    with on_all_cores() as pool:
        tasks = {
            pool.submit(reach, task, Goal(x, theta)): (row, column)
            for row, theta in enumerate(thetas)
            for column, x in enumerate(xs)
        }
        for done, one in enumerate(as_completed(tasks), 1):
            found[tasks[one]] = one.result()
            progress(done)
    told = [[found[row, column] for column in range(len(xs))] for row in range(len(thetas))]
    words = tuple(tuple((one.verdict, one.reason) for one in row) for row in told)
    return ReachableSet(tuple(xs), tuple(thetas), words)
