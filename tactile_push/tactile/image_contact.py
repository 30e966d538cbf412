# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""From images of a hemispherical tip to its contact; images that tell nothing are refused."""

import math
from collections import deque
from dataclasses import dataclass

import cv2
import numpy as np

from tactile_push.tactile.cut_region import CutRegions
from tactile_push.tactile.dome_camera import DomeCamera
from tactile_push.tactile.hemisphere import ReadingRejectedError
from tactile_push.tactile.reading import NO_CONTACT, NotUntouchedError, Reading
from tactile_push.tactile.rim import Rim, RimProfile
from tactile_push.tactile.sphere import angles_of
from tactile_push.tactile.touched_region import (
    NOTHING,
    Image,
    Reference,
    Region,
    mean_image,
    touched_region,
)

IMAGES_OF_REFERENCE = 10  # whose mean is the reference: a third of the noise of one
# Brightness from which on a pixel is saturated [levels], and the share of the dome that may be so:
# more than a contact lights up in a waveguide.
SATURATED, MOST_SATURATED = 250, 0.25
# A dome with less than this share of its brightness is dark, unless it always is: then darkness
# says nothing. [levels]
DARKENED, BRIGHT = 0.3, 15.0
MOST_CHANGED = 0.5  # share of the dome; a contact covers less
LONGEST_STEP = 1.0  # between two images [s], by which the reference follows

OTHER_SIZE = 'another size than calibrated'
UNIFORM = 'all pixels alike'
FROZEN = 'the same image again'
DARK = 'dark'
BURNT = 'saturated'
NO_REFERENCE = 'no reference'
CHANGED = 'changed all over'
BEYOND = 'contact beyond the calibrated part'


@dataclass(frozen=True)
class ImageContactSettings:
    """What counts as a contact."""

    threshold: float = 12.0  #: change of a pixel's brightness that counts [levels]
    least_area: float = 0.002  #: of a contact, as seen from the dome's centre [sr]
    reach: float = math.pi / 2.0  #: largest angle from the pole that touches calibrated [rad]
    #: time in which the reference follows a change of the untouched tip [s]; 0 if it never does
    follow_time: float = 60.0
    force_scale: float = 0.0  #: force over area^(3/2) [N/sr^(3/2)]; 0 if it is not known


@dataclass(frozen=True)
class ImageContact:
    """What one image says."""

    reading: Reading  #: azimuth, elevation and force
    region: Region  #: where the image changed most
    area: float  #: of that region, as seen from the dome's centre [sr]


