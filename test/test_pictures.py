# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The pictures of the tutorials, which docs/pictures.py makes."""

import re
import runpy
from pathlib import Path

import pytest

pytest.importorskip('cv2', reason="pip install 'tactile_push[camera]'")
pytest.importorskip('scipy', reason="pip install 'tactile_push[camera]'")

from matplotlib.image import imread

DOCS = Path(__file__).resolve().parents[1] / 'docs'
NAMES = sorted(path.name for path in (DOCS / 'pictures').iterdir())
BLOCK = 8  # side of the squares that are compared [px]: letters of other fonts differ in detail
TOLERANCE = 0.15  # of the brightest level, by which the mean of a square may differ


@pytest.fixture(scope='module')
def drawn(tmp_path_factory):
    """Return a folder with the pictures as they are drawn now."""
    folder = tmp_path_factory.mktemp('pictures')
    runpy.run_path(str(DOCS / 'pictures.py'))['draw'](folder)
    return folder


def squares(file):
    """Return the mean brightness of each square."""
    levels = imread(file)[..., :3].mean(axis=-1)
    height, width = (side // BLOCK * BLOCK for side in levels.shape)
    parts = levels[:height, :width].reshape(height // BLOCK, BLOCK, width // BLOCK, BLOCK)
    return parts.mean(axis=(1, 3))


def test_no_picture_is_missing_or_left_over(drawn):
    assert sorted(path.name for path in drawn.iterdir()) == NAMES


@pytest.mark.parametrize('name', NAMES)
def test_picture_is_what_the_package_draws(drawn, name):
    kept, now = squares(DOCS / 'pictures' / name), squares(drawn / name)
    assert kept.shape == now.shape, 'stale: run python docs/pictures.py'
    assert abs(kept - now).max() < TOLERANCE, 'stale: run python docs/pictures.py'


def test_each_picture_is_shown_on_a_page():
    pages = ''.join(page.read_text(encoding='utf-8') for page in DOCS.rglob('*.md'))
    assert sorted(set(re.findall(r'\((?:\.\./)?pictures/(\w+\.png)', pages))) == NAMES
