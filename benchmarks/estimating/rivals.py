# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What the estimator is compared with, for a known edge of a rectangle."""

import math

import numpy as np

from estimating.groups import BELT_SPEED, PERIOD, RADIUS, STEPS, C, Group, Run
from tactile_push.estimation.hypotheses import advance
from tactile_push.estimation.prior import ROUND
from tactile_push.mechanics.compiled import Array, compiled
from tactile_push.mechanics.resistance import Pressure, Push

PARTICLES = 4000
SHRINK = 0.98  # of Liu and West
NO_DIRECTION = np.array(ROUND)
WINDOW = 25  # readings over which the paper's method looks

Interval = tuple[float, float]


def push_of(v_x: float) -> Push:
    """Return the push of a control period."""
    return Push(v_x, BELT_SPEED, PERIOD)


@compiled
def advance_all(particles: Array, l: float, push: Push, moments: Array) -> None:
    """Push every particle for a control period."""
    for row in particles:
        pressure = Pressure(row[2], 0.0, 0.0, moments, 0.0)  # an ellipsoid, pushed at the belt
        end = advance(row[0], row[1], row[3], l, RADIUS, pressure, push, False)
        row[0], row[1] = end.theta, end.d


def particle_filter(group: Group, run: Run, rng: np.random.Generator) -> dict[int, Interval]:
    """Follow theta, d, c^2 and alpha by particles, their kernels shrunk as by Liu and West."""
    edge, count = group.edges[0], PARTICLES
    alpha = np.full(count, math.pi / 2.0)
    if not group.sticks:
        alpha = rng.choice(3, count, p=(0.25, 0.5, 0.25)) * math.pi / 4.0
        some = alpha == math.pi / 4.0
        alpha[some] = rng.uniform(0.0, math.pi / 2.0, some.sum())
    theta = run.reading[0] + group.noise * rng.standard_normal(count)
    particles = np.stack(
        [theta, rng.uniform(*edge.d, count), rng.uniform(*C, count) ** 2, alpha], axis=1
    )
    found = {}
    for k in range(1, len(run.reading)):
        advance_all(particles, edge.l, push_of(run.measured[k]), NO_DIRECTION)
        log_weights = -0.5 * ((run.reading[k] - particles[:, 0]) / group.noise) ** 2
        weights = np.exp(log_weights - log_weights.max())
        weights /= weights.sum()
        chosen = np.searchsorted(
            np.cumsum(weights), (np.arange(count) + rng.random()) / count
        ).clip(max=count - 1)
        particles = particles[chosen]
        # Liu and West: towards the mean and apart again, so that mean and covariance stay.
        moving = particles[:, :3]
        mean = moving.mean(axis=0)
        deviations = moving.std(axis=0)
        spread = np.cov((moving / np.maximum(deviations, 1e-12)).T) * (1.0 - SHRINK**2)
        noise = rng.multivariate_normal(np.zeros(3), spread, count, check_valid='ignore')
        particles[:, :3] = mean + SHRINK * (moving - mean) + deviations * noise
        particles[:, 2] = particles[:, 2].clip(C[0] ** 2, C[1] ** 2)
        if k in STEPS:
            lower, upper = np.quantile(particles[:, 1], (0.025, 0.975))
            found[k] = float(lower), float(upper)
    return found


def trajectory(theta: float, d: float, c: float, l: float, v_x: Array) -> tuple[Array, Array]:
    """Push a sticking contact along measured velocities: theta and d at every control period."""
    out, pressure = [(theta, d)], Pressure(c * c, 0.0, 0.0, NO_DIRECTION)
    for v in v_x[1:]:
        out.append(advance(*out[-1], math.pi / 2.0, l, RADIUS, pressure, push_of(v), False)[:2])
    thetas, ds = np.array(out).T
    return thetas, ds


def cramer_rao(group: Group, run: Run) -> dict[int, float]:
    """Give the width that no unbiased estimate of a sticking contact's d falls below [m]."""
    edge = group.edges[0]
    truth = np.array([run.theta[0], run.d[0], run.c])
    rows = []
    for i, step in enumerate((1e-6, 1e-7, 1e-7)):
        ends = []
        for sign in (step, -step):
            moved = truth.copy()
            moved[i] += sign
            ends.append(trajectory(*moved, edge.l, run.measured))
        rows.append([(a - b) / (2.0 * step) for a, b in zip(*ends, strict=True)])
    of_theta, of_d = (np.array([row[j] for row in rows]).T for j in (0, 1))
    prior = np.diag([0.0, 12.0 / edge.length**2, 12.0 / (C[1] - C[0]) ** 2])
    widths = {}
    for k in STEPS:
        if k < len(of_theta):
            seen = of_theta[: k + 1] / group.noise
            variance = of_d[k] @ np.linalg.solve(seen.T @ seen + prior, of_d[k])
            widths[k] = 2.0 * 1.96 * math.sqrt(variance)
    return widths


def by_translation(group: Group, run: Run) -> dict[int, Interval]:
    """Read off (17) over the last readings, as the paper does; the edge while theta changes."""
    (low, high), l, found = group.edges[0].d, group.edges[0].l, {}
    for k in STEPS:
        if k < len(run.reading):
            last = slice(max(0, k + 1 - WINDOW), k + 1)
            theta, beta = run.reading[last], run.phi[last] - run.reading[last]
            found[k] = low, high
            if k >= WINDOW and np.ptp(theta) <= 6.0 * group.noise:
                d = -l / np.tan(beta)
                found[k] = max(float(d.min()), low), min(float(d.max()), high)
    return found
