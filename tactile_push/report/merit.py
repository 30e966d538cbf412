# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The paper's figures of merit, from the states that the controller published (Section V.C)."""

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from tactile_push.control import PUSHING, STATES, STOP_REASONS, STOPPED, settle_step
from tactile_push.estimation import contact_of_translation
from tactile_push.paper import (
    BLOCK,
    BLOCK_EDGE,
    BLOCK_L,
    DISK,
    DISK_RADIUS,
    OTHER,
    TRANSLATING_STEP,
    PaperFigures,
    Range,
    paper_figures,
)
from tactile_push.report.columns import Column, Table

KNOWN = 0.002  # d is known if its 95 % interval is no wider; the paper reads off 1.8 mm [m]
# The parameters of `sim_plant` that are the sizes of an object, l last, and the paper's values.
SIZES = {
    BLOCK: {'edge_length': BLOCK_EDGE, 'edge_to_cm': BLOCK_L},
    DISK: {'disk_radius': DISK_RADIUS},
}
# What the figures are computed from.
OF_STEPS = ('theta', 'theta_desired', 'phi', 'v_x', 'saturated', 'limited')
FIELDS = (*OF_STEPS, 'silence', 'state', 'stop_reason', 'ticks', 'ticks_lost')


@dataclass(frozen=True)
class Stop:
    """A time for which the finger was held.

    Parameters
    ----------
    reason : str
        Why: one of `STOP_REASONS`.
    at : float
        When it began [s], from the start of the bag.
    duration : float
        How long it took [s]; as far as is recorded, if it did not end.
    ended : bool
        Whether it ended in the bag.
    """

    reason: str
    at: float
    duration: float
    ended: bool


@dataclass(frozen=True)
class PushFigures:
    """How well a finger pushed. What the bag does not tell is None.

    Parameters
    ----------
    states : int
        States in the bag.
    steps : int
        Those in which the law acted: the steps of the paper, counted from 0.
    missing : tuple of str
        Fields that no state had: the bag is older than they are.
    theta_desired : float or None
        Desired angle at the last step [rad].
    theta_desired_changes : int
        How often it was changed between steps.
    band : float
        How near to it counts as settled [rad].
    settle_step : int or None
        Step from which theta stays so near.
    ranges_from : int
        Step from which the following ranges are taken: the paper's or, in a shorter run, the
        beginning of its last third.
    theta_range, phi_range : tuple of float or None
        Least and greatest angle [rad].
    l : float or None
        Distance from the edge to the centre of mass [m].
    d_range : tuple of float or None
        Bounds on d by (17) [m].
    v_x_range : tuple of float or None
        Least and greatest command in all steps [m/s].
    saturated_share, limited_share : float or None
        Share of the steps in which phi was at a bound, and v_x or its change.
    ticks, ticks_lost : int or None
        Ticks of the controller, and control periods without one, over all activations.
    silence : float or None
        Longest time without a contact after the first one [s].
    silence_at : float or None
        When that was [s], from the start of the bag.
    stops : list of Stop
        When the finger was held.
    paper : PaperFigures or None
        What the paper publishes of the same experiment.
    """

    states: int
    steps: int
    missing: tuple[str, ...]
    theta_desired: float | None
    theta_desired_changes: int
    band: float
    settle_step: int | None
    ranges_from: int
    theta_range: Range | None
    phi_range: Range | None
    l: float | None
    d_range: Range | None
    v_x_range: Range | None
    saturated_share: float | None
    limited_share: float | None
    ticks: int | None
    ticks_lost: int | None
    silence: float | None
    silence_at: float | None
    stops: list[Stop]
    paper: PaperFigures | None


