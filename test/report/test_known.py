# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""From which step on d is known: by hand."""

import math

import pytest

from tactile_push.report.known import KNOWN, known_step

NARROW, WIDE = KNOWN, 1.01 * KNOWN


@pytest.mark.parametrize(
    ('widths', 'step'),
    [
        ([WIDE, WIDE, NARROW, NARROW], 2),
        ([NARROW, NARROW, NARROW, NARROW], 0),
        ([WIDE, NARROW, WIDE, NARROW], 3),  # what is forgotten was not known for good
        ([NARROW, NARROW, NARROW, WIDE], None),
        ([NARROW, math.nan, NARROW, NARROW], 2),
    ],
)
def test_step_is_the_first_of_those_that_stay_narrow(widths, step):
    times = [0.1, 0.2, 0.3, 0.4]
    assert known_step(times, times, widths) == step


def test_only_steps_of_the_law_count():
    told = [0.1, 0.2, 0.3, 0.4, 0.5]
    widths = [WIDE, NARROW, WIDE, NARROW, WIDE]
    # Between the steps 0.2 and 0.4 the finger was held; after them, too.
    assert known_step([0.1, 0.2, 0.4], told, widths) == 1


def test_of_a_step_without_an_estimate_nothing_is_known():
    assert known_step([0.1, 0.2, 0.3], [0.3], [NARROW]) == 2
    assert known_step([0.1, 0.2, 0.3], [0.1, 0.3], [NARROW, NARROW]) == 2
    assert known_step([0.1, 0.2, 0.3], [], []) is None


def test_last_steps_may_not_be_told_of_yet():
    assert known_step([0.1, 0.2, 0.3], [0.1, 0.2], [WIDE, NARROW]) == 1


def test_without_steps_nothing_is_known():
    assert known_step([], [], []) is None
