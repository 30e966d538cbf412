# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The paper's figures of merit, from the states that the controller published (Section V.C)."""

import math
from collections.abc import Iterable
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from tactile_push.control import PUSHING, STATES, STOP_REASONS, STOPPED, settle_step
from tactile_push.estimation import contact_of_translation, surface_direction
from tactile_push.paper import TRANSLATING_STEP, PaperFigures, Range, paper_figures
from tactile_push.report.columns import Column, Table

TIP = ('finger_x', 'psi')
KNOWN = 0.002  # d is known if its 95 % interval is no wider; the paper reads off 1.8 mm [m]
# What the figures are computed from.
OF_STEPS = ('theta', 'theta_desired', 'phi', 'v_x', 'saturated', 'limited')
FIELDS = (*OF_STEPS, 'silence', 'state', 'stop_reason', 'ticks', 'ticks_lost')
STILL = 1e-4  # a finger that wanders by less does not tell how its tip turns [m]
ROUNDING = 1e-9  # angles that differ by less are the same [rad]


@dataclass(frozen=True)
class Stop:
    """A time for which the finger was held."""

    reason: str  # one of `STOP_REASONS`
    at: float  # from the start of the bag [s]
    duration: float  # as far as is recorded, if it did not end [s]
    ended: bool  # whether it ended in the bag


@dataclass(frozen=True)
class PushFigures:
    """How well a finger pushed. What the bag does not tell is None."""

    states: int  # in the bag
    steps: int  # states in which the law acted: the steps of the paper, counted from 0
    missing: tuple[str, ...]  # fields that no state had: the bag is older than they are
    theta_desired: float | None  # at the last step, without its trim [rad]
    theta_desired_changes: int  # between steps
    trim_range: Range | None  # by how much steadying moved theta_desired, if it did [rad]
    band: float  # how near to it counts as settled [rad]
    settle_step: int | None  # step from which theta stays so near
    # Step from which theta_range, phi_range and d_range are taken: the paper's or, in a short run,
    # the beginning of its last third
    ranges_from: int
    theta_range: Range | None  # [rad]
    phi_range: Range | None  # [rad]
    l: float | None  # distance from the edge to the centre of mass [m]
    d_range: Range | None  # bounds on d by (17) [m]
    v_x_range: Range | None  # in all steps [m/s]
    saturated_share: float | None  # share of the steps in which phi was at a bound
    limited_share: float | None  # share of the steps in which v_x or its change was
    ticks: int | None  # over all activations
    ticks_lost: int | None  # control periods without a tick
    silence: float | None  # longest time without a contact after the first one [s]
    silence_at: float | None  # from the start of the bag [s]
    stops: list[Stop]
    paper: PaperFigures | None  # what the paper publishes of the same experiment


def push_figures(
    states: Table,
    band: float,
    l: float | None = None,
    pushed: str | None = None,
    lever: float = 0.0,
) -> PushFigures:
    """Compute how well a finger pushed.

    `states` are the columns of `push_controller/state`; 'stamp', if it is another time than 'time',
    is that of the header [s]. Theta counts as settled within `band` of its desired value as trimmed
    [rad]. `l` is the distance from the edge to the centre of mass [m], `pushed` is `BLOCK`, `DISK`
    or `OTHER`; both are None if they are not known. `lever` is the distance of the contact from the
    point of the tip that follows the commands [m].
    """
    time = states.get('time', np.empty(0))
    has_tip = all(name in states for name in TIP)
    column = {name: states.get(name, np.full(len(time), math.nan)) for name in FIELDS}
    state = column['state']
    # In a bag that is older than the field, theta is finite while the law acts.
    pushing = (state == STATES.index(PUSHING)) | (np.isnan(state) & np.isfinite(column['theta']))
    stopped = state == STATES.index(STOPPED)
    step = {name: column[name][pushing] for name in OF_STEPS}
    steps = int(pushing.sum())
    first = TRANSLATING_STEP if steps > TRANSLATING_STEP else steps - steps // 3
    theta, phi = step['theta'][first:], step['phi'][first:]
    turning = _turning(*(states[name][pushing][first:] for name in TIP)) if has_tip else 0.0
    trim = states.get('trim', np.zeros(len(time)))[pushing]
    desired = step['theta_desired'] - trim
    desired = desired[np.isfinite(desired)]
    theta_desired = float(desired[-1]) if len(desired) else None
    silence, silence_at = _longest_silence(time, column['silence'], pushing | stopped)
    return PushFigures(
        states=len(time),
        steps=steps,
        missing=tuple(name for name in FIELDS if name not in states),
        theta_desired=theta_desired,
        theta_desired_changes=int(np.count_nonzero(np.abs(np.diff(desired)) > ROUNDING)),
        trim_range=_range(trim) if trim.any() else None,
        band=band,
        settle_step=settle_step(step['theta'] - step['theta_desired'], 0.0, band),
        ranges_from=first,
        theta_range=_range(theta),
        phi_range=_range(phi),
        l=l,
        d_range=_d_range(theta, phi, l, turning, lever),
        v_x_range=_range(step['v_x']),
        saturated_share=_share(step['saturated']) if 'saturated' in states else None,
        limited_share=_share(step['limited']) if 'limited' in states else None,
        ticks=_count(column['ticks']) if 'ticks' in states else None,
        ticks_lost=_count(column['ticks_lost']) if 'ticks_lost' in states else None,
        silence=silence,
        silence_at=silence_at,
        stops=_stops(time, states.get('stamp', time), stopped, column['stop_reason']),
        paper=None if theta_desired is None else paper_figures(theta_desired, pushed),
    )


