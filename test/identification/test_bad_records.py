# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import math

import numpy as np
import pytest

from tactile_push.identification.bad_records import APART, CLOSEST, MOVED, most_of, named, untouched
from tactile_push.identification.records import Push, Pushes
from tactile_push.mechanics import Outline, Pose

SQUARE = Outline.rectangle(0.04, 0.04)
RADIUS = 0.005


def push(gap, moved, turned=0.0):
    """Pass a square that does not stand at the origin at a distance."""
    x = 0.3 + 0.02 + RADIUS + gap
    way = (x, 0.1), (x, 0.3)
    return Push(
        'one', Pose(0.3, 0.2, math.pi), Pose(0.3, 0.2 + moved, math.pi + turned), way, RADIUS
    )


@pytest.mark.parametrize(
    ('gap', 'moved', 'turned', 'bad'),
    [
        (1.1 * APART, 1.1 * MOVED, 0.0, True),
        (0.9 * APART, 1.1 * MOVED, 0.0, False),
        (1.1 * APART, 0.9 * MOVED, 0.0, False),
        (1.1 * APART, 0.0, 0.2, True),  # a corner moves by 5 mm
        (1.1 * APART, 0.0, math.tau, False),
        (-0.004, 0.1, 0.0, False),
    ],
)
def test_what_moves_is_touched(gap, moved, turned, bad):
    there = Pushes(SQUARE, (push(0.0, 0.01), push(gap, moved, turned)))

    assert untouched(there) == [1] * bad


def test_a_record_far_beyond_the_others_stands_out():
    sizes = np.random.default_rng(2).exponential(1e-3, 300)
    sizes[[7, 100]] = 0.02, 0.015

    assert np.flatnonzero(sizes > most_of(sizes)).tolist() == [7, 100]


def test_hardly_ever_is_a_good_record_taken_for_a_bad_one():
    # One time in a hundred, by the rule.
    random = np.random.default_rng(3)
    draws = random.exponential(1.0, (1000, 60))
    found = sum(bool((sizes > most_of(sizes)).any()) for sizes in draws)

    assert 2 <= found <= 30


def test_what_is_off_by_less_than_a_camera_sees_is_not_bad():
    sizes = np.array([0.0] * 30 + [CLOSEST])

    assert most_of(sizes) > CLOSEST


def test_bad_records_keep_their_names():
    there = Pushes(SQUARE, (push(0.0, 0.01), push(0.01, 0.01)))

    assert named(there, [1], 'why') == (('one', 'why'),)
