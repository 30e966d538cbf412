# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What a row of the table is: a fault, what is promised, what was measured, held or broken."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from tactile_push.interface import PUSH, SENTENCE

if TYPE_CHECKING:
    from .bench import Bench

# How long the finger may go on after a fault [s].
SILENT = 0.45  # contact_timeout, one control period, the way of the last reading and the command
ONE_PERIOD = 0.2  # a control period, the way of the command, a period of the plant
COMMAND_LOST = 0.6  # command_timeout of the plant, a period of its sensor, the way of the state
SIGNAL = 0.2
ASKED = 0.3  # the way of a request to a service, a control period, the way of the command
ESTIMATE_LOST = 0.8  # 5 control periods, the present one, the way of the estimate and the command
JOINTS_LOST = 0.3  # joint_state_timeout of the servo, the way of the last joint states and commands


class BrokenPromiseError(Exception):
    """Something did not happen that was promised, or did that must not; the message says what."""


@dataclass(frozen=True)
class Setup:
    """The bench that a fault needs.

    Parameters
    ----------
    fingers : tuple of str
        Namespace of each finger with its plant; '' is the root. None: only nodes without a bench.
    relay : str, optional
        The topic whose messages pass through the tool, which can spoil them; '' for none.
    sensor : str, optional
        What the fingers feel with, one of `interface.SENSORS`.
    own_clock : bool, optional
        Whether the tool publishes /clock and all nodes live by it.
    servo : bool, optional
        Whether `finger_servo` moves the joints of the plant's finger.
    law : str, optional
        The controller's law, one of `interface.LAWS`; `active_sensing` runs beside one that needs
        it.
    controller, sensing, plant : tuple of (str, object), optional
        More parameters of `push_controller`, of `active_sensing` and of the plant.
    """

    fingers: tuple[str, ...] = ('',)
    relay: str = ''
    sensor: str = SENTENCE
    own_clock: bool = False
    servo: bool = False
    law: str = PUSH
    controller: tuple[tuple[str, Any], ...] = ()
    sensing: tuple[tuple[str, Any], ...] = ()
    plant: tuple[tuple[str, Any], ...] = ()


PLAIN = Setup()
NO_BENCH = Setup(fingers=())


@dataclass(frozen=True)
class Fault:
    """A row to be measured.

    Parameters
    ----------
    name : str
        The fault in a few words.
    promise : str
        What is promised.
    inject : callable
        Does it to a running bench; raises `BrokenPromiseError` if a promise is broken. The bench
        keeps the reaction that it measured.
    within : float or None
        Bound on the reaction [s]; None if the finger need not stop.
    setup : Setup
        The bench that it needs.
    last : bool
        Whether nothing can be done with the bench afterwards.
    """

    name: str
    promise: str
    inject: Callable[['Bench'], None]
    within: float | None = None
    setup: Setup = PLAIN
    last: bool = False


@dataclass
class Outcome:
    """A row as measured.

    Parameters
    ----------
    fault, promise : str
        What was done and promised.
    within_ms, reaction_ms : float or None
        Promised and measured time from the fault to v_x = 0 [ms].
    broken : list of str
        What was not as promised; empty if all was.
    """

    fault: str
    promise: str
    within_ms: float | None
    reaction_ms: float | None
    broken: list[str] = field(default_factory=list)

    @property
    def held(self) -> bool:
        """Whether the promise was held."""
        return not self.broken

    @property
    def verdict(self) -> str:
        """'held' or 'BROKEN'."""
        return 'held' if self.held else 'BROKEN'

    def judge(self) -> None:
        """Compare the reaction with its bound."""
        if self.within_ms is None:
            return
        if self.reaction_ms is None:
            self.broken.append('no reaction was measured')
        elif self.reaction_ms > self.within_ms:
            self.broken.append(f'{self.reaction_ms:.0f} ms, more than {self.within_ms:.0f} ms')


FAULTS: list[Fault] = []  # in the order of the table


def fault(
    name: str,
    within: float | None = None,
    *,
    setup: Setup = PLAIN,
    last: bool = False,
) -> Callable[[Callable[['Bench'], None]], Callable[['Bench'], None]]:
    """Make a row of a function that injects a fault, its docstring the promise; see `Fault`."""

    def add(inject: Callable[['Bench'], None]) -> Callable[['Bench'], None]:
        promise = ' '.join((inject.__doc__ or '').split()).removesuffix('.')
        FAULTS.append(Fault(name, promise, inject, within, setup, last))
        return inject

    return add
