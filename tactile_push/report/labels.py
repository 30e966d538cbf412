# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What is out of the ordinary: levels and words for what the nodes say in numbers."""

from typing import Any

import numpy as np
import numpy.typing as npt

from tactile_push.control import (
    INACTIVE,
    NOTHING_TO_DO,
    STATES,
    STOP_REASONS,
    STOPPED,
    WAITING,
)
from tactile_push.control.placing.stages import FAILURES, NO_GOAL, STAGES
from tactile_push.estimation import CONTRADICTIONS
from tactile_push.report.data import ERROR, NOTE, WARNING
from tactile_push.report.episodes import Label
from tactile_push.tactile import REFUSALS

# What the controller can be doing, in words.
DOING = (*STATES, *(f'{STOPPED}: {reason}' for reason in STOP_REASONS[1:]))
# Refusals that are no fault: a finger in the air, and a reading that came twice.
NO_FAULT = {'no contact': (NOTE, 'no contact'), 'not newer': None}
BOUNDS = {'saturated': 'φ at its bound', 'limited': 'v_x at its bound'}  # flags of a tick
OF_DIAGNOSTICS = (None, WARNING, ERROR, ERROR)  # ok, warn, error, stale
TICK_LASTS = 1.0  # the last state of the controller counts for ten periods of the paper [s]
STATUS_LASTS = 2.0  # a node's status counts for so long; it comes once a second [s]


def doing(state: npt.ArrayLike, reason: npt.ArrayLike) -> npt.NDArray[np.float64]:
    """Return which of `DOING` the controller does by `state` and `stop_reason` of its ticks."""
    states, reasons = np.asarray(state, dtype=float), np.asarray(reason, dtype=float)
    return np.where(reasons > 0.0, len(STATES) + reasons - 1.0, states)


def stop_label(state: float, reason: float) -> Label | None:
    """Return what is to be said of what the controller does."""
    if 0.0 < reason < len(STOP_REASONS):
        words = STOP_REASONS[int(reason)]
        return NOTE if words == NOTHING_TO_DO else ERROR, f'{STOPPED}: {words}'
    if 0.0 <= state < len(STATES) and STATES[int(state)] in (INACTIVE, WAITING):
        return NOTE, STATES[int(state)]
    return None


def bound_label(name: str, flag: float) -> Label | None:
    """Return what is to be said of a flag of `BOUNDS`."""
    return (NOTE, BOUNDS[name]) if flag > 0.0 else None


def refusal_label(number: float) -> Label | None:
    """Return what is to be said of what became of a reading."""
    if not 0.0 < number < len(REFUSALS):
        return None
    reason = REFUSALS[int(number)]
    return NO_FAULT.get(reason, (WARNING, f'refused: {reason}'))


def contradiction_label(number: float) -> Label | None:
    """Return what is to be said of how readings contradict the object."""
    if not 0.0 < number < len(CONTRADICTIONS):
        return None
    return ERROR, CONTRADICTIONS[int(number)]


def stage_label(number: float) -> Label | None:
    """Return what is to be said of what becomes of a goal."""
    if not 0.0 <= number < len(STAGES) or STAGES[int(number)] == NO_GOAL:
        return None
    stage = STAGES[int(number)]
    return WARNING if stage in FAILURES else NOTE, stage


def status_label(status: Any) -> Label | None:
    """Return what is to be said of a node's status on /diagnostics."""
    # rclpy has a byte for the level, a decoded bag a number.
    number = status.level[0] if isinstance(status.level, bytes) else status.level
    level = OF_DIAGNOSTICS[max(0, min(number, 3))]
    return None if level is None else (level, status.message)
