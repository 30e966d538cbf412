# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""How noisy theta is, and which gain that allows."""

import math
from collections.abc import Iterator, Sequence

from tactile_push.doctor.finding import RIGHT, WRONG, Finding
from tactile_push.doctor.messages import push_values
from tactile_push.doctor.snapshot import Snapshot
from tactile_push.interface import CONTROLLER_STATE, PUSH_CONTROLLER

# Noise of 0.5° lets phi jitter by as much with the paper's gains, and the block settles in 200 of
# 200 runs (docs/studies.md).
MOST_JITTER = math.radians(2.5)
FEWEST = 10  # triples of control periods; with fewer the noise is off by half


def gains_bear_the_noise(seen: Snapshot) -> Iterator[Finding]:
    """Ask by how much the noise of theta lets the law's phi jitter."""
    heard = seen.heard.get(CONTROLLER_STATE)
    noise = noise_of([values.get('theta', math.nan) for values in heard.values] if heard else ())
    if math.isnan(noise):
        return
    kd = push_values(seen).kd
    # The terms kd (theta(k) - theta(k-1)) of (18) add up to kd (theta(k) - theta(0)).
    words = (
        f'noise of {math.degrees(noise):.2f}° lets phi jitter by {math.degrees(kd * noise):.1f}°'
    )
    most = MOST_JITTER / noise if noise > 0.0 else math.inf
    bound = f'kd up to {most:.3g} keeps that below {math.degrees(MOST_JITTER):g}°'
    if kd <= most:
        yield Finding(RIGHT, 'theta', f'{words} with kd = {kd:g}; {bound}')
    else:
        yield Finding(
            *(WRONG, 'theta', f'{words} with kd = {kd:g}'),
            f'lower kd of {PUSH_CONTROLLER}, or filter the readings; {bound}',
        )


def noise_of(theta: Sequence[float]) -> float:
    """Return the standard deviation of the noise of equidistant angles.

    Parameters
    ----------
    theta : sequence of float
        Angle of the edge at each control period, NaN without a contact [rad].

    Returns
    -------
    float
        From second differences, which an edge that turns steadily does not change; those of
        independent noise have 1 + 4 + 1 times its variance [rad]. NaN if there are too few.
    """
    triples = zip(theta, theta[1:], theta[2:], strict=False)
    bends = [before - 2.0 * here + after for before, here, after in triples]
    bends = [bend for bend in bends if math.isfinite(bend)]
    if len(bends) < FEWEST:
        return math.nan
    return math.sqrt(sum(bend * bend for bend in bends) / (6.0 * len(bends)))