def known_step(
    steps: Iterable[float], told: Iterable[float], widths: Iterable[float]
) -> int | None:
    """Return the step from which on d is known for good, None if it is not known at the end.

    `steps` are the times of the steps, `told` those of the estimates [s], and `widths` the widths
    of the 95 % intervals of their d [m]. Steps after the last estimate do not count; a step without
    an estimate is not known.
    """
    by_stamp = dict(zip(told, widths, strict=True))
    last = max(by_stamp, default=-math.inf)
    found = [by_stamp.get(step, math.inf) for step in steps if step <= last]
    return settle_step(found, 0.0, KNOWN)


def _range(values: Column) -> Range | None:
    """Return the least and the greatest finite value."""
    values = values[np.isfinite(values)]
    return (float(values.min()), float(values.max())) if len(values) else None


def _turning(x: Column, psi: Column) -> float:
    """Return by how much the tip turns for each metre across the belt [rad/m], 0 if unknown."""
    known = np.isfinite(x) & np.isfinite(psi)
    x, psi = x[known], np.unwrap(psi[known])
    if len(x) < 2 or np.ptp(x) < STILL:
        return 0.0
    return float(np.polyfit(x - x.mean(), psi, 1)[0])


def _d_range(
    theta: Column, phi: Column, l: float | None, turning: float, lever: float
) -> Range | None:
    """Return the bounds on d by (17), which grows with the angle between surface and edge."""
    beta = np.array(
        [
            surface_direction(angle, push, turning, lever) - angle
            for angle, push in zip(theta, phi, strict=True)
        ]
    )
    bounds = _range(beta[(beta > 0.0) & (beta < math.pi)])
    if l is None or bounds is None:
        return None
    d_lower, d_upper = (contact_of_translation(0.0, bound, l) for bound in bounds)
    return d_lower, d_upper


def _share(flags: Column) -> float | None:
    return float(np.nansum(flags)) / len(flags) if len(flags) else None


def _count(counts: Column) -> int:
    """Return the total of a count that begins anew at each activation."""
    counts = counts[np.isfinite(counts)]
    finished = counts[:-1][np.diff(counts) < 0.0]
    return round(float(finished.sum() + counts[-1:].sum()))


def _longest_silence(
    time: Column, silence: Column, touched: np.ndarray
) -> tuple[float | None, float | None]:
    """Return the longest silence after the first contact, and when it was."""
    lasted = np.where(touched & ~np.isnan(silence), silence, -math.inf)
    longest = int(lasted.argmax()) if len(lasted) else 0
    if not len(lasted) or not math.isfinite(lasted[longest]):
        return None, None
    return float(lasted[longest]), float(time[longest])


def _stops(time: Column, stamp: Column, stopped: np.ndarray, reason: Column) -> list[Stop]:
    """Return the times for which the finger was held for one reason."""
    reason = np.where(stopped, reason, math.nan)
    changes = (stopped[1:] != stopped[:-1]) | (stopped[1:] & (reason[1:] != reason[:-1]))
    found = []
    for first, after in pairwise([0, *(np.flatnonzero(changes) + 1).tolist(), len(time)]):
        if first < after and stopped[first]:
            ended = after < len(time)
            known = reason[first] in range(len(STOP_REASONS))
            words = STOP_REASONS[int(reason[first])] if known else f'unknown ({reason[first]:g})'
            end = stamp[after] if ended else stamp[-1]
            found.append(Stop(words, float(time[first]), float(end - stamp[first]), ended))
    return found
