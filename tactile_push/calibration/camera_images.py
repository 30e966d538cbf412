# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Images of touches at known places, in a folder."""

from dataclasses import dataclass
from pathlib import Path

from tactile_push.calibration.touch_table import FILE, TABLE, KnownTouch, read_table
from tactile_push.devices.image_bytes import decoded_image
from tactile_push.tactile import ReadingRejectedError
from tactile_push.tactile.touched_region import Image, Reference, mean_image


@dataclass(frozen=True)
class TouchImages:
    """Images of touches, and the mean of those without one."""

    reference: Reference  #: shape (height, width)
    images: list[Image]  #: one for each touch
    touches: list[KnownTouch]  #: where each is
    names: list[str]  #: of each, for people
    frame: str = ''  #: of the camera; '' if it is not known


def images_in_folder(folder: Path) -> TouchImages:
    """Read images from a folder with a table `touches.csv`, whose column `file` names them.

    Parameters
    ----------
    folder : Path
        The folder. Lines of the table without azimuth and elevation are of the untouched tip.

    Returns
    -------
    TouchImages
        The images.

    Raises
    ------
    ValueError
        If the table or an image is none, or images are of several sizes, or there is none of the
        untouched tip. The message says which.
    OSError
        If one cannot be read.
    """
    table = read_table(folder / TABLE)
    images = []
    for line, touch in enumerate(table, 2):
        if not touch.file:
            raise ValueError(f'{folder / TABLE}: line {line}: expected the name of a {FILE}')
        path = folder / touch.file
        try:
            images.append(decoded_image(path.read_bytes()))
        except ReadingRejectedError:
            raise ValueError(f'{path}: expected a picture') from None
        if images[-1].shape != images[0].shape:
            raise ValueError(
                f'{path}: expected {_size(images[0])} as in {table[0].file}, got '
                f'{_size(images[-1])}'
            )
    untouched = [image for image, touch in zip(images, table, strict=True) if not touch.touched]
    if not untouched:
        raise ValueError(
            f'{folder / TABLE}: expected a line without azimuth and elevation, for an image of '
            'the untouched tip'
        )
    pairs = [(i, t) for i, t in zip(images, table, strict=True) if t.touched]
    reference = mean_image(untouched)
    touches = [touch for _, touch in pairs]
    return TouchImages(reference, [i for i, _ in pairs], touches, [t.file for t in touches])


def _size(image: Image) -> str:
    return f'{image.shape[1]} x {image.shape[0]} pixels'
