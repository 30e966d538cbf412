# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The statistics and the table of the benchmark of the nodes."""

import importlib.util
import sys
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

SCRIPT = Path(__file__).parents[2] / 'benchmarks' / 'nodes_report.py'


@pytest.fixture(scope='module')
def report():
    """Load the module, which lies in no package."""
    spec = importlib.util.spec_from_file_location('nodes_report', SCRIPT)
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    yield module
    del sys.modules[spec.name]


def test_delay_counts_from_writing_to_the_first_message_of_a_reading(report):
    sent = [10.0, 20.0, 30.0, 40.0]
    heard = [(0, 11.0), (None, 19.0), (1, 20.5), (1, 29.0), (3, 40.25)]
    assert report.delays(sent, heard, first=1) == {1: 0.5, 3: 0.25}


@pytest.mark.parametrize(
    ('numbers', 'lost', 'disordered'),
    [
        ([2, 3, 4, 5, 6], 0, 0),
        ([0, 1, 2, 3, 4, 5, 6, 7], 0, 0),
        ([3, 4, 6], 2, 0),
        ([2, 4, 3, 5, 6], 0, 1),
        ([2, 3, 3, 4, 5, 6], 0, 1),
        ([2, None, 4, 5, 6], 1, 0),
        ([], 5, 0),
    ],
)
def test_lost_and_disordered_readings_are_told_apart(report, numbers, lost, disordered):
    assert report.gaps(numbers, 2, 6) == (lost, disordered)


def test_spread_is_the_distance_of_the_periods_from_what_they_should_be(report):
    assert report.spread(np.array([0.0, 0.1, 0.2, 0.3]), 0.1) == pytest.approx((0.0, 0))
    # One tick late by e makes one period longer by e and the next shorter by as much.
    deviation, lost = report.spread(np.array([0.0, 0.1, 0.21, 0.3, 0.4]), 0.1)
    assert deviation == pytest.approx(0.01 / np.sqrt(2.0))
    assert lost == 0
    # Even ticks at the wrong rate are not well timed.
    deviation, _ = report.spread(0.11 * np.arange(100), 0.1)
    assert deviation == pytest.approx(0.01)


def test_missing_ticks_are_counted(report):
    assert report.spread(np.array([0.0, 0.1, 0.4, 0.5, 0.7]), 0.1)[1] == 3


def test_table_says_what_is_met(report):
    rows = report.Report()
    rows.add('quick', '1 ms', 1.25, 1.25, 'x')
    rows.add('slow', '2 ms', 1.26, 1.25, 'x')
    rows.add('other', '3 ms', 9.0, None, '%')
    head, quick, slow, other = rows.table().splitlines()
    assert head.split() == ['what', 'measured', 'goal']
    assert quick.endswith('<= 1.25 x  met')
    assert slow.endswith('<= 1.25 x  NOT MET')
    assert other.endswith('9.00 %')


def test_each_benchmark_keeps_its_own_rows(report):
    rows = report.Report()
    kept = []
    for what in ('first', 'second'):
        benchmark = SimpleNamespace(extra_info={})
        rows.add(what, '', 1.0, 2.0, 'x')
        rows.save(benchmark)
        kept.append([row['what'] for row in benchmark.extra_info['rows']])
    assert kept == [['first'], ['second']]
