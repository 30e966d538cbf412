# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Experiments of a group, and what their figures are."""

import math
import time
from dataclasses import dataclass, field
from statistics import median
from typing import Any

import numpy as np

from estimating.groups import BELT_SPEED, GROUPS, PERIOD, STEPS, Group, Run, experiment
from estimating.rivals import Interval, by_translation, cramer_rao, particle_filter
from tactile_push.estimation import FingerMotion
from tactile_push.mechanics.compiled import Array

CERTAIN = 0.95  # weight of an edge that counts as found


@dataclass
class Outcome:
    """What one experiment showed."""

    truth: dict[int, float] = field(default_factory=dict)  # d after every one of the steps [m]
    intervals: dict[str, dict[int, Interval]] = field(default_factory=dict)  # a method each
    cramer_rao: dict[int, float] = field(default_factory=dict)
    leads: dict[int, bool] = field(default_factory=dict)  # whether the pushed edge does
    found: int | None = None  # the step from which the pushed edge, or one alike, is certain
    misled: bool = False  # whether another edge was certain at the end
    contradiction: str = ''  # the first one
    ticks: int = 0
    cost: float = 0.0  # CPU time of all ticks [s]
    worst: float = 0.0  # that of the dearest ten ticks in a row [s]


def followed(group: Group, run: Run) -> Array:
    """Give the finger's mean velocities as they follow from its commands."""
    motion, ways = FingerMotion(group.lag), [0.0]
    motion.reset(0.0)
    for k, command in enumerate(run.command[1:]):
        motion.command(k * PERIOD, command)
        ways.append(motion.way((k + 1) * PERIOD))
    return np.array(ways) / PERIOD


def observe(group: Group, run: Run) -> Outcome:
    """Give the readings of a run to the estimator."""
    outcome, estimator = Outcome(), group.estimator()
    edges = {edge.number: edge for edge in group.edges}
    pushed = edges[run.edge]
    alike = np.array([edge.same_place(pushed, 1e-9) for edge in group.edges])
    velocity = followed(group, run) if group.commanded else run.measured
    within = np.abs(run.reading - run.theta).max() <= 5.0 * group.noise
    ours: dict[int, Interval] = {}
    safe: dict[int, Interval] = {}
    costs = []
    for duration in (0.0, PERIOD):  # code is compiled, or loaded
        estimator.push(run.reading[0], 0.0, BELT_SPEED, duration)
    estimator.reset()
    for k, (reading, v_x) in enumerate(zip(run.reading, velocity, strict=True)):
        start = time.process_time()
        estimate = estimator.push(reading, v_x, BELT_SPEED, PERIOD if k else 0.0)
        costs.append(time.process_time() - start)
        outcome.contradiction = outcome.contradiction or estimate.contradiction
        weight = float(estimate.weights[alike].sum())
        if weight <= CERTAIN:
            outcome.found = None
        elif outcome.found is None:
            outcome.found = k
        if k in STEPS:
            outcome.truth[k] = run.d[k]
            outcome.leads[k] = bool(alike[estimate.edge])
            ours[k] = estimate.d.lower, estimate.d.upper
            safe[k] = estimate.d.least, estimate.d.most
    outcome.misled = 1.0 - weight > CERTAIN
    outcome.intervals['estimator'] = ours
    if within:
        outcome.intervals['guaranteed'] = safe
    outcome.ticks, outcome.cost = len(costs), sum(costs)
    outcome.worst = max(np.convolve(costs, np.ones(10) / 10.0, 'valid'), default=math.nan)
    return outcome


def make(index: int, seed: int, numbers: range) -> tuple[int, list[Outcome]]:
    """Make some experiments of a group."""
    group, outcomes = GROUPS[index], []
    for number in numbers:
        rng = np.random.default_rng((seed, number))
        run = experiment(group, rng)
        outcome = observe(group, run)
        if group.edge_known:
            outcome.intervals['translation (17)'] = by_translation(group, run)
        if group.rivals:
            outcome.intervals['particles'] = particle_filter(group, run, rng)
        if group.sticks and group.shares == 0.0:
            outcome.cramer_rao = cramer_rao(group, run)
        outcomes.append(outcome)
    return index, outcomes


def figures(group: Group, outcomes: list[Outcome]) -> dict[str, Any]:
    """Give coverage, median width [mm] and number after every step, for every method."""
    result: dict[str, Any] = {}
    for method in ('estimator', 'guaranteed', 'particles', 'translation (17)'):
        rows = {}
        for step in STEPS:
            pairs = [
                (one.intervals[method][step], one.truth[step])
                for one in outcomes
                if step in one.intervals.get(method, {})
            ]
            if pairs:
                rows[str(step)] = {
                    'coverage': sum(low <= d <= high for (low, high), d in pairs) / len(pairs),
                    'width_mm': 1e3 * median(high - low for (low, high), _ in pairs),
                    'experiments': len(pairs),
                }
        result[method] = rows
    result['cramer_rao_mm'] = {
        str(step): 1e3 * median(one.cramer_rao[step] for one in outcomes if step in one.cramer_rao)
        for step in STEPS
        if any(step in one.cramer_rao for one in outcomes)
    }
    if not group.edge_known:
        found = [one.found for one in outcomes if one.found is not None]
        result['edge'] = {
            'leads': {
                str(step): float(
                    np.mean([one.leads[step] for one in outcomes if step in one.leads])
                )
                for step in STEPS
                if any(step in one.leads for one in outcomes)
            },
            'found': len(found) / len(outcomes),
            'found_at_step': median(found) if found else None,
            'misled': sum(one.misled for one in outcomes) / len(outcomes),
        }
    reasons = [one.contradiction for one in outcomes if one.contradiction]
    result['contradictions'] = {reason: reasons.count(reason) for reason in sorted(set(reasons))}
    result['milliseconds_a_tick'] = {
        'mean': 1e3 * sum(one.cost for one in outcomes) / sum(one.ticks for one in outcomes),
        'dearest_ten': 1e3 * max(one.worst for one in outcomes),
    }
    return result