def push_figures(
    states: Table, band: float, l: float | None = None, pushed: str | None = None
) -> PushFigures:
    """Compute how well a finger pushed.

    Parameters
    ----------
    states : dict of str to ndarray
        The columns of `push_controller/state`: those of `FIELDS` that were recorded, 'time' [s]
        from the start of the bag and, if it is another one, 'stamp' by the header [s].
    band : float
        How near to the desired angle counts as settled [rad].
    l : float, optional
        Distance from the edge to the centre of mass [m], if it is known.
    pushed : str, optional
        What is pushed, if it is known: `BLOCK`, `DISK` or `OTHER` of `tactile_push.paper`.

    Returns
    -------
    PushFigures
        The figures of merit.
    """
    time = states.get('time', np.empty(0))
    column = {name: states.get(name, np.full(len(time), math.nan)) for name in FIELDS}
    state = column['state']
    # A bag that is older than the field tells it by theta.
    pushing = (state == STATES.index(PUSHING)) | (np.isnan(state) & np.isfinite(column['theta']))
    stopped = state == STATES.index(STOPPED)
    step = {name: column[name][pushing] for name in OF_STEPS}
    steps = int(pushing.sum())
    first = TRANSLATING_STEP if steps > TRANSLATING_STEP else steps - steps // 3
    theta, phi = step['theta'][first:], step['phi'][first:]
    desired = step['theta_desired'][np.isfinite(step['theta_desired'])]
    theta_desired = float(desired[-1]) if len(desired) else None
    silence, silence_at = _longest_silence(time, column['silence'], pushing | stopped)
    return PushFigures(
        states=len(time),
        steps=steps,
        missing=tuple(name for name in FIELDS if name not in states),
        theta_desired=theta_desired,
        theta_desired_changes=int(np.count_nonzero(np.diff(desired))),
        band=band,
        settle_step=settle_step(step['theta'] - step['theta_desired'], 0.0, band),
        ranges_from=first,
        theta_range=_range(theta),
        phi_range=_range(phi),
        l=l,
        d_range=_d_range(phi - theta, l),
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


def plant_object(plant: Mapping[str, object]) -> tuple[str | None, float | None]:
    """Return what the simulated plant pushes.

    Parameters
    ----------
    plant : mapping of str to object
        The parameters of `sim_plant`, as far as they are known.

    Returns
    -------
    pushed : str or None
        `BLOCK`, `DISK` or `OTHER` of `tactile_push.paper`; None if it is not known.
    l : float or None
        Distance from its edge or tangent to its centre of mass [m], if it is known.
    """
    if 'object' not in plant:
        return None, None
    named = str(plant['object'])
    sizes = SIZES.get(named, {})
    given = {name: plant[name] for name in sizes if name in plant}
    l = given.get(list(sizes)[-1]) if sizes else None
    return (
        named if sizes and all(given[name] == sizes[name] for name in given) else OTHER,
        l if isinstance(l, float) and math.isfinite(l) and l > 0.0 else None,
    )


def known_step(
    steps: Iterable[float], told: Iterable[float], widths: Iterable[float]
) -> int | None:
    """Find the step from which on d is known.

    Parameters
    ----------
    steps : iterable of float
        When the law acted: the stamps of the steps of the paper, which count from 0 [s].
    told : iterable of float
        The stamps of the control periods of which estimates tell [s].
    widths : iterable of float
        How wide the 95 % intervals of their d are [m].

    Returns
    -------
    int or None
        The first step of which, as of all after it of which estimates tell, the interval is not
        wider than `KNOWN`; None if it is wider at the end. What is forgotten later was not known
        for good.
    """
    by_stamp = dict(zip(told, widths, strict=True))
    last = max(by_stamp, default=-math.inf)
    found = [by_stamp.get(step, math.inf) for step in steps if step <= last]
    return settle_step(found, 0.0, KNOWN)


def _range(values: Column) -> Range | None:
    """Return the least and the greatest finite value."""
    values = values[np.isfinite(values)]
    return (float(values.min()), float(values.max())) if len(values) else None


def _d_range(beta: Column, l: float | None) -> Range | None:
    """Return the bounds on d by (17), which grows with beta = phi - theta."""
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