class ImageContactFinder:
    """Finds the contact in each image of the tip.

    An image is compared with the reference, the mean of images of the untouched tip. While nothing
    touches the tip the reference slowly follows the images, so that neither warming lamps nor a gel
    that creeps become a contact. A change that is as slow, and below the threshold, is never seen.

    Parameters
    ----------
    camera : DomeCamera
        The calibrated camera.
    settings : ImageContactSettings
        What counts as a contact; may be changed between images.
    rim : RimProfile or None, optional
        How the tip's rim looked when the camera was calibrated, to recognise it by.
    at_start : bool, optional
        Whether the first images make the reference without being asked to.
    """

    def __init__(
        self,
        camera: DomeCamera,
        settings: ImageContactSettings,
        rim: RimProfile | None = None,
        *,
        at_start: bool = False,
    ) -> None:
        self.camera = camera
        self.settings = settings
        self.trouble = ''  #: why the first images made no reference
        self._calibrated_rim = rim
        self._rim = None if rim is None else Rim(camera)
        self._at_start = at_start
        self._cut = CutRegions(camera)
        self._dome = self._cut.dome
        self._dome_area = int(np.count_nonzero(self._dome))
        self._last: deque[Image] = deque(maxlen=IMAGES_OF_REFERENCE)
        self._previous: Image | None = None
        self._reference: Reference | None = None
        self._brightness = 0.0  # of the reference's dome, in the mean [levels]
        self._stamp = math.nan
        self._touched = False

    @property
    def has_reference(self) -> bool:
        """Whether the finder knows how the untouched tip looks."""
        return self._reference is not None

    def contact(self, image: Image, stamp: float) -> ImageContact:
        """Find the contact in an image.

        Parameters
        ----------
        image : ndarray of uint8, shape (height, width)
            The image.
        stamp : float
            When it was taken [s].

        Returns
        -------
        ImageContact
            The contact, or none.

        Raises
        ------
        ReadingRejectedError
            If the image tells nothing. The message is the reason.
        """
        try:
            self._check(image)
        except ReadingRejectedError:
            self._last.clear()  # a reference is made of images in a row
            raise
        self._last.append(image)
        if self._at_start and self._reference is None:
            self._take_first_reference()
        if self._reference is None:
            raise ReadingRejectedError(NO_REFERENCE)
        if self._brightness > BRIGHT and self._mean(image) < DARKENED * self._brightness:
            raise ReadingRejectedError(DARK)
        region = touched_region(image, self._reference, self.settings.threshold, self._dome)
        if region.changed > MOST_CHANGED * self._dome_area:
            self._touched = False
            raise ReadingRejectedError(CHANGED)
        region = self._cut.completed(region)
        area = self._area(region)
        self._touched = area >= self.settings.least_area
        if not self._touched:
            self._follow(image, stamp)
            return ImageContact(NO_CONTACT, NOTHING, 0.0)
        azimuth, elevation = map(float, angles_of(self.camera.directions((region.x, region.y))))
        if not math.pi / 2.0 - elevation <= self.settings.reach:
            raise ReadingRejectedError(BEYOND)
        reading = Reading(azimuth, max(elevation, 0.0), self._force(area))
        return ImageContact(reading, region, area)

    def take_reference(self) -> None:
        """Take the last images for those of the untouched tip.

        Raises
        ------
        NotUntouchedError
            If there is a contact, if there are too few images or they differ, or if they cannot be
            of the tip that was calibrated. The message is the reason; the reference stays.
        """
        if self._touched:
            raise NotUntouchedError(
                'in contact; lift the finger, or clean the node up and configure it anew if '
                'nothing touches it'
            )
        if len(self._last) < IMAGES_OF_REFERENCE:
            raise NotUntouchedError(
                f'expected {IMAGES_OF_REFERENCE} good images in a row, got {len(self._last)}'
            )
        mean = mean_image(self._last)
        for image in (self._last[0], self._last[-1]):
            region = touched_region(image, mean, self.settings.threshold, self._dome)
            if self._area(region) >= self.settings.least_area:
                raise NotUntouchedError('the image changes; hold the finger still')
        if self._rim is not None and self._calibrated_rim is not None:
            difference = self._calibrated_rim.difference(self._rim.profile(mean))
            if difference:
                raise NotUntouchedError(difference)
        self._reference, self._brightness = mean, self._mean(mean)

    def forget(self) -> None:
        """Forget the reference and all images."""
        self._reference, self._previous, self._touched = None, None, False
        self._last.clear()

    def _take_first_reference(self) -> None:
        if len(self._last) < IMAGES_OF_REFERENCE:
            return
        try:
            self.take_reference()
        except NotUntouchedError as reason:
            self.trouble = str(reason)
            self._last.clear()

    def _check(self, image: Image) -> None:
        if image.shape != (self.camera.height, self.camera.width):
            raise ReadingRejectedError(OTHER_SIZE)
        least, most, _, _ = cv2.minMaxLoc(image, self._dome)
        if least == most:
            raise ReadingRejectedError(UNIFORM)
        before, self._previous = self._previous, image
        if before is not None and np.array_equal(image, before):
            raise ReadingRejectedError(FROZEN)
        bright = cv2.bitwise_and(cv2.inRange(image, SATURATED, 255), self._dome)
        if cv2.countNonZero(bright) > MOST_SATURATED * self._dome_area:
            raise ReadingRejectedError(BURNT)

    def _mean(self, image: Image | Reference) -> float:
        return float(cv2.mean(image, self._dome)[0])

    def _area(self, region: Region) -> float:
        return region.area * self.camera.solid_angle(region.x, region.y) if region.area else 0.0

    def _force(self, area: float) -> float:
        """Return the force [N]: by Hertz the contact's radius grows as the cube root of it."""
        scale = self.settings.force_scale
        return scale * area**1.5 if scale > 0.0 else math.nan

    def _follow(self, image: Image, stamp: float) -> None:
        """Move the reference towards an image of the untouched tip."""
        step = min(max(stamp - self._stamp, 0.0), LONGEST_STEP)  # 0 for the first
        self._stamp = stamp
        if self.settings.follow_time > 0.0 and step > 0.0:
            share = -math.expm1(-step / self.settings.follow_time)
            cv2.accumulateWeighted(image, self._reference, share)
