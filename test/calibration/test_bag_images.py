# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import numpy as np
import pytest

cv2 = pytest.importorskip('cv2', reason="pip install 'tactile_push[camera]'")

from support.bag_making import encode, write_bag  # noqa: E402
from support.dome import HEIGHT, WIDTH, DomePainter  # noqa: E402
from tactile_push.bags import BagReader  # noqa: E402
from tactile_push.calibration.bag_images import images_in_bag  # noqa: E402

TOUCHES = [(0.5, 0.9), (-1.5, 1.1), (2.0, 0.7)]
RAW, COMPRESSED = 'sensor_msgs/msg/Image', 'sensor_msgs/msg/CompressedImage'
THRESHOLD = 12.0


def frames():
    """Yield images: ten of the untouched tip, then touches of four with three between."""
    painter = DomePainter(noise=0.0)
    for _ in range(10):
        yield painter.image()
    for azimuth, elevation in TOUCHES:
        for size in (5.0, 8.0, 9.0, 6.0):
            yield painter.image(azimuth, elevation, size=size)
        for _ in range(3):
            yield painter.image()


def compressed(image):
    picture = cv2.imencode('.png', image)[1]
    return encode(COMPRESSED, header={'frame_id': 'camera'}, data=picture.tobytes())


def raw(image):
    height, width = image.shape
    shape = {'height': height, 'width': width, 'step': width}
    return encode(RAW, encoding='mono8', **shape, data=image.tobytes())


def bag(folder, images, kind=COMPRESSED, **others):
    how = compressed if kind == COMPRESSED else raw
    messages = [(1 + number, how(image)) for number, image in enumerate(images)]
    return write_bag(folder / 'bag', {'/camera/image': (kind, messages), **others})


@pytest.fixture
def table(tmp_path):
    file = tmp_path / 'touches.csv'
    file.write_text('azimuth_deg,elevation_deg\n,\n28.6,51.6\n-85.9,63.0\n114.6,40.1\n')
    return file


def read(path, table):
    with BagReader(path) as reader:
        return images_in_bag(reader, table, THRESHOLD)


def test_largest_image_of_each_touch_is_taken_in_the_order_of_the_table(tmp_path, table):
    found = read(bag(tmp_path, frames()), table)
    painter = DomePainter(noise=0.0)
    for image, (azimuth, elevation) in zip(found.images, TOUCHES, strict=True):
        assert (image == painter.image(azimuth, elevation, size=9.0)).all()
    assert (found.reference == painter.image()).all()
    assert found.frame == 'camera'
    assert found.names == ['touch 1', 'touch 2', 'touch 3']
    assert [round(touch.azimuth, 1) for touch in found.touches] == [0.5, -1.5, 2.0]


def test_flicker_is_no_touch(tmp_path, table):
    painter = DomePainter(noise=0.0)
    flicker = [painter.image(1.0, 1.0)] * 2
    images = [*frames(), *flicker, painter.image()]
    assert len(read(bag(tmp_path, images), table).images) == 3


def test_touch_at_the_end_counts(tmp_path, table):
    images = list(frames())[:-3]
    assert len(read(bag(tmp_path, images), table).images) == 3


def test_raw_images_are_as_good(tmp_path, table):
    found = read(bag(tmp_path, frames(), RAW), table)
    again = read(bag(tmp_path / 'again', frames()), table)
    assert np.array_equal(found.images, again.images)


@pytest.mark.parametrize(
    ('images', 'words'),
    [
        ([DomePainter().image()] * 9, 'expected 10 images or more, got 9'),
        ([DomePainter().image()] * 9 + [DomePainter().image()[1:]], 'images of several sizes'),
        (list(frames())[:24], 'touches.csv: expected 2 touches as in the bag, got 3'),
    ],
)
def test_bag_that_does_not_fit_is_refused(tmp_path, table, images, words):
    path = bag(tmp_path, images)
    with pytest.raises(ValueError, match=words):
        read(path, table)


def test_bag_without_images_or_with_several_topics_of_them_is_refused(tmp_path, table):
    with pytest.raises(ValueError, match='expected one topic of images, got none'):
        read(write_bag(tmp_path / 'empty', {}), table)
    other = {'/other': (COMPRESSED, [])}
    with pytest.raises(ValueError, match='expected one topic of images, got /camera/image, /other'):
        read(bag(tmp_path, frames(), **other), table)


def test_message_that_is_no_image_is_refused(tmp_path, table):
    shape = {'height': HEIGHT, 'width': WIDTH, 'step': WIDTH}
    message = encode(RAW, encoding='mono8', **shape, data=[1, 2])
    path = write_bag(tmp_path / 'bag', {'/image': (RAW, [(1, message)])})
    with pytest.raises(ValueError, match='^/image: other number of bytes than its size says$'):
        read(path, table)
