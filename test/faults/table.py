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

from .machine import HoldUps
from .promise import BrokenPromiseError, Fault, Outcome, Setup
from .rig import Rig

StartRig = Callable[[Setup], Rig]
STANDSTILL = 0.1  # of the machine, after which a broken row says nothing of the nodes [s]
ATTEMPTS = 3


def start_rig(setup: Setup) -> Rig:
    """Give a running rig.

    Parameters
    ----------
    setup : Setup
        What is to run.

    Returns
    -------
    Rig
        The rig, its controllers active.

    Raises
    ------
    BrokenPromiseError
        If it does not start; nothing is left of it then.
    """
    rig = Rig(setup)
    try:
        rig.start()
    except BaseException:
        rig.close()
        raise
    return rig


class Runner:
    """Injects faults, one after the other, and keeps a rig for as long as it is good.

    Parameters
    ----------
    start : callable, optional
        Gives a running rig.

    Attributes
    ----------
    outcomes : list of Outcome
        The rows so far.
    """

    def __init__(self, start: StartRig = start_rig) -> None:
        self._start = start
        self._rig: Rig | None = None
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
            rig = self._ready(fault.setup)
        except BrokenPromiseError as error:
            outcome.broken.append(f'before the fault: {error}')
            self._close()
            return outcome
        rig.reaction = None
        try:
            fault.inject(rig)
        except BrokenPromiseError as error:
            outcome.broken.append(str(error))
        if rig.reaction is not None:
            outcome.reaction_ms = 1000.0 * rig.reaction
        outcome.judge()
        outcome.broken += rig.complaints()
        if fault.last or outcome.broken:
            outcome.broken += self._close()
        return outcome

    def finish(self) -> None:
        """End the last rig; what was wrong with its end belongs to the last row."""
        complaints = self._close()
        if complaints:
            self.outcomes[-1].broken += complaints

    def _ready(self, setup: Setup) -> Rig:
        """Give a rig of this kind whose fingers push: the one that runs, unless it is used up."""
        if self._rig is not None:
            if self._rig.setup == setup and self._rig.is_in_the_middle():
                self._push(self._rig)
                return self._rig
            self.finish()
        self._rig = self._start(setup)
        self._push(self._rig)
        return self._rig

    @staticmethod
    def _push(rig: Rig) -> None:
        for finger in rig.fingers:
            finger.push()

    def _close(self) -> list[str]:
        rig, self._rig = self._rig, None
        return rig.close() if rig is not None else []


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
