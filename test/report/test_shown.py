# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Quantities in the units that people read."""

import math

import numpy as np
import pytest

from tactile_push.interface import TOPICS
from tactile_push.report.shown import SERIES, SOURCES, VIEWED, numbers, readable


def test_angles_are_degrees_and_those_of_straight_ahead_zero():
    angles = np.radians([90.0, 100.0])
    assert readable('theta', angles) == pytest.approx([90.0, 100.0])
    assert readable('phi', angles) == readable('psi', angles) == pytest.approx([0.0, 10.0])


def test_lengths_are_millimetres_and_times_seconds():
    assert readable('d', np.array([0.0123456])) == [12.3456]
    assert readable('belt_travel', np.array([1.0])) == [1000.0]
    assert readable('silence', np.array([0.25])) == [0.25]


@pytest.mark.parametrize('value', [math.nan, math.inf, -math.inf, 1.7e308])
def test_what_is_no_number_is_none(value):
    assert readable('d', np.array([value, 0.001])) == [None, 1.0]


def test_rounding_leaves_no_negative_zero():
    assert str(numbers(np.array([-1e-9]), 3)) == '[0.0]'


def test_every_quantity_with_a_source_is_shown_and_every_source_has_it():
    assert set(SOURCES) < set(SERIES | VIEWED)
    for sources in SOURCES.values():
        for topic, name in sources:
            assert name in (TOPICS[topic].field_names or ('x', 'y', 'yaw'))
