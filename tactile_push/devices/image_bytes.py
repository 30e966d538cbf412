# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""From the bytes of an image message to grey levels."""

from typing import Any

import cv2
import numpy as np

from tactile_push.tactile.hemisphere import ReadingRejectedError
from tactile_push.tactile.touched_region import Image

#: bytes of a pixel, and how OpenCV calls the way to grey, by the encoding of sensor_msgs/Image
ENCODINGS = {'mono8': (1, None), 'rgb8': (3, cv2.COLOR_RGB2GRAY), 'bgr8': (3, cv2.COLOR_BGR2GRAY)}
OTHER_ENCODING = 'encoding other than mono8, rgb8 or bgr8'
TOO_FEW_BYTES = 'other number of bytes than its size says'
NOT_DECODED = 'compressed image cannot be decoded'


def grey_image(encoding: str, height: int, width: int, step: int, data: Any) -> Image:
    """Return the grey levels of an image as sensor_msgs/Image has it.

    Parameters
    ----------
    encoding : str
        Of a pixel: mono8, rgb8 or bgr8.
    height, width : int
        Size [px].
    step : int
        Length of a row, with what follows its pixels [byte].
    data : buffer
        The rows.

    Returns
    -------
    ndarray of uint8, shape (height, width)
        The levels; of a mono8 image they lie in `data`.

    Raises
    ------
    ReadingRejectedError
        If the encoding is another, or the bytes do not make such an image.
    """
    if encoding not in ENCODINGS:
        raise ReadingRejectedError(OTHER_ENCODING)
    depth, to_grey = ENCODINGS[encoding]
    content = np.frombuffer(data, np.uint8)
    if not (height and width and step >= depth * width and content.size == height * step):
        raise ReadingRejectedError(TOO_FEW_BYTES)
    rows = content.reshape(height, step)[:, : depth * width]
    if to_grey is None:
        return rows
    return cv2.cvtColor(rows.reshape(height, width, depth), to_grey)


def decoded_image(data: Any) -> Image:
    """Return the grey levels of an image as sensor_msgs/CompressedImage has it.

    Parameters
    ----------
    data : buffer
        A JPEG, PNG or TIFF file.

    Returns
    -------
    ndarray of uint8, shape (height, width)
        The levels.

    Raises
    ------
    ReadingRejectedError
        If OpenCV cannot decode it.
    """
    content = np.frombuffer(data, np.uint8)
    try:
        image = cv2.imdecode(content, cv2.IMREAD_GRAYSCALE) if content.size else None
    except cv2.error:
        image = None
    if image is None:
        raise ReadingRejectedError(NOT_DECODED)
    return image
