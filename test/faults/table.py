# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Goes through the rows and shows them."""

import json
from collections.abc import Callable, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.table import Table
from rich.text import Text

from .bench import Bench
from .machine import HoldUps
from .promise import BrokenPromiseError, Fault, Outcome, Setup

StartBench = Callable[[Setup], Bench]
STANDSTILL = 0.1  # of the machine, after which a broken row says nothing of the nodes [s]
ATTEMPTS = 3


def start_bench(setup: Setup, make: Callable[[Setup], Bench] = Bench) -> Bench:
    """Return a running bench.

    Parameters
    ----------
    setup : Setup
        What is to run.
    make : callable, optional
        Makes the bench.

    Returns
    -------
    Bench
        The bench, its controllers active.

    Raises
    ------
    BrokenPromiseError
        If it does not start; nothing is left of it then.
    """
    bench = make(setup)
    try:
        bench.start()
    except BaseException:
        bench.close()
        raise
    return bench


class Runner:
    """Injects faults, one after the other, and keeps a bench for as long as it is good.

    Parameters
    ----------
    start : callable, optional
        Gives a running bench.

    Attributes
    ----------
    outcomes : list of Outcome
        The rows so far.
    """

    def __init__(self, start: StartBench = start_bench) -> None:
        self._start = start
        self._bench: Bench | None = None
        self._hold_ups = HoldUps()
        self.outcomes: list[Outcome] = []

    def __enter__(self) -> 'Runner':
        """Enter the block after which everything has ended."""
        return self

    def __exit__(self, *exception: object) -> None:
        """End everything."""
        self._hold_ups.close()
        self._close()

    def run(self, fault: Fault) -> Outcome:
        """Measure a row; again if it is broken and the machine stood still meanwhile.

        Parameters
        ----------
        fault : Fault
            The row.

        Returns
        -------
        Outcome
            What came out.
        """
        for attempt in range(1, ATTEMPTS + 1):
            self._hold_ups.restart()
            outcome = self._measure(fault)
            held_up = self._hold_ups.longest
            if outcome.held or held_up < STANDSTILL:
                break
            outcome.broken.append(
                f'attempt {attempt}; the machine stood still for {1000.0 * held_up:.0f} ms'
            )
        self.outcomes.append(outcome)
        return outcome

    def _measure(self, fault: Fault) -> Outcome:
        within = None if fault.within is None else 1000.0 * fault.within
        outcome = Outcome(fault.name, fault.promise, within, None)
        try:
            bench = self._ready(fault.setup)
        except BrokenPromiseError as error:
            outcome.broken.append(f'before the fault: {error}')
            self._close()
            return outcome
        bench.reaction = None
        try:
            fault.inject(bench)
        except BrokenPromiseError as error:
            outcome.broken.append(str(error))
        if bench.reaction is not None:
            outcome.reaction_ms = 1000.0 * bench.reaction
        outcome.judge()
        outcome.broken += bench.complaints()
        if fault.last or outcome.broken:
            outcome.broken += self._close()
        return outcome

    def finish(self) -> None:
        """End the last bench; what was wrong with its end belongs to the last row."""
        complaints = self._close()
        if complaints:
            self.outcomes[-1].broken += complaints

    def _ready(self, setup: Setup) -> Bench:
        """Return a bench of this kind whose fingers push: the running one unless it is used up."""
        if self._bench is not None:
            if self._bench.setup == setup and self._bench.is_in_the_middle():
                self._push(self._bench)
                return self._bench
            self.finish()
        self._bench = self._start(setup)
        self._push(self._bench)
        return self._bench

    @staticmethod
    def _push(bench: Bench) -> None:
        for finger in bench.fingers:
            finger.push()

    def _close(self) -> list[str]:
        bench, self._bench = self._bench, None
        return bench.close() if bench is not None else []


def show(outcomes: Sequence[Outcome], console: Console) -> None:
    """Print one row each.

    Parameters
    ----------
    outcomes : sequence of Outcome
        The rows.
    console : Console
        Where to.
    """
    table = Table('fault', 'promise', 'v_x = 0 after', 'at most', '')
    for outcome in outcomes:
        table.add_row(
            outcome.fault,
            outcome.promise,
            _milliseconds(outcome.reaction_ms),
            _milliseconds(outcome.within_ms),
            Text(outcome.verdict, '' if outcome.held else 'bold red'),
        )
    console.print(table)
    for outcome in outcomes:
        for reason in outcome.broken:
            console.print(f'{outcome.fault}: {reason}', markup=False, highlight=False)


def write(outcomes: Sequence[Outcome], file: Path) -> None:
    """Write the rows as JSON.

    Parameters
    ----------
    outcomes : sequence of Outcome
        The rows.
    file : Path
        Where to.
    """
    rows: list[dict[str, Any]] = [asdict(outcome) | {'held': outcome.held} for outcome in outcomes]
    file.write_text(json.dumps({'faults': rows}, indent=2) + '\n')


def _milliseconds(value: float | None) -> str:
    return '' if value is None else f'{value:.0f} ms'
