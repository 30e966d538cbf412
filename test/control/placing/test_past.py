# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import math

import pytest

from support.sticking_block import PRESSURE
from tactile_push.control.placing.model import Pushed, Situation, follow
from tactile_push.control.placing.past import Past, on_grid
from tactile_push.mechanics.turning_tip import STRAIGHT

PIECE, LAG = 5e-4, 5e-4
PUSHED = Pushed(
    *(0.02375, 0.0135, PRESSURE),
    *(0.0, 1.0, STRAIGHT, LAG),
)


def past(*commands, way=PIECE, lag=LAG):
    one = Past(lag)
    for command in commands:
        one.add(command, way)
    return one


def test_what_is_known_now_is_as_it_was():
    one = past(1.0, 1.0)
    now = one.present(0.01, 0.2, 0.003, one.way, PUSHED)
    assert (now.x, now.theta, now.d, now.command) == (0.01, 0.2, 0.003, 1.0)
    # After two time constants the finger is a share of exp(-2) short of its command.
    assert now.u == pytest.approx(1.0 - math.exp(-2.0))


def test_before_any_command_the_finger_stands():
    assert past().present(0.01, 0.2, 0.003, 0.0, PUSHED) == Situation(0.01, 0.2, 0.003, 0.0, 0.0)


def test_what_was_known_a_period_ago_is_moved_on_under_the_command_since():
    now = past(0.5, -1.0).present(0.0, 0.2, 0.003, PIECE, PUSHED)
    then = Situation(0.0, 0.2, 0.003, 0.5 * (1.0 - math.exp(-1.0)), -1.0)
    assert now == pytest.approx(follow(then, -1.0, PIECE, PUSHED))


def test_a_reading_between_two_commands_is_moved_on_under_both():
    one = past(0.5, -1.0, lag=0.0)
    pushed = PUSHED._replace(lag=0.0)
    now = one.present(0.0, 0.2, 0.003, 0.4 * PIECE, pushed)
    # The finger has gone 0.6 of a period to the right and one to the left.
    assert now.x == pytest.approx((0.6 * 0.5 - 1.0) * PIECE)
    halfway = follow(Situation(0.0, 0.2, 0.003, 0.5, 0.5), 0.5, 0.6 * PIECE, pushed)
    assert now == pytest.approx(follow(halfway, -1.0, PIECE, pushed))


def test_many_short_commands_are_one_long_one():
    whole, parts = past(1.0, way=8 * PIECE), past(*[1.0] * 8)
    known = (0.0, 0.1, -0.004, 0.0, PUSHED)
    assert parts.present(*known) == pytest.approx(whole.present(*known), abs=1e-9)


def test_it_remembers_no_more_than_it_needs():
    one = past(*[0.3] * 1000)
    assert one.way == pytest.approx(1000 * PIECE)
    assert one.present(0.0, 0.0, 0.0, one.way - PIECE, PUSHED).x == pytest.approx(0.3 * PIECE)


def test_nothing_depends_on_where_counting_began():
    # As for a recorder that missed the control periods before the first push.
    commands = [0.3 - 0.1 * k for k in range(8)]
    ways = [5e-4 + 1e-9 * k / 7.0 for k in range(8)]
    found = []
    for before in (0, 1, 7, 1000):
        one = past(*[0.0] * before, way=PIECE / 3.0)
        for command, way in zip(commands, ways, strict=True):
            one.add(command, way)
        found.append(one.present(0.01, 0.2, 0.003, one.way - on_grid(3.7 * PIECE), PUSHED))
    assert len(set(found)) == 1
