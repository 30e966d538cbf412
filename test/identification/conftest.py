# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Noisy pushes with known numbers, and what they are taken for."""

from dataclasses import replace

import numpy as np
import pytest

from support.measured_pushes import OUTLINE, RADIUS, integrated, sided_ways
from tactile_push.identification import models
from tactile_push.identification.records import Push, Pushes
from tactile_push.mechanics import Pose, Support

COUNT, NOISE, LENGTH = 28, 2e-4, 0.02  # pushes, of positions [m], by which angles are lengths [m]
MU_C, OFFSET = 0.3, (0.0015, -0.001)
UNTOUCHED, FAR = 5, 12  # indices of the bad ones


@pytest.fixture(scope='session')
def truth():
    """Return the support of the pushes."""
    even = Support.spread(OUTLINE, 1.4, 40)
    return even.carrying((even.centre[0] + OFFSET[0], even.centre[1] + OFFSET[1]))


@pytest.fixture(scope='session')
def noisy(truth):
    """Return pushes that something else than the package's mechanics has computed, with noise."""
    ways = list(sided_ways(COUNT, 3, (0.35, 0.65)))
    noise = NOISE * np.random.default_rng(8).normal(size=(COUNT, 3)) / [1.0, 1.0, LENGTH]
    ends = integrated(truth, MU_C, ways) + noise
    return Pushes(
        OUTLINE,
        tuple(
            Push(f'push {k}', Pose(*start), Pose(*end), tuple(tips), RADIUS)
            for k, ((start, tips, _), end) in enumerate(zip(ways, ends.tolist(), strict=True))
        ),
    )


@pytest.fixture(scope='session')
def identified(noisy):
    """Return what is found of the pushes, two of which are bad."""
    pytest.importorskip('scipy', reason="pip install 'tactile_push[camera]'")
    from tactile_push.identification.identify import identify

    pushes = list(noisy.pushes)
    begin, end, way, radius = pushes[UNTOUCHED][1:5]
    aside = tuple((x + 1.0, y) for x, y in way)
    pushes[UNTOUCHED] = Push('never touched', begin, end, aside, radius)
    bad = pushes[FAR]
    pushes[FAR] = bad._replace(name='far off', end=bad.end._replace(x=bad.end.x + 0.02))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(models, 'POINTS', 40)
        return identify(replace(noisy, pushes=tuple(pushes)))
