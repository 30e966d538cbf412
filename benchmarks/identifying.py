# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""How often what is identified from noisy pushes is within its standard deviations of the truth.

    python benchmarks/identifying.py [--runs N] [--pushes N] [--noise-mm MM]

Each run makes up an object: four corners, a load between the centroid and the corners, a centre of
friction off the centroid by as much as the prior has it, and mu_c from 0.1 to 0.5. The package's
mechanics pushes it, normal noise is added to the final poses, and one of the pushes is spoilt.
"""

import argparse
import math
import sys

import numpy as np
from rich.console import Console
from rich.progress import track

from tactile_push.identification import models
from tactile_push.identification.identify import identify
from tactile_push.identification.records import Push, Pushes
from tactile_push.mechanics import Outline, Pose, Slider, Support

RADIUS, BEFORE, WAY, ASIDE = 0.005, 0.003, 0.02, 0.01  # of the tip, its gap and way [m]
POINTS = 60  # of a support, in the fit as well
FAR = 0.05  # by which a bad record is wrong [m]


def main() -> int:
    """Run the benchmark."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--runs', type=int, default=100)
    parser.add_argument('--pushes', type=int, default=40)
    parser.add_argument('--noise-mm', type=float, default=0.3)
    options = parser.parse_args()
    models.POINTS = POINTS
    scores: dict[str, list[float]] = {}
    found = 0
    runs = track(range(options.runs), console=Console(stderr=True))
    try:
        for run in runs:
            pushes, truth = made_up(run, options.pushes, 1e-3 * options.noise_mm)
            result = identify(pushes)
            found += [bad.name for bad in result.pushes.bad] == ['bad']
            for name, value in result.fit.values.items():
                score = (value - truth[name]) / result.fit.deviations[name]
                scores.setdefault(name, []).append(score)
    except KeyboardInterrupt:
        return 130
    print(f'the bad record alone is named in {found} of {options.runs} runs')
    for name, values in scores.items():
        sizes = np.abs(values)
        within = ', '.join(f'{np.mean(sizes < k):.0%} within {k}' for k in (1, 2, 3))
        print(f'{name:5} {within} deviations, RMS {math.sqrt(np.mean(sizes**2)):.2f}')
    return 0


def made_up(seed: int, count: int, noise: float) -> tuple[Pushes, dict[str, float]]:
    """Return noisy pushes of an object, and the numbers that are true of it."""
    random = np.random.default_rng(seed)
    corners = np.array([[-0.03, -0.03], [0.03, -0.03], [0.03, 0.03], [-0.03, 0.03]])
    outline = Outline.polygon(corners + random.uniform(-0.008, 0.008, (4, 2)))
    even = Support.spread(outline, random.uniform(0.8, 2.9), POINTS)
    home, length = even.centre, Support.uniform(outline, 1).c
    x, y = np.add(home, models.HOME * length * random.normal(size=2))
    support, mu_c = even.carrying((x, y)), random.uniform(0.1, 0.5)
    slider = Slider.on(outline, support, exact=True)
    made = [push(random, outline, slider, (x, y), mu_c) for _ in range(count)]
    spread = noise * random.normal(size=(count, 3)) / [1.0, 1.0, length]
    spread[0, 0] = FAR
    pushes = tuple(
        Push('bad' if k == 0 else str(k), begin, Pose(*np.add(end, error)), way, RADIUS)
        for k, ((begin, end, way), error) in enumerate(zip(made, spread, strict=True))
    )
    truth = {'c': support.c, 'mu_c': mu_c, 'x': x - home[0], 'y': y - home[1]}
    return Pushes(outline, pushes), truth


def push(
    random: np.random.Generator,
    outline: Outline,
    slider: Slider,
    centre: tuple[float, float],
    mu_c: float,
) -> tuple[Pose, Pose, tuple[tuple[float, float], ...]]:
    """Push a side of the object that lies at its origin: begin, end and way."""
    corners = outline.points(1.0) @ [1.0, 1.0j]
    side = random.integers(len(corners))
    start, edge = corners[side], corners[(side + 1) % len(corners)] - corners[side]
    along, outward = edge / abs(edge), -1j * edge / abs(edge)
    begin = start + random.uniform(0.2, 0.8) * edge + (RADIUS + BEFORE) * outward
    end = begin - WAY * outward + random.uniform(-ASIDE, ASIDE) * along
    way = (begin.real, begin.imag), (end.real, end.imag)
    after = slider.pushed(Pose(*centre, 0.0), *way, mu_c, RADIUS)
    origin = complex(after.x, after.y) - np.exp(1j * after.angle) * complex(*centre)
    return Pose(0.0, 0.0, 0.0), Pose(origin.real, origin.imag, after.angle), way


if __name__ == '__main__':
    sys.exit(main())
