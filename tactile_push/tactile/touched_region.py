# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Where an image differs from the image of the untouched tip."""

from collections.abc import Iterable
from typing import NamedTuple

import cv2
import numpy as np
import numpy.typing as npt

Image = npt.NDArray[np.uint8]
Reference = npt.NDArray[np.float32]
Mask = npt.NDArray[np.bool_] | npt.NDArray[np.uint8]

MEDIAN = 5  # side of the median filter [px]; it drops dead pixels, 5 % of them and more
SMOOTHING = 5  # side of the mean that follows, which makes noise a sixth of what the median leaves
LEAST_PIXELS = 20  # of a touch: less is a speck of dust; picked


class Region(NamedTuple):
    """The largest region of an image that differs from the reference."""

    x: float  #: column of its centroid, weighted by the change [px]
    y: float  #: row of it [px]
    area: int  #: [px]
    change: float  #: of a pixel of it, in the mean [levels]
    changed: int  #: area of all regions together [px]
    outline: npt.NDArray[np.int64]  #: column and row of the pixels at its edge, shape (n, 2)


NOTHING = Region(np.nan, np.nan, 0, 0.0, 0, np.empty((0, 2), np.int64))
AROUND = np.ones((3, 3), np.uint8)


def mean_image(images: Iterable[Image]) -> Reference:
    """Return the mean of images.

    Parameters
    ----------
    images : iterable of ndarray of uint8, shape (height, width)
        One or more.

    Returns
    -------
    ndarray of float32, shape (height, width)
        Their mean [levels].
    """
    return np.asarray(np.mean(list(images), axis=0, dtype=np.float32))


def touched_region(
    image: Image, reference: Reference, threshold: float, where: Mask | None = None
) -> Region:
    """Find the largest region that differs from the reference.

    A median and a mean take noise and dead pixels out of the difference, a threshold makes regions
    of it, and the region with the most pixels that touch one another is taken.

    Parameters
    ----------
    image : ndarray of uint8, shape (height, width)
        The image.
    reference : ndarray of float32, shape (height, width)
        The image of the untouched tip, best the mean of several.
    threshold : float
        Difference from which on a pixel has changed [levels].
    where : ndarray of bool or uint8, shape (height, width), optional
        Nonzero where to look; everywhere by default.

    Returns
    -------
    Region
        The region; `NOTHING` if no pixel has changed.
    """
    change = cv2.subtract(image, reference, dtype=cv2.CV_32F)
    change = cv2.blur(cv2.medianBlur(change, MEDIAN), (SMOOTHING, SMOOTHING))
    change = np.abs(change, out=change)
    changed = (change > threshold).view(np.uint8)
    if where is not None:
        changed &= where.view(np.uint8)
    count, labels, statistics, _ = cv2.connectedComponentsWithStats(changed, connectivity=8)
    if count < 2:
        return NOTHING
    areas = statistics[1:, cv2.CC_STAT_AREA]
    largest = int(np.argmax(areas))
    left, top, width, height, area = statistics[1 + largest].tolist()
    box = slice(top, top + height), slice(left, left + width)
    inside = labels[box] == 1 + largest
    weights = np.where(inside, change[box], 0.0)
    total = float(weights.sum())
    x = left + float(weights.sum(axis=0) @ np.arange(width)) / total
    y = top + float(weights.sum(axis=1) @ np.arange(height)) / total
    within = cv2.erode(inside.view(np.uint8), AROUND, borderValue=0)
    rows, columns = np.nonzero(inside & (within == 0))
    outline = np.stack([columns + left, rows + top], axis=-1)
    return Region(x, y, area, total / area, int(areas.sum()), outline)
