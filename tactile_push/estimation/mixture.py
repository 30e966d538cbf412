# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Quantiles of a weighted sum of Gaussians."""

import math

from tactile_push.mechanics.compiled import Array, compiled

REACH = 4.5  # standard deviations beyond which a Gaussian is taken to have nothing
NEGLIGIBLE = 1e-6  # weight
EXACT = 1e-4  # error of the share
FINE = 1e-6  # last bracket, of the first one: where the mixture has a step


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
