# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import math

import matplotlib.figure
import numpy as np
import pytest

from tactile_push.identification.picture import draw_pushes


@pytest.fixture
def drawn(identified, tmp_path, monkeypatch):
    """Return the panels of the picture."""
    figures = []
    monkeypatch.setattr(
        matplotlib.figure.Figure, 'savefig', lambda figure, file: figures.append((figure, file))
    )
    draw_pushes(identified, tmp_path / 'pushes.png')
    ((figure, file),) = figures
    assert file == tmp_path / 'pushes.png'
    return figure.axes


def test_points_are_measured_against_predicted_motions(identified, drawn):
    way, turn = (axes.lines[1].get_xydata() for axes in drawn)

    push, residual = identified.pushes.pushes[3], identified.residual[3]
    along = complex(*push.way[1]) - complex(*push.way[0])
    moved = complex(push.end.x, push.end.y) - complex(push.begin.x, push.begin.y)
    ends = [moved, moved + complex(residual[0], residual[1])]
    assert way[3] == pytest.approx([1e3 * (end / along).real * abs(along) for end in ends])
    turned = push.end.angle - push.begin.angle
    assert turn[3] == pytest.approx([math.degrees(turned), math.degrees(turned + residual[2])])
    assert len(way) == len(turn) == len(identified.pushes.pushes)


def test_the_line_is_where_both_are_alike(drawn):
    for axes in drawn:
        x, y = axes.lines[0].get_data()
        assert np.array_equal(x, y)
        assert '[' in axes.get_xlabel()
