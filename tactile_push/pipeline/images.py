# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""From images to readings: what `camera_sensor` does with each message."""

from collections.abc import Callable, Iterator
from typing import Any, NamedTuple

from tactile_push.devices.image_bytes import decoded_image, grey_image
from tactile_push.interface import TACTILE
from tactile_push.pipeline.geometry import NEGATIVE_STAMP
from tactile_push.pipeline.messages import Output, tactile_fields
from tactile_push.pipeline.stamps import Seconds, Stamp
from tactile_push.tactile import ReadingRejectedError
from tactile_push.tactile.image_contact import ImageContact, ImageContactFinder
from tactile_push.tactile.touched_region import Image
from tactile_push.tactile.wrench_reader import ANOTHER_FRAME


class Seen(NamedTuple):
    """What came of one image."""

    stamp: Stamp  #: when it was taken [s, ns]
    told: ImageContact | None  #: what it tells; None if it was refused
    refusal: str  #: why it was refused; empty if it was not

    def outputs(self) -> Iterator[Output]:
        """Yield the reading, if there is one, with the image's stamp."""
        if self.told is not None:
            yield TACTILE, tactile_fields(self.stamp, self.told.reading)


class Images:
    """Finds the reading that each image tells.

    Parameters
    ----------
    finder : ImageContactFinder
        Knows the untouched tip and finds the contact.
    seconds : callable
        Returns the time [s] of a stamp.
    frame : str, optional
        Frame in which the calibrated camera's images come; '' takes any.
    """

    def __init__(self, finder: ImageContactFinder, seconds: Seconds, frame: str = '') -> None:
        self.finder = finder
        self._seconds = seconds
        self._frame = frame

    def image(
        self,
        stamp: Stamp,
        frame: str,
        encoding: str,
        height: int,
        width: int,
        step: int,
        data: Any,
    ) -> Seen:
        """Take a message of `image`.

        Parameters
        ----------
        stamp : tuple of int
            When it was taken [s, ns].
        frame : str
            The camera's frame.
        encoding, height, width, step, data : str, int, int, int, buffer
            As in sensor_msgs/Image.

        Returns
        -------
        Seen
            What came of it.
        """
        return self._seen(stamp, frame, lambda: grey_image(encoding, height, width, step, data))

    def compressed(self, stamp: Stamp, frame: str, data: Any) -> Seen:
        """Take a message of `image/compressed`.

        Parameters
        ----------
        stamp : tuple of int
            When it was taken [s, ns].
        frame : str
            The camera's frame.
        data : buffer
            As in sensor_msgs/CompressedImage.

        Returns
        -------
        Seen
            What came of it.
        """
        return self._seen(stamp, frame, lambda: decoded_image(data))

    def _seen(self, stamp: Stamp, frame: str, read: Callable[[], Image]) -> Seen:
        if stamp[0] < 0:  # the reading would have it, too
            return Seen(stamp, None, NEGATIVE_STAMP)
        if self._frame and frame != self._frame:
            return Seen(stamp, None, ANOTHER_FRAME)
        try:
            contact = self.finder.contact(read(), self._seconds(*stamp))
        except ReadingRejectedError as reason:
            return Seen(stamp, None, str(reason))
        return Seen(stamp, contact, '')
