# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

from array import array

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

cv2 = pytest.importorskip('cv2', reason="pip install 'tactile_push[camera]'")

from tactile_push.devices.image_bytes import decoded_image, grey_image  # noqa: E402
from tactile_push.tactile import ReadingRejectedError  # noqa: E402

ROWS = np.arange(6, dtype=np.uint8).reshape(2, 3)


def test_mono_image_is_taken_as_it_is():
    assert grey_image('mono8', 2, 3, 3, ROWS.tobytes()).tolist() == ROWS.tolist()


def test_rows_may_be_longer_than_their_pixels():
    padded = np.pad(ROWS, ((0, 0), (0, 5)), constant_values=77)
    assert grey_image('mono8', 2, 3, 8, padded.tobytes()).tolist() == ROWS.tolist()


def test_data_may_be_an_array_as_rclpy_has_it():
    assert grey_image('mono8', 2, 3, 3, array('B', ROWS.tobytes())).tolist() == ROWS.tolist()


@pytest.mark.parametrize(('encoding', 'order'), [('rgb8', [0, 1, 2]), ('bgr8', [2, 1, 0])])
def test_colours_become_grey_by_their_luminance(encoding, order):
    # ITU-R BT.601: 0.299 R + 0.587 G + 0.114 B.
    colours = np.array([[[200, 0, 0], [0, 200, 0], [0, 0, 200]]], np.uint8)[..., order]
    padded = np.pad(colours.reshape(1, 9), ((0, 0), (0, 3)))
    assert grey_image(encoding, 1, 3, 12, padded.tobytes()).tolist() == [[60, 117, 23]]


@pytest.mark.parametrize(
    ('arguments', 'reason'),
    [
        (('yuv422_yuy2', 2, 3, 6, bytes(12)), 'encoding other than mono8, rgb8 or bgr8'),
        (('', 2, 3, 3, bytes(6)), 'encoding other than mono8, rgb8 or bgr8'),
        (('mono8', 2, 3, 3, bytes(5)), 'other number of bytes than its size says'),
        (('mono8', 2, 3, 3, bytes(7)), 'other number of bytes than its size says'),
        (('mono8', 2, 3, 2, bytes(4)), 'other number of bytes than its size says'),
        (('rgb8', 2, 3, 8, bytes(16)), 'other number of bytes than its size says'),
        (('mono8', 0, 0, 0, b''), 'other number of bytes than its size says'),
        (('mono8', 2**32 - 1, 2**32 - 1, 2**32 - 1, b''), 'other number of bytes than'),
    ],
)
def test_bytes_that_make_no_image_are_refused(arguments, reason):
    with pytest.raises(ReadingRejectedError, match=f'^{reason}'):
        grey_image(*arguments)


@pytest.mark.parametrize(('ending', 'error'), [('.png', 0), ('.jpg', 4)])
def test_compressed_image_is_decoded(ending, error):
    smooth = np.add.outer(np.arange(40), 2 * np.arange(60)).astype(np.uint8)
    content = cv2.imencode(ending, smooth)[1]
    found = decoded_image(array('B', content.tobytes()))
    assert found.shape == (40, 60)
    assert np.abs(found.astype(int) - smooth).max() <= error


@pytest.mark.parametrize('content', [b'', b'\xff\xd8\xff', b'no picture'])
def test_bytes_of_no_picture_are_refused(content):
    with pytest.raises(ReadingRejectedError, match='^compressed image cannot be decoded$'):
        decoded_image(content)


@settings(derandomize=True, deadline=None, max_examples=100)
@given(st.binary(max_size=300), st.integers(0, 299))
def test_spoiled_pictures_are_decoded_or_refused(noise, at):
    content = bytearray(cv2.imencode('.png', ROWS)[1].tobytes())
    content[at : at + len(noise)] = noise
    try:
        assert decoded_image(bytes(content)).dtype == np.uint8
    except ReadingRejectedError as reason:
        assert str(reason) == 'compressed image cannot be decoded'
