# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Finds the contact on a hemispherical tip that a camera sees from inside."""

import sys
import time
from collections import Counter
from typing import TYPE_CHECKING

from rclpy.lifecycle import LifecycleState, TransitionCallbackReturn
from sensor_msgs.msg import CompressedImage, Image, JointState
from std_srvs.srv import Trigger

from tactile_push.interface import (
    CAMERA_SENSOR,
    COMPRESSED_IMAGE,
    IMAGE,
    TACTILE,
    TAKE_REFERENCE,
)
from tactile_push.needs_opencv import opencv_is_missing
from tactile_push.nodes.ros.diagnostics import ERROR, OK, WARN, Diagnostics, Health
from tactile_push.nodes.ros.managed import ManagedNode
from tactile_push.nodes.ros.messages import filled
from tactile_push.nodes.ros.node_time import NodeTime
from tactile_push.nodes.ros.parameters import declare, refusing
from tactile_push.nodes.ros.process import run
from tactile_push.nodes.ros.qos import IMAGES, PUBLISHED
from tactile_push.parameters.camera_sensor import (
    COMPRESSED,
    CameraSensorParameters,
    image_settings,
    make_image_finder,
)
from tactile_push.pipeline.stamps import stamp_of

if TYPE_CHECKING:
    from tactile_push.pipeline.images import Seen
    from tactile_push.tactile.image_contact import ImageContact

PATIENCE = 0.3  # of refused images alone until it is an error [s]: the finger has stopped by then


class CameraSensor(ManagedNode):
    """Managed node: `image` or `image/compressed` in, `tactile` out.

    The node reports an error when no image came for `silence_timeout`, while it has no reference,
    and when it refused all images for `PATIENCE`. It warns while it refuses some.
    """

    NAME = CAMERA_SENSOR

    def __init__(self) -> None:
        super().__init__(self.NAME)
        self._settings = declare(self, CameraSensorParameters, self._take_parameters)
        with refusing():
            self._finder = make_image_finder(self._settings)
        compressed = self._settings.image_transport == COMPRESSED
        self._topic = COMPRESSED_IMAGE if compressed else IMAGE
        self._kind = CompressedImage if compressed else Image
        self._time = NodeTime(self)
        self._is_active = False
        self._counted: Counter[str] = Counter(images=0, readings=0)
        self._begin()
        self.create_service(Trigger, TAKE_REFERENCE, self._on_take_reference)
        self._diagnostics = Diagnostics(self, self._health, lambda: self._counted)
        if self._settings.autostart:
            self.autostart()

    def on_configure(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Create the topics, and forget the reference."""
        self._begin()
        self._publisher = self.create_lifecycle_publisher(JointState, TACTILE, PUBLISHED)
        self._subscription = self.create_subscription(
            self._kind, self._topic, self._on_image, IMAGES
        )
        return TransitionCallbackReturn.SUCCESS

    def on_activate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Start to look."""
        result = super().on_activate(state)
        self._heard = self._useful = time.monotonic()
        self._is_active = True
        return result

    def on_deactivate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Stop to look."""
        self._is_active = False
        return super().on_deactivate(state)

    def on_cleanup(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Remove the topics."""
        self.destroy_lifecycle_publisher(self._publisher)
        self.destroy_subscription(self._subscription)
        return TransitionCallbackReturn.SUCCESS

    def on_shutdown(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Stop to look for good."""
        self._is_active = False
        return TransitionCallbackReturn.SUCCESS

    def _begin(self) -> None:
        from tactile_push.pipeline.images import Images  # needs OpenCV

        self._finder.forget()
        self._images = Images(self._finder, self._time.seconds)
        # When the last image came, and the last useful one, by a clock that cannot be set [s].
        self._heard = self._useful = time.monotonic()
        self._refusal = ''  # why the last refused image was refused
        self._seen: ImageContact | None = None  # in the last useful image

    def _take_parameters(self, settings: CameraSensorParameters) -> None:
        self._settings = settings
        self._finder.settings = image_settings(settings)

    def _on_image(self, message: Image | CompressedImage) -> None:
        if not self._is_active:
            return
        self._counted['images'] += 1
        now = time.monotonic()
        if now - self._heard > PATIENCE:
            self._useful = now  # after a silence patience starts over
        self._heard = now
        stamp = stamp_of(message)
        if self._kind is CompressedImage:
            seen = self._images.compressed(stamp, message.data)
        else:
            seen = self._images.image(
                *(stamp, message.encoding, message.height, message.width, message.step),
                message.data,
            )
        self._note(seen, now)
        for _, fields in seen.outputs():
            self._counted['readings'] += 1
            self._publisher.publish(filled(JointState(), fields))

    def _note(self, seen: 'Seen', now: float) -> None:
        if seen.contact is None:
            self._counted[f'refused: {seen.refusal}'] += 1
            self._refusal = seen.refusal
        else:
            self._useful = now
            self._seen = seen.contact

    def _on_take_reference(
        self, request: Trigger.Request, response: Trigger.Response
    ) -> Trigger.Response:
        from tactile_push.tactile.image_contact import ReferenceRefusedError

        try:
            if not self._is_active:
                raise ReferenceRefusedError('the node is not active')
            if time.monotonic() - self._heard > self._settings.silence_timeout:
                raise ReferenceRefusedError(f'no images on {self._topic}')
            self._finder.take_reference()
        except ReferenceRefusedError as reason:
            response.success, response.message = False, str(reason)
            self.get_logger().warning(f'no reference taken: {reason}')
        else:
            response.success, response.message = True, ''
            self.get_logger().info('reference taken')
        return response

    def _health(self) -> Health:
        values: dict[str, object] = {'reference': self._finder.has_reference}
        if self._seen is not None:
            values['area of the contact [sr]'] = f'{self._seen.area:.4f}'
            values['change of brightness'] = f'{self._seen.region.change:.1f}'
        level, message = self._judgement()
        return Health(level, message, values)

    def _judgement(self) -> tuple[bytes, str]:
        now = time.monotonic()
        if not self._is_active:
            return OK, 'inactive'
        if now - self._heard > self._settings.silence_timeout:
            return ERROR, f'no images on {self._topic}'
        if not self._finder.has_reference and self._refusal in ('', 'no reference'):
            trouble = self._finder.trouble and f' ({self._finder.trouble})'
            return ERROR, f'no reference{trouble}: lift the finger and call {TAKE_REFERENCE}'
        if now - self._useful > PATIENCE:
            return ERROR, f'images refused: {self._refusal}'
        if self._seen is None:
            return WARN, 'no reading yet'
        feels = 'contact' if self._seen.reading.in_contact else 'no contact'
        rates = self._diagnostics.rates
        if any(rate for name, rate in rates.items() if name.startswith('refused: ')):
            return WARN, f'{feels}, some images refused'
        return OK, feels


def main() -> int:
    """Run the node as a process."""
    if opencv_is_missing(CAMERA_SENSOR, 'cv2'):
        return 2
    import cv2

    cv2.setNumThreads(1)  # is fast enough, and leaves the other cores to the other nodes
    return run(CameraSensor)


if __name__ == '__main__':
    sys.exit(main())
