# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The camera in the tip of a simulated finger: publishes what it sees."""

from builtin_interfaces.msg import Time
from rclpy.node import Node
from sensor_msgs.msg import Image

from tactile_push.interface import FINGERTIP, IMAGE
from tactile_push.nodes.ros.qos import PUBLISHED
from tactile_push.parameters.sim_plant import SimPlantParameters
from tactile_push.parameters.simulated_camera import dome_view
from tactile_push.simulation.dome_image import DomeImages, pressed
from tactile_push.tactile import NO_CONTACT, Reading


class PlantCamera:
    """Renders and publishes images.

    The first ones that somebody hears show an untouched tip, as before a finger is lowered to the
    object, so that a reference can be taken.
    """

    def __init__(self, node: Node, p: SimPlantParameters) -> None:
        self._publisher = node.create_publisher(Image, IMAGE, PUBLISHED)
        self._dome = DomeImages(dome_view(p.image_noise), p.seed)
        self._untouched = p.untouched_images  # still to come

    @property
    def touches(self) -> bool:
        """Whether the tip touches what it pushes."""
        return self._untouched == 0

    def publish(self, reading: Reading, force: tuple[float, float], stamp: Time) -> None:
        """Publish what the camera sees of a contact with a force on the object [N]."""
        if not self.touches:
            self._untouched -= self._publisher.get_subscription_count() > 0
            image = self._dome.image(NO_CONTACT)
        else:
            image = self._dome.image(pressed(reading, force))
        message = Image(height=image.shape[0], width=image.shape[1], encoding='mono8')
        message.step = image.shape[1]
        message.header.stamp, message.header.frame_id = stamp, FINGERTIP
        message.data.frombytes(image.tobytes())
        self._publisher.publish(message)
