# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Quantiles of weighted sums of Gaussians."""

import math

import numpy as np
import numpy.typing as npt

from tactile_push.mechanics.compiled import Array, compiled

REACH = 4.5  # standard deviations beyond which a Gaussian is taken to have nothing
NEGLIGIBLE = 1e-6  # weight
EXACT = 1e-4  # error of the share
FINE = 1e-6  # last bracket, of the first one: where the mixture has a step
KIND_EXCLUDED = 0.02  # evidence of a kind of friction, of the best one's, that excludes it
LOWER, UPPER = 0.025, 0.975  # shares below the ends of an interval


@compiled
def quantile(weights: Array, means: Array, variances: Array, share: float) -> float:
    """Find the value below which a share of a mixture of Gaussians lies; variances may be 0."""
    total, mean, square = 0.0, 0.0, 0.0
    for h in range(len(weights)):
        total += weights[h]
        mean += weights[h] * means[h]
    mean /= total
    low, high = math.inf, -math.inf
    for h in range(len(weights)):
        square += weights[h] * (variances[h] + (means[h] - mean) ** 2)
        if weights[h] > NEGLIGIBLE * total:
            reach = REACH * math.sqrt(variances[h])
            low, high = min(low, means[h] - reach), max(high, means[h] + reach)
    narrow, turns = FINE * (high - low), 0
    # As of one Gaussian, whose outer quantiles are two deviations from the middle.
    value = min(max(mean + (4.0 * share - 2.0) * math.sqrt(square / total), low), high)
    while high - low > narrow:
        below, slope = 0.0, 0.0
        for h in range(len(weights)):
            if weights[h] > NEGLIGIBLE * total:
                distance, deviation = value - means[h], math.sqrt(variances[h])
                if distance > REACH * deviation:
                    below += weights[h]
                elif distance > -REACH * deviation:
                    far = distance / deviation
                    below += weights[h] * math.erfc(-far / math.sqrt(2.0)) / 2.0
                    slope += weights[h] * math.exp(-far * far / 2.0) / deviation
        excess = below / total - share
        if abs(excess) < EXACT:
            return value
        if excess < 0.0:
            low = value
        else:
            high = value
        turns += 1
        step = low - 1.0
        if slope > 0.0 and turns % 4 != 0:  # Newton's, which may go astray
            step = value - excess * total * math.sqrt(math.tau) / slope
        value = step if low < step < high else (low + high) / 2.0
    return (low + high) / 2.0


@compiled
def hull_of_intervals(
    weights: Array, means: Array, variances: Array, kinds: npt.NDArray[np.int64], shares: Array
) -> tuple[float, float]:
    """Find the hull of the 95 % intervals of several mixtures, one a kind of friction.

    `kinds` says to which one a Gaussian belongs, in rising order. Kinds whose evidence, the weight
    of all its Gaussians over its share of the prior, is far below the best one's are left out.
    """
    ends, evidence = np.zeros(len(shares) + 1, np.int64), np.zeros(len(shares))
    for h in range(len(kinds)):
        ends[kinds[h] + 1 :] = h + 1
        evidence[kinds[h]] += weights[h]
    evidence /= shares
    lower, upper = math.inf, -math.inf
    for kind in range(len(shares)):
        if evidence[kind] > KIND_EXCLUDED * evidence.max():
            first, last = ends[kind], ends[kind + 1]
            mixture = weights[first:last], means[first:last], variances[first:last]
            lower = min(lower, quantile(*mixture, LOWER))
            upper = max(upper, quantile(*mixture, UPPER))
    return lower, upper
