# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The time history: what is drawn, and that it is written in every format."""

import math
import subprocess
import sys

import matplotlib.figure
import numpy as np
import pytest

from tactile_push.figures import plot_history

THETA = np.radians([20.0, 10.0, -5.0, -9.0, -10.0])
PHI = np.radians([90.0, 110.0, 100.0, 85.0, 82.0])
THETA_D = math.radians(-10.0)
BAND = math.radians(3.0)
PANEL = (THETA, PHI, THETA_D, BAND, 3)


@pytest.fixture
def drawn(monkeypatch):
    """Return the list of the figures that are saved, which are not written."""
    figures = []
    monkeypatch.setattr(
        matplotlib.figure.Figure,
        'savefig',
        lambda figure, file, **options: figures.append((figure, file)),
    )
    return figures


def lines_by_label(axis):
    return {line.get_label(): line for line in axis.get_lines()}


@pytest.mark.parametrize(
    ('ending', 'start'), [('png', b'\x89PNG\r\n\x1a\n'), ('pdf', b'%PDF-'), ('svg', b'<?xml')]
)
def test_ending_of_the_name_chooses_the_format(tmp_path, ending, start):
    file = tmp_path / f'history.{ending}'
    plot_history({'block': PANEL}, [file])
    assert file.read_bytes().startswith(start)
    assert file.stat().st_size > 2000


def test_every_file_is_written(tmp_path):
    files = [tmp_path / 'a.svg', tmp_path / 'b.svg']
    plot_history({'block': PANEL}, files)
    assert all(file.exists() for file in files)


def test_theta_is_the_thin_line_and_phi_less_a_right_angle_the_thick_one(drawn):
    plot_history({'block': PANEL}, ['history.png'])
    ((figure, _),) = drawn
    (axis,) = figure.axes
    lines = lines_by_label(axis)
    theta, phi = lines['θ'], lines['φ − 90°']
    assert list(theta.get_xdata()) == [0, 1, 2, 3, 4]
    assert theta.get_ydata() == pytest.approx([20.0, 10.0, -5.0, -9.0, -10.0])
    assert list(phi.get_xdata()) == [0, 1, 2, 3, 4]
    assert phi.get_ydata() == pytest.approx([0.0, 20.0, 10.0, -5.0, -8.0])
    assert theta.get_linewidth() < phi.get_linewidth()
    assert axis.get_xlim() == (0.0, 4.0)


def test_band_lies_about_the_desired_angle(drawn):
    plot_history({'block': PANEL}, ['history.png'])
    (axis,) = drawn[0][0].axes
    (band,) = axis.patches
    corners = band.get_path().vertices
    corners = band.get_patch_transform().transform(corners)
    assert corners[:, 1].min() == pytest.approx(-13.0)
    assert corners[:, 1].max() == pytest.approx(-7.0)
    constant = [
        line.get_ydata()[0]
        for line in axis.get_lines()
        if len(line.get_ydata()) == 2 and line.get_ydata()[0] == line.get_ydata()[1]
    ]
    assert constant == pytest.approx([-10.0])


def test_step_of_settling_is_marked_and_named(drawn):
    plot_history({'block': PANEL}, ['history.png'])
    (axis,) = drawn[0][0].axes
    assert [text.get_text() for text in axis.texts] == ['settled: step 3']
    vertical = [line for line in axis.get_lines() if list(line.get_xdata()) == [3, 3]]
    assert len(vertical) == 1


def test_nothing_is_marked_if_it_never_settles_and_step_0_is_a_step(drawn):
    plot_history({'never': (*PANEL[:4], None), 'at once': (*PANEL[:4], 0)}, ['history.png'])
    never, at_once = drawn[0][0].axes
    assert not never.texts
    assert [text.get_text() for text in at_once.texts] == ['settled: step 0']


def test_panels_stand_side_by_side_with_titles_and_one_legend(drawn):
    longer = (np.zeros(9), np.full(9, math.pi / 2.0), 0.0, BAND, None)
    plot_history({'block': PANEL, 'disk': longer}, ['history.png'])
    figure = drawn[0][0]
    assert [axis.get_title() for axis in figure.axes] == ['block', 'disk']
    assert [axis.get_xlim()[1] for axis in figure.axes] == [4.0, 8.0]
    assert figure.axes[0].get_ylim() == figure.axes[1].get_ylim()
    assert all(axis.get_xlabel() == 'step k' for axis in figure.axes)
    assert '°' in figure.axes[0].get_ylabel()
    legends = [axis.get_legend() for axis in figure.axes if axis.get_legend()]
    assert len(legends) == 1
    assert {text.get_text() for text in legends[0].get_texts()} == {'θ', 'φ − 90°'}


def test_lists_are_as_good_as_arrays(drawn):
    plot_history({'block': (list(THETA), list(PHI), THETA_D, BAND, 3)}, ['history.png'])
    (axis,) = drawn[0][0].axes
    assert len(lines_by_label(axis)['θ'].get_ydata()) == 5


@pytest.mark.slow
def test_figures_need_no_display_and_leave_no_state_behind():
    program = (
        'import sys\n'
        'from tactile_push.figures import plot_history\n'
        "assert 'matplotlib.pyplot' not in sys.modules\n"
    )
    subprocess.run([sys.executable, '-c', program], check=True, timeout=60)


def test_without_a_desired_angle_there_is_no_band_and_the_settling_is_marked(drawn):
    plot_history({'steered': (THETA, PHI, math.nan, BAND, 3)}, ['history.png'])
    (axis,) = drawn[0][0].axes
    assert [*axis.patches] == []
    marks = [line for line in axis.get_lines() if list(line.get_xdata()) == [3, 3]]
    assert len(marks) == 1
    assert np.isfinite(axis.get_ylim()).all()
