# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What a soak has measured, and whether it is as it must be."""

from collections import Counter
from dataclasses import asdict, dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt

MOST_GROWTH = 1.0  # of a process's memory [MB/h of simulated time]
NOISE = 1.0  # by which memory may differ at any time [MB]
WARM_UP = 0.2  # share of a process's life, at its beginning, whose memory does not count


@dataclass
class Report:
    """What was measured.

    Parameters
    ----------
    seed : int
        Of the faults.
    hours : float
        Simulated time [h].
    real_time_factor : float
        Simulated seconds a second.
    ticks, ticks_lost, ticks_lost_in_faults : int
        Ticks of the controller, and control periods without one outside and inside of faults.
    memory : dict of str to list of (float, float)
        Of each process: simulated time [h] and memory [MB].
    outcomes : list of (str, str)
        Of each episode: the fault, and 'settled', 'stopped: REASON' or what else became of it.
    broken : list of str
        What else was wrong.
    """

    seed: int
    hours: float = 0.0
    real_time_factor: float = 0.0
    ticks: int = 0
    ticks_lost: int = 0
    ticks_lost_in_faults: int = 0
    memory: dict[str, list[tuple[float, float]]] = field(default_factory=dict)
    outcomes: list[tuple[str, str]] = field(default_factory=list)
    broken: list[str] = field(default_factory=list)

    def growth(self, process: str) -> float:
        """Return the slope of a process's memory after the warm-up.

        Parameters
        ----------
        process : str
            Its name.

        Returns
        -------
        float
            By least squares [MB/h]; 0 if there is too little to tell.
        """
        samples = self._warm(process)
        if len(samples) < 3:
            return 0.0
        return float(np.polyfit(samples[:, 0], samples[:, 1], 1)[0])

    def _warm(self, process: str) -> npt.NDArray[np.float64]:
        """Return the samples of a process after its own warm-up."""
        samples = np.array(self.memory[process])
        return samples[round(WARM_UP * len(samples)) :]

    def complaints(self) -> list[str]:
        """Say what is not as it must be.

        Returns
        -------
        list of str
            Nothing if all is well.
        """
        found = list(self.broken)
        for process in self.memory:
            growth = self.growth(process)
            times = self._warm(process)[:, 0]
            if growth > MOST_GROWTH and growth * np.ptp(times) > NOISE:
                found.append(f'{process}: memory grows by {growth:.2f} MB/h')
        if self.ticks_lost:
            found.append(f'{self.ticks_lost} ticks lost outside faults')
        found += [
            f'{fault}: {outcome}'
            for fault, outcome in self.outcomes
            if outcome != 'settled' and not outcome.startswith('stopped: ')
        ]
        return found

    def as_json(self) -> dict[str, Any]:
        """Return the report as JSON has it.

        Returns
        -------
        dict
            All fields, the growth of each process [MB/h] and the complaints.
        """
        return asdict(self) | {
            'memory': {
                name: {'samples': samples, 'growth_mb_per_h': self.growth(name)}
                for name, samples in self.memory.items()
            },
            'complaints': self.complaints(),
        }

    def lines(self) -> list[str]:
        """Return the report for people.

        Returns
        -------
        list of str
            One line each.
        """
        counted = Counter(outcome for _, outcome in self.outcomes)
        return [
            f'simulated         {self.hours:.2f} h at {self.real_time_factor:.1f} times real time',
            f'ticks             {self.ticks}, lost {self.ticks_lost} outside faults, '
            f'{self.ticks_lost_in_faults} in faults',
            f'episodes          {len(self.outcomes)}: '
            + ', '.join(f'{outcome} {count}' for outcome, count in counted.most_common()),
            *(
                f'{name:18}{samples[0][1]:.1f} MB, at the end {samples[-1][1]:.1f} MB, '
                f'after the warm-up {self.growth(name):+.2f} MB/h'
                for name, samples in self.memory.items()
                if samples
            ),
        ]
