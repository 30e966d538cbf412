# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Finds the contact on a hemispherical tip that a camera sees from inside."""

import sys
from typing import TYPE_CHECKING

from sensor_msgs.msg import CompressedImage, Image

from tactile_push.interface import CAMERA_SENSOR, COMPRESSED_IMAGE, IMAGE, TAKE_REFERENCE
from tactile_push.needs_opencv import opencv_is_missing
from tactile_push.nodes.ros.parameters import declare, refusing
from tactile_push.nodes.ros.process import run
from tactile_push.nodes.ros.qos import IMAGES
from tactile_push.nodes.ros.tip_sensor import TipSensor
from tactile_push.parameters.camera_sensor import (
    COMPRESSED,
    CameraSensorParameters,
    image_settings,
    make_image_finder,
)
from tactile_push.pipeline.stamps import stamp_of
from tactile_push.tactile.wrench_reader import ANOTHER_FRAME

if TYPE_CHECKING:
    from tactile_push.pipeline.images import Seen
    from tactile_push.tactile.image_contact import ImageContact


class CameraSensor(TipSensor[CameraSensorParameters]):
    """Managed node: `image` or `image/compressed` in, `tactile` out.

    A reference image tells the untouched tip.
    """

    NAME = CAMERA_SENSOR
    MESSAGES = 'images'
    SERVICE = TAKE_REFERENCE
    TAKEN, NOT_TAKEN = 'reference taken', 'no reference taken'
    _told: 'ImageContact | None'

    def __init__(self) -> None:
        from tactile_push.pipeline.images import Images  # needs OpenCV

        super().__init__()
        self._settings = declare(self, CameraSensorParameters, self._take_parameters)
        with refusing():
            self._finder = make_image_finder(self._settings)
        self._images = Images(*(self._finder, self._time.seconds), self._settings.calibrated_frame)
        compressed = self._settings.image_transport == COMPRESSED
        self._topic = COMPRESSED_IMAGE if compressed else IMAGE
        self._kind = CompressedImage if compressed else Image
        self._begin()

    def _forget_untouched(self) -> None:
        self._finder.forget()

    def _take_parameters(self, settings: CameraSensorParameters) -> None:
        self._settings = settings
        self._finder.settings = image_settings(settings)

    def _subscribe(self) -> None:
        self.make_subscription(self._kind, self._topic, self._on_message, IMAGES)

    def _came_of(self, message: Image | CompressedImage) -> 'Seen':
        stamp = stamp_of(message)
        if self._kind is CompressedImage:
            return self._images.compressed(stamp, message.header.frame_id, message.data)
        return self._images.image(
            *(stamp, message.header.frame_id, message.encoding),
            *(message.height, message.width, message.step, message.data),
        )

    def _take_untouched(self) -> None:
        self._finder.take_reference()

    def _ignorance(self) -> str:
        if self._finder.has_reference or self._refusal not in ('', 'no reference'):
            return ''
        trouble = self._finder.trouble and f' ({self._finder.trouble})'
        return f'no reference{trouble}'

    def _advice(self) -> str:
        return {ANOTHER_FRAME: f' than {self._settings.calibrated_frame}'}.get(self._refusal, '')

    def _values(self) -> dict[str, object]:
        values: dict[str, object] = {'reference': self._finder.has_reference}
        if self._told is not None:
            values['area of the contact [sr]'] = f'{self._told.area:.4f}'
            values['change of brightness'] = f'{self._told.region.change:.1f}'
        return values


def main() -> int:
    """Run the node as a process."""
    if opencv_is_missing(CAMERA_SENSOR, 'cv2'):
        return 2
    import cv2

    cv2.setNumThreads(1)  # is fast enough, and leaves the other cores to the other nodes
    return run(CameraSensor)


if __name__ == '__main__':
    sys.exit(main())
