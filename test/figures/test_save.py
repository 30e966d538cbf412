# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Figures as files."""

import struct
import subprocess
import sys
from xml.etree import ElementTree

import matplotlib
import pytest

from support.papers_figures import FILES, MAKERS
from tactile_push.figures import save_figures

pytestmark = pytest.mark.slow

NAMES = [f'{FILES[figure]}.{ending}' for figure in MAKERS for ending in ('png', 'svg')]
SVG = '{http://www.w3.org/2000/svg}'


@pytest.fixture(scope='module')
def saved(tmp_path_factory):
    """Return the folder, the list of files and what was told on the way."""
    folder = tmp_path_factory.mktemp('figures') / 'not' / 'there'
    told = []
    files = save_figures(folder, told.append)
    return folder, files, told


def test_every_figure_is_written_twice_and_told(saved):
    folder, files, told = saved
    assert [file.name for file in files] == told == NAMES
    assert sorted(folder.iterdir()) == sorted(files)


@pytest.mark.parametrize('number', MAKERS)
def test_png_has_300_dots_an_inch(saved, figures, number):
    data = (saved[0] / f'{FILES[number]}.png').read_bytes()
    assert data.startswith(b'\x89PNG\r\n\x1a\n')
    assert data.endswith(b'IEND\xaeB`\x82')
    inches = figures[number].get_size_inches()
    assert struct.unpack('>II', data[16:24]) == pytest.approx(300.0 * inches, abs=1.0)


@pytest.mark.parametrize('number', MAKERS)
def test_svg_is_xml_with_its_text_as_text_and_without_a_date(saved, number):
    data = (saved[0] / f'{FILES[number]}.svg').read_text()
    root = ElementTree.fromstring(data)
    assert root.tag == f'{SVG}svg'
    assert 'dc:date' not in data
    assert 'DejaVuSans-' not in data  # the outline of a glyph
    texts = {''.join(text.itertext()).strip() for text in root.iter(f'{SVG}text')}
    expected = {
        2: '1.87',
        3: 'motion cone',
        6: 'ellipsoid',
        7: '15',
        8: '400',
        'gains': 'lag 0.1 s',
        'slow_mode': 'step 400',
        'settling': 'law (18)',
    }
    assert expected[number] in texts


def test_second_run_gives_the_same_bytes_whatever_the_user_has_set(saved, tmp_path):
    with matplotlib.rc_context({'font.size': 20.0, 'axes.facecolor': 'red', 'svg.hashsalt': 'x'}):
        before = matplotlib.rcParams.copy()
        files = save_figures(tmp_path)
        assert matplotlib.rcParams.copy() == before
    for file in files:
        assert file.read_bytes() == (saved[0] / file.name).read_bytes(), file.name


def test_folder_that_cannot_be_made_is_an_os_error(tmp_path):
    (tmp_path / 'file').write_text('')
    with pytest.raises(OSError, match='file'):
        save_figures(tmp_path / 'file')


def test_figures_need_no_display_and_no_pyplot():
    program = (
        'import sys\n'
        'from tactile_push.figures import limit_surface_figure\n'
        'limit_surface_figure().canvas.draw()\n'
        "assert 'matplotlib.pyplot' not in sys.modules\n"
    )
    subprocess.run([sys.executable, '-c', program], check=True, timeout=120)
