# Copyright 2026 The tactile_push authors
#
# Licensed under the Apache License, Version 2.0 (the "License");
# you may not use this file except in compliance with the License.
# You may obtain a copy of the License at
#
#     http://www.apache.org/licenses/LICENSE-2.0
#
# Unless required by applicable law or agreed to in writing, software
# distributed under the License is distributed on an "AS IS" BASIS,
# WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
# See the License for the specific language governing permissions and
# limitations under the License.
"""The benchmark of the estimator runs on a few experiments and reports what it says."""

import importlib.util
import json
import math
import sys
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

SCRIPT = Path(__file__).parents[1] / 'benchmarks' / 'estimation.py'


@pytest.fixture(scope='module')
def bench():
    """Load the benchmark as a module."""
    spec = importlib.util.spec_from_file_location('estimation_benchmark', SCRIPT)
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    yield module
    del sys.modules[spec.name]


def test_a_short_run_of_a_few_groups_prints_and_writes(bench, monkeypatch, tmp_path, capsys):
    chosen = tuple(bench.GROUPS[i] for i in (0, 5, -1))
    monkeypatch.setattr(bench, 'GROUPS', chosen)
    monkeypatch.setattr(bench, 'STEPS', (10, 20))
    monkeypatch.setattr(bench, 'PARTICLES', 200)
    file, figure = tmp_path / 'out.json', tmp_path / 'out.png'
    monkeypatch.setattr(
        sys,
        'argv',
        ['estimation', '--experiments', '6', '--json', str(file), '--plot', str(figure)],
    )
    bench.main()

    results = json.loads(file.read_text())
    assert list(results) == [group.name for group in chosen]
    for result in results.values():
        for step in ('10', '20'):
            row = result['estimator'][step]
            assert row['experiments'] == 2
            assert 0.0 <= row['coverage'] <= 1.0
            assert 0.0 < row['width_mm'] <= 50.0
    assert all(row['coverage'] == 1.0 for row in results[chosen[0].name]['guaranteed'].values())
    assert 'Cramer-Rao' in capsys.readouterr().out
    assert figure.stat().st_size > 0


def test_the_bound_falls_with_the_noise_and_the_steps(bench, monkeypatch):
    group = bench.GROUPS[0]
    run = bench.experiment(group, np.random.default_rng(0))
    widths = bench.cramer_rao(group, run)

    assert all(a > b for a, b in pairwise(widths.values()))
    assert widths[400] < 2.0 * 1.96 * group.sizes[0] / math.sqrt(12.0)
