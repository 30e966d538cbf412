# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The picture of placed objects: what is drawn, and where."""

import math

import matplotlib.figure
import numpy as np
import pytest

from tactile_push.figures import plot_placed
from tactile_push.placed_way import PlacedWay

SQUARE = [(-0.02, -0.02), (0.02, -0.02), (0.02, 0.02), (-0.02, 0.02)]
BELT = np.linspace(0.0, 0.12, 25)


def way(edge=0.0):
    """Return a finger that goes straight ahead from 1 m on, and an object that turns by 90°."""
    finger = np.stack([np.full(25, -0.06), 1.0 + BELT], axis=1)
    moved = np.stack([np.full(25, -0.05), 1.03 + BELT, np.linspace(0.0, math.pi / 2.0, 25)], axis=1)
    return PlacedWay(finger, moved, edge, SQUARE, 0.0135, (-0.045, math.pi / 4.0))


@pytest.fixture
def drawn(monkeypatch):
    """Return the list of the figures that are saved, which are not written."""
    figures = []
    monkeypatch.setattr(
        matplotlib.figure.Figure, 'savefig', lambda figure, file, **options: figures.append(figure)
    )
    return figures


def lines_by_label(axis):
    return {line.get_label(): line for line in axis.get_lines()}


def test_the_ways_are_drawn_along_the_belt_from_where_the_finger_was(drawn):
    plot_placed({'goal 1': way()}, ['placed.png'])
    (axis,) = drawn[0].axes
    lines = lines_by_label(axis)
    assert lines['finger'].get_xdata() == pytest.approx(1e3 * BELT)
    assert lines['finger'].get_ydata() == pytest.approx(np.full(25, -60.0))
    assert lines['centre of mass'].get_xdata() == pytest.approx(30.0 + 1e3 * BELT)
    assert lines['centre of mass'].get_ydata() == pytest.approx(np.full(25, -50.0))
    # Seen from above along the finger's way: what is left of it is above.
    assert axis.get_ylim()[0] > axis.get_ylim()[1]


def test_the_panels_have_one_scale_and_lie_below_each_other(drawn):
    far = way()._replace(moved=way().moved + [0.04, 0.02, 0.0])
    plot_placed({'near': way(), 'far': far}, ['placed.png'])
    drawn[0].draw_without_rendering()
    first, second = drawn[0].axes
    for axis in (first, second):
        assert axis.get_ylim()[0] > axis.get_ylim()[1]
    assert first.get_xlim() == second.get_xlim()
    assert first.get_ylim() == second.get_ylim()
    boxes = [axis.get_position() for axis in (first, second)]
    assert (boxes[0].x0, boxes[0].x1) == pytest.approx((boxes[1].x0, boxes[1].x1))


def test_the_object_lies_where_it_was_let_go_and_the_goal_beside_it(drawn):
    plot_placed({'goal 1': way()}, ['placed.png'])
    lines = lines_by_label(drawn[0].axes[0])
    # A square that has turned by 90° covers itself.
    corners = np.stack(lines['let go'].get_data(), axis=1)
    assert sorted(map(tuple, np.round(corners[:4] - (150.0, -50.0), 6))) == [
        (-20.0, -20.0),
        (-20.0, 20.0),
        (20.0, -20.0),
        (20.0, 20.0),
    ]
    assert tuple(corners[0]) == tuple(corners[4])
    # The goal at 45° stands on a corner, as far along the belt as the object.
    along, across = lines['goal'].get_data()
    half = 20.0 * math.sqrt(2.0)
    assert (min(across), max(across)) == pytest.approx((-45.0 - half, -45.0 + half))
    assert (min(along), max(along)) == pytest.approx((150.0 - half, 150.0 + half))


def test_an_edge_that_is_not_the_objects_own_axis_is_turned_back(drawn):
    plot_placed({'goal 1': way(edge=math.pi / 4.0)}, ['placed.png'])
    lines = lines_by_label(drawn[0].axes[0])
    _, across = lines['goal'].get_data()
    assert (min(across), max(across)) == pytest.approx((-65.0, -25.0))


def test_every_object_has_a_panel_and_every_file_is_written(tmp_path):
    files = [tmp_path / 'a.png', tmp_path / 'b.svg']
    plot_placed({'first goal': way(), 'second goal': way()}, files)
    assert files[0].read_bytes().startswith(b'\x89PNG\r\n\x1a\n')
    words = files[1].read_text()
    assert words.startswith('<?xml')
    assert words.count('first goal') == words.count('second goal') == 1
