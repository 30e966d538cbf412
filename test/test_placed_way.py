# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What is seen from above of a placed object, by plane geometry."""

import math

import numpy as np
import pytest

from tactile_push.placed_way import PlacedWay, from_above

# A plate 40 mm along its pushed edge, which stands at 30° in it, and 20 mm from the finger.
EDGE, RADIUS = math.radians(30.0), 0.0135
BELT = np.linspace(0.0, 0.12, 25)


def corners(edge):
    """Return the corners of the plate, its edge turned by an angle."""
    cos, sin = math.cos(edge), math.sin(edge)
    flat = [(-0.02, -0.01), (0.02, -0.01), (0.02, 0.01), (-0.02, 0.01)]
    return [(cos * x - sin * y, sin * x + cos * y) for x, y in flat]


def way(outline, theta=0.0):
    """Return a plate that is pushed straight ahead from 1 m on with its edge at an angle."""
    finger = np.stack([np.full(25, -0.06), 1.0 + BELT], axis=1)
    moved = np.stack([np.full(25, -0.05), 1.03 + BELT, np.full(25, theta)], axis=1)
    return PlacedWay(finger, moved, EDGE, outline, RADIUS, (-0.045, math.pi / 2.0))


def test_the_belt_counts_from_where_the_finger_was():
    seen = from_above(way(corners(EDGE)))
    assert seen.finger[:, 1] == pytest.approx(BELT)
    assert seen.finger[:, 0] == pytest.approx(np.full(25, -0.06))
    assert seen.centre[[0, -1]] == pytest.approx(np.array([[-0.05, 0.03], [-0.05, 0.15]]))


def test_outlines_stand_every_50_mm_of_belt_and_where_the_object_was_let_go():
    seen = from_above(way(corners(EDGE)))
    assert [centre[1] for centre, _ in seen.passed] == pytest.approx([0.03, 0.08, 0.13])
    for centre, outline in seen.passed:
        assert outline - centre == pytest.approx(np.array(corners(0.0)))
    assert seen.free - seen.centre[-1] == pytest.approx(np.array(corners(0.0)))


def test_the_edge_lies_at_theta_whatever_its_angle_in_the_object():
    seen = from_above(way(corners(EDGE), theta=0.2))
    assert seen.free - seen.centre[-1] == pytest.approx(np.array(corners(0.2)))


def test_the_goal_lies_as_far_along_the_belt_as_the_object():
    seen = from_above(way(corners(EDGE)))
    assert seen.goal == pytest.approx([-0.045, 0.15])
    assert seen.wanted - seen.goal == pytest.approx(np.array(corners(math.pi / 2.0)))


def test_the_tip_is_a_circle_at_the_end_of_its_way():
    seen = from_above(way(corners(EDGE)))
    assert np.hypot(*(seen.tip - seen.finger[-1]).T) == pytest.approx(np.full(60, RADIUS))


def test_without_an_outline_there_are_the_ways():
    seen = from_above(way([]))
    assert seen.free.shape == seen.wanted.shape == (0, 2)
    assert len(seen.finger) == len(seen.centre) == 25
