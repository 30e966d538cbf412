# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What the demonstration makes of its results."""

import math
from contextlib import nullcontext

import numpy as np
import pytest

from support.demo_results import results
from tactile_push.control import PUSHING, STATES
from tactile_push.demo import turning
from tactile_push.interface import CONTROLLER_STATE, SENSING_STATE, TRUE_STATE


def test_json_has_it():
    block, disk = (one.as_json() for one in results(None).values())
    assert (block['known_step'], disk['known_step']) == (None, 0)
    assert (block['settle_step'], block['ticks_lost'], block['wall_seconds']) == (192, 0, 10.0)
    # (17) by hand for phi = 1.44 and theta = -10 degrees.
    expected = -0.02375 / math.tan(1.44 + math.radians(10.0))
    assert block['d_lower'] == block['d_upper'] == pytest.approx(expected)
    assert list(block) == [
        'settle_step',
        'theta_final',
        'phi_final',
        'd_final',
        'd_lower',
        'd_upper',
        'known_step',
        'theta_range',
        'phi_range',
        'ticks_lost',
        'wall_seconds',
    ]


def test_theta_that_counts_is_the_true_one_at_each_step(monkeypatch, tmp_path):
    time = 0.1 * np.arange(1, 501)
    pushing = np.full(500, float(STATES.index(PUSHING)))
    desired = np.full(500, math.radians(-10.0))
    noise = math.radians(5.0) * (-1.0) ** np.arange(500)
    states = {'time': time, 'state': pushing, 'theta': desired + noise, 'theta_desired': desired}
    states |= {'phi': np.full(500, 1.4)}
    # The truth comes twice a period, the last at the time of the step; it is far off for 2 s.
    moments = np.repeat(time, 2) - np.tile([0.05, 0.0], 500)
    far = math.radians(20.0) * (moments < 2.04)
    truth = {
        'time': moments,
        'theta': math.radians(-10.0) + far,
        'd': np.linspace(0.0, 0.006, 1000),
    }
    sensed = {'time': time, 'd_lower': np.zeros(500), 'd_upper': np.ones(500)}
    tables = {CONTROLLER_STATE: states, TRUE_STATE: truth, SENSING_STATE: sensed}
    monkeypatch.setattr(turning, 'BagReader', lambda bag: nullcontext())
    monkeypatch.setattr(turning, 'topics_of', lambda reader, namespace: {})
    monkeypatch.setattr(turning, 'read_tables', lambda reader, topics: (tables, {}))
    result, theta, _ = turning._evaluate(turning.RIGS['block'], tmp_path, 1.0)
    assert result.push.settle_step == 20
    assert theta[[18, 19, 20]] == pytest.approx(np.radians([10.0, 10.0, -10.0]))
    assert result.d_final == 0.006
