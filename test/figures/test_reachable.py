# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The picture of the reachable goals: what is drawn where, and in which colour."""

import math

import matplotlib.figure
import numpy as np
import pytest
from matplotlib.colors import to_hex

from tactile_push.control.placing.reachable_set import ReachableSet
from tactile_push.control.placing.stages import OUT_OF_REACH, REASONS
from tactile_push.figures.reachable import COLORS, plot_reachable

RESERVE, BELT = ('with reserve', ''), ('out of reach', 'belt')
FOUND = ReachableSet(
    (-0.01, 0.0, 0.01), (0.0, math.radians(5.0)), ((RESERVE, RESERVE, BELT), (RESERVE, BELT, BELT))
)


@pytest.fixture
def drawn(monkeypatch):
    """Return the list of the figures that are saved, which are not written."""
    figures = []
    monkeypatch.setattr(
        matplotlib.figure.Figure, 'savefig', lambda figure, file, **_: figures.append(figure)
    )
    return figures


def test_each_goal_has_the_colour_of_what_is_said_of_it(drawn):
    plot_reachable(FOUND, {}, ['reach.png'])
    (axes,) = drawn[0].axes
    (mesh,) = axes.collections
    mesh.update_scalarmappable()
    colors = [to_hex(color) for color in mesh.get_facecolors()]
    named = {
        text.get_text(): to_hex(patch.get_facecolor())
        for text, patch in zip(
            drawn[0].legends[0].get_texts(), drawn[0].legends[0].get_patches(), strict=True
        )
    }
    assert set(named) == {'with reserve', 'not: belt'}
    expected = [
        named['with reserve' if told == RESERVE else 'not: belt']
        for row in FOUND.told
        for told in row
    ]
    assert colors == expected
    corners = np.array(mesh.get_coordinates())
    assert corners[0, :, 0] == pytest.approx([-15.0, -5.0, 5.0, 15.0])  # mm
    assert corners[:, 0, 1] == pytest.approx([-2.5, 2.5, 7.5])  # degrees


def test_start_and_goals_are_marked(drawn):
    marks = {'start': (0.001, 0.1), 'goal': (-0.01, 0.0), 'nearest': (0.0, 0.05)}
    plot_reachable(FOUND, marks, ['reach.png'])
    lines = {line.get_label(): line.get_xydata()[0] for line in drawn[0].axes[0].get_lines()}
    for name, (x, theta) in marks.items():
        assert list(lines[name]) == pytest.approx([1e3 * x, math.degrees(theta)])


def test_every_file_is_written(tmp_path):
    files = [tmp_path / 'a.png', tmp_path / 'b.svg']
    plot_reachable(FOUND, {}, files)
    assert all(file.stat().st_size > 2000 for file in files)


def test_every_reason_has_a_colour_of_its_own():
    reasons = {(OUT_OF_REACH, reason) for reason in REASONS if reason}
    assert reasons <= set(COLORS)
    assert len({color for _, color in COLORS.values()}) == len(COLORS)
