# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What images show of the tip, before the camera is calibrated."""

import math
from collections.abc import Sequence

import numpy as np

from tactile_push.calibration.bag_images import LEAST_IMAGES
from tactile_push.calibration.steadiness import Sight
from tactile_push.tactile import NotUntouchedError, ReadingRejectedError
from tactile_push.tactile.image_contact import IMAGES_OF_REFERENCE, OTHER_SIZE
from tactile_push.tactile.touched_region import LEAST_PIXELS, Image, mean_image, touched_region

MOVED = 0.005  # of the image's height, by which a touch moves visibly; a third of a degree
GROWN = 0.3  # change of the logarithm of its area


class ImageSense:
    """Finds touches as the bag of them will show them: anywhere in the image.

    Parameters
    ----------
    threshold : float
        Change of a pixel's brightness that counts [levels].
    """

    LEAST = LEAST_IMAGES  #: images of a touch
    LEAST_FREE = IMAGES_OF_REFERENCE  #: images of the untouched tip
    FREE_TIME = 0.0  #: over which they are taken [s]
    HINT = 'press lightly'  #: how to touch

    def __init__(self, threshold: float) -> None:
        self._threshold = threshold

    def take_free(self, values: Sequence[Image]) -> None:
        """Take images for those of the untouched tip.

        Raises
        ------
        NotUntouchedError
            If they cannot be: they change, or have several sizes.
        """
        if len({image.shape for image in values}) > 1:
            raise NotUntouchedError('expected images of one size')
        self._reference = mean_image(values)
        for image in (values[0], values[-1]):
            if self.sight(image).touched:
                raise NotUntouchedError('the image changes; touch nothing, hold the finger still')

    def sight(self, value: Image) -> Sight:
        """Find the touch in an image.

        Parameters
        ----------
        value : ndarray of uint8, shape (height, width)
            The image.

        Returns
        -------
        Sight
            The touch, or none.

        Raises
        ------
        ReadingRejectedError
            If the image has another size than those of the untouched tip.
        """
        if value.shape != self._reference.shape:
            raise ReadingRejectedError(OTHER_SIZE)
        region = touched_region(value, self._reference, self._threshold)
        touched = region.area >= LEAST_PIXELS
        moved, grown = MOVED * len(value), math.log(max(region.area, 1)) / GROWN
        features = np.array([region.x / moved, region.y / moved, grown])
        return Sight(touched, not touched, features)

    def words(self, values: Sequence[Image]) -> str:
        """Say where a touch is in the image, and how large.

        Parameters
        ----------
        values : sequence of ndarray
            Its images.

        Returns
        -------
        str
            For people.
        """
        region = touched_region(values[-1], self._reference, self._threshold)
        return f'seen at column {region.x:.0f}, row {region.y:.0f}, {region.area} pixels'
