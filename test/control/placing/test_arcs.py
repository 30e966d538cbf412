# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What is left of a push is its commands farther on, however its arcs are cut."""

import numpy as np
import pytest

from tactile_push.control.placing.arcs import ARCS, LENGTH, UNKNOWNS, rest_of

PUSH = np.array((1.0, 0.5, -0.5, -1.0, 0.1, 0.3, 0.2, 0.15))


def command_at(push, way):
    """Return the command after a piece of belt [m]."""
    ends = np.cumsum(push[ARCS:]) * LENGTH
    return push[int(np.searchsorted(ends, way, side='right'))]


@pytest.mark.parametrize('way', [0.0, 0.004, 0.013, 0.038, 0.045, 0.061, 0.074])
def test_the_rest_of_a_push_has_its_commands_and_an_arc_to_begin_with(way):
    rest = np.empty(UNKNOWNS)
    rest_of(PUSH, way, rest)
    left = PUSH[ARCS:].sum() * LENGTH - way
    assert rest[ARCS:].sum() * LENGTH == pytest.approx(left)
    assert rest[ARCS] > 0.0
    for after in np.linspace(0.0, left, 40, endpoint=False) + 1e-6:
        if after < left:
            assert command_at(rest, after) == command_at(PUSH, way + after)


def test_an_arc_that_is_over_makes_two_of_the_longest():
    rest = np.empty(UNKNOWNS)
    rest_of(PUSH, 0.01, rest)
    assert rest == pytest.approx((0.5, 0.5, -0.5, -1.0, 0.15, 0.15, 0.2, 0.15))


def test_a_push_that_is_over_has_no_rest():
    rest = np.empty(UNKNOWNS)
    rest_of(PUSH, 0.08, rest)
    assert rest[ARCS:].sum() == pytest.approx(0.0, abs=1e-12)
