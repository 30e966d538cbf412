# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import math

import pytest

cv2 = pytest.importorskip('cv2', reason="pip install 'tactile_push[camera]'")

from support.dome import HEIGHT, WIDTH, DomePainter  # noqa: E402
from support.dome_touches import write_folder  # noqa: E402
from tactile_push.calibration.camera_images import images_in_folder  # noqa: E402

TWO = [(0.5, 0.9), (-1.5, 1.1)]


@pytest.fixture
def folder(tmp_path):
    """Return a folder with two touches and three images of the untouched tip."""
    return write_folder(tmp_path / 'images', TWO)


def test_images_of_a_folder_are_read_with_their_places(folder):
    found = images_in_folder(folder)
    assert found.names == ['touch_0.png', 'touch_1.png']
    assert [(t.azimuth, t.elevation) for t in found.touches] == [
        pytest.approx(touch, abs=1e-5) for touch in TWO
    ]
    assert [image.shape for image in found.images] == [(HEIGHT, WIDTH)] * 2


def test_reference_is_the_mean_of_the_untouched_tip(folder):
    clean = DomePainter(noise=0.0).image().astype(float)
    error = images_in_folder(folder).reference - clean
    assert error.std() == pytest.approx(3.0 / math.sqrt(3.0), rel=0.1)


def spoil(name, content):
    def change(folder):
        (folder / name).write_bytes(content)

    return change


def shrink(folder):
    cv2.imwrite(str(folder / 'touch_1.png'), DomePainter().image()[:-1])


@pytest.mark.parametrize(
    ('change', 'words'),
    [
        (spoil('touch_0.png', b'no picture'), 'touch_0.png: expected a picture'),
        (shrink, 'touch_1.png: expected 160 x 120 pixels as in free_0.png, got 160 x 119 pixels'),
        (
            spoil('touches.csv', b'azimuth_deg,elevation_deg\n0,9\n'),
            'touches.csv: line 2: expected the name of a file',
        ),
        (
            spoil('touches.csv', b'file,azimuth_deg,elevation_deg\ntouch_0.png,0,9\n'),
            'touches.csv: expected a line without azimuth and elevation',
        ),
    ],
)
def test_folder_that_is_not_one_is_refused(folder, change, words):
    change(folder)
    with pytest.raises(ValueError, match=words):
        images_in_folder(folder)


def test_image_that_is_not_there_is_named(folder):
    (folder / 'touch_0.png').unlink()
    with pytest.raises(FileNotFoundError) as missing:
        images_in_folder(folder)
    assert missing.value.filename == str(folder / 'touch_0.png')
