# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Images of touches at known places, in a bag."""

from collections.abc import Iterator
from itertools import chain, islice
from pathlib import Path
from typing import Any

from tactile_push.bags import BagReader
from tactile_push.bags.fields import TEXT, WHOLE
from tactile_push.calibration.bag_touches import (
    check_count,
    only_frame,
    only_topic,
    touches_in_order,
)
from tactile_push.calibration.camera_images import TouchImages
from tactile_push.devices.image_bytes import decoded_image, grey_image
from tactile_push.interface import COMPRESSED_IMAGE_TYPE, IMAGE_TYPE
from tactile_push.tactile import ReadingRejectedError
from tactile_push.tactile.image_contact import IMAGES_OF_REFERENCE
from tactile_push.tactile.touched_region import LEAST_PIXELS, Image, mean_image, touched_region

LEAST_IMAGES = 3  # of a touch: fewer are a flicker; picked
FIELDS = {
    IMAGE_TYPE: {
        'header.frame_id': TEXT,
        'height': WHOLE,
        'width': WHOLE,
        'encoding': TEXT,
        'step': WHOLE,
        'data[]': WHOLE,
    },
    COMPRESSED_IMAGE_TYPE: {'header.frame_id': TEXT, 'data[]': WHOLE},
}


def images_in_bag(bag: BagReader, table: Path, threshold: float) -> TouchImages:
    """Read images from a bag: first of the untouched tip, then of one touch after the other.

    Parameters
    ----------
    bag : BagReader
        A bag with one topic of images.
    table : Path
        The touches in their order.
    threshold : float
        Change of a pixel's brightness that counts [levels].

    Returns
    -------
    TouchImages
        The image with the largest change of each touch, between two moments without one.

    Raises
    ------
    ValueError
        If the bag has no topic of images or several, if their messages are none, or if the bag has
        another number of touches than the table.
    OSError
        If the table cannot be read.
    """
    touches = touches_in_order(table)
    frames: set[str] = set()
    images = _images(bag, frames)
    first = list(islice(images, IMAGES_OF_REFERENCE))
    if len(first) < IMAGES_OF_REFERENCE:
        raise ValueError(f'expected {IMAGES_OF_REFERENCE} images or more, got {len(first)}')
    reference = mean_image(first)
    found: list[Image] = []  # one a touch
    of_touch: list[tuple[int, int, Image]] = []  # area, number and image of the present one
    for image in chain(images, first[-1:]):  # which ends a touch at the end
        area = touched_region(image, reference, threshold).area
        if area >= LEAST_PIXELS:
            of_touch.append((area, len(of_touch), image))
            continue
        if len(of_touch) >= LEAST_IMAGES:
            found.append(max(of_touch)[2])
        of_touch = []
    check_count(table, touches, len(found))
    names = [f'touch {number}' for number in range(1, len(touches) + 1)]
    return TouchImages(reference, found, touches, names, only_frame(frames))


def image_of(type_name: str, content: Any) -> Image:
    """Return the grey levels of a message.

    Parameters
    ----------
    type_name, content : str, object
        Type and fields of the message, one of `FIELDS`.

    Returns
    -------
    ndarray of uint8, shape (height, width)
        The levels.

    Raises
    ------
    ReadingRejectedError
        If the message is no image.
    """
    if type_name == COMPRESSED_IMAGE_TYPE:
        return decoded_image(content.data)
    shape = content.height, content.width, content.step
    return grey_image(content.encoding, *shape, content.data)


def _images(bag: BagReader, frames: set[str]) -> Iterator[Image]:
    """Yield the images of a bag, which are of one size, and add their frames to a set."""
    topic = only_topic(bag, FIELDS, 'images')
    size = None
    for message in bag.messages([topic.name]):
        content = bag.decode(message)
        frames.add(content.header.frame_id)
        try:
            image = image_of(topic.type_name, content)
        except ReadingRejectedError as reason:
            raise ValueError(f'{topic.name}: {reason}') from None
        size = image.shape if size is None else size
        if image.shape != size:
            raise ValueError(f'{topic.name}: images of several sizes')
        yield image
