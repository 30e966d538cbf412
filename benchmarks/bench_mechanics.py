# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""How fast the mechanics are: `make bench`."""

import math
import platform
import sys

import numpy as np
import pytest

from tactile_push.control import PushLaw
from tactile_push.mechanics import Slider, Support, push
from tactile_push.simulation import RigConfig, paper_block, rollout, rollouts

KP, KD, THETA_D = 0.05, 5.0, math.radians(-10.0)
STEPS = 60_000
BATCH, BATCH_STEPS = 100_000, 600


def rate(benchmark, pushes, goal):
    """Report pushes a second beside the goal."""
    per_second = pushes / benchmark.stats.stats.min
    benchmark.extra_info.update(pushes_per_second=per_second, goal=goal)
    print(f'\n    {per_second:,.0f} pushes a second, goal {goal:,.0f}')


@pytest.mark.parametrize('mu_c', [0.1, 0.3])
def test_one_rollout(benchmark, mu_c):
    """Roll one object under the law, every step kept."""
    config, law = paper_block(mu_c=mu_c), PushLaw(KP, KD, THETA_D)
    rollout(config, law, 10)
    run = benchmark(rollout, config, law, STEPS)
    assert run.end == 'done'
    rate(benchmark, STEPS, 5e6)


def test_one_push_from_python(benchmark):
    """Call one push from Python, ten thousand times."""
    config = paper_block()
    path = config.slider.outline.path(config.radius)
    calls = 10_000

    def pushes():
        for _ in range(calls):
            push(0.3, 0.02, 0.001, 0.005, 0.1, path, 0.0187, None, 0.95, 0.3, 0.0135)

    pushes()
    benchmark(pushes)
    rate(benchmark, calls, 2e5)


def test_batch(benchmark):
    """Roll a hundred thousand objects on all cores."""
    slider = paper_block().slider
    random = np.random.default_rng(1)
    theta, d = random.uniform(-0.3, 0.3, BATCH), random.uniform(-0.01, 0.01, BATCH)
    case = dict(kp=KP, kd=KD, theta_desired=THETA_D, mu_c=0.3)
    rollouts(slider, theta=theta[:1], d=d[:1], steps=1, **case)
    done = benchmark.pedantic(
        rollouts,
        args=(slider,),
        kwargs=dict(theta=theta, d=d, steps=BATCH_STEPS, **case),
        rounds=3,
    )
    rate(benchmark, int(done.steps.sum()), 1e7)


@pytest.mark.parametrize('mu_c', [0.0, 0.1, math.inf])
def test_exact_support_of_400_points(benchmark, mu_c):
    """Roll one object on its exact limit surface, every step kept."""
    block = paper_block()
    outline = block.slider.outline
    exact = Slider.on(outline, Support.uniform(outline, 400), exact=True)
    config = RigConfig(exact, mu_c, block.theta, block.d, tip_turns=False)
    law = PushLaw(KP, KD, THETA_D)
    rollout(config, law, 1)
    run = benchmark(rollout, config, law, 600)
    print(f'\n    {exact.points.shape[1]} points')
    assert run.end == 'done'
    rate(benchmark, 600, 2e4)


def test_machine():
    """Say what the figures were measured on."""
    with open('/proc/cpuinfo') as info:
        model = next((line.split(':')[1].strip() for line in info if 'model name' in line), '')
    print(f'\n    {platform.platform()}, {model}, Python {sys.version.split()[0]}')
