# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Looks that all figures have in common."""

from itertools import combinations

import pytest
from matplotlib.text import Text

from support.papers_figures import MAKERS

pytestmark = pytest.mark.slow


@pytest.mark.parametrize('number', MAKERS)
def test_figure_is_one_or_two_columns_wide(figures, number):
    assert figures[number].get_size_inches()[0] in (3.5, 7.16)


def shown_texts(axes):
    """Return the texts of a panel that are to be seen; those in space come to the plane."""
    texts = [*axes.texts, axes.title]
    if axes.get_legend():
        texts += axes.get_legend().get_texts()
    if axes.axison:
        for axis in (axes.xaxis, axes.yaxis):
            lower, upper = sorted(axis.get_view_interval())
            texts.append(axis.label)
            texts += [
                tick.label1 for tick in axis.get_major_ticks() if lower <= tick.get_loc() <= upper
            ]
    else:
        for text in axes.texts:
            x, y, _, w = axes.get_proj() @ [*text.get_position_3d(), 1.0]
            text.set_position((x / w, y / w))
    return [text for text in texts if text.get_visible() and text.get_text().strip()]


@pytest.mark.parametrize('number', MAKERS)
def test_no_text_is_small_cut_off_or_on_another(number):
    figure = MAKERS[number]()
    figure.canvas.draw()
    boxes = [
        (text, Text.get_window_extent(text)) for axes in figure.axes for text in shown_texts(axes)
    ]
    assert len(boxes) >= 8
    for text, box in boxes:
        assert text.get_fontsize() >= 8.0, text
        assert figure.bbox.x0 <= box.x0 < box.x1 <= figure.bbox.x1, text
        assert figure.bbox.y0 <= box.y0 < box.y1 <= figure.bbox.y1, text
    for (one, box), (other, box_of_other) in combinations(boxes, 2):
        assert not box.overlaps(box_of_other), (one, other)


@pytest.mark.parametrize('number', [6, 8])
def test_legend_hides_no_data(figures, number):
    figure = figures[number]
    figure.canvas.draw()
    for axes in figure.axes:
        if axes.get_legend() is None:
            continue
        box = axes.get_legend().get_window_extent()
        for line in axes.get_lines():
            assert not line.get_transform().transform_path(line.get_path()).intersects_bbox(box)


@pytest.mark.parametrize('number', [3, 6, 7, 8])
def test_every_axis_has_a_name_and_a_unit(figures, number):
    for axes in figures[number].axes:
        place = axes.get_subplotspec()
        if place.is_last_row():
            assert axes.get_xlabel()
            assert '[' in axes.get_xlabel() or '0.1 s' in axes.get_xlabel()
        if place.is_first_col():
            assert '[' in axes.get_ylabel()
