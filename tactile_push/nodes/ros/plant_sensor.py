# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What a simulated finger feels with: readings as a device's bytes, wrenches and images."""

from collections import Counter
from typing import TYPE_CHECKING

from builtin_interfaces.msg import Time
from geometry_msgs.msg import WrenchStamped
from rclpy.node import Node

from tactile_push.devices import Sentence, encode
from tactile_push.interface import WRENCH
from tactile_push.needs_opencv import missing_for_images
from tactile_push.nodes.ros.messages import publish
from tactile_push.nodes.ros.parameters import ConfigurationError, refusing
from tactile_push.nodes.ros.qos import PUBLISHED
from tactile_push.parameters.sim_plant import SimPlantParameters, faults, mount
from tactile_push.pipeline.messages import wrench_fields
from tactile_push.simulation import ForceReadout, Readout, Rig, Sensor, serve
from tactile_push.tactile import Reading

if TYPE_CHECKING:
    from tactile_push.nodes.ros.plant_camera import PlantCamera
    from tactile_push.simulation.mujoco_rig import MujocoRig

# A reading of which nothing is heard while it is repeated so often is lost, and sent again. Sooner,
# the first one might only be late, and the second one would be taken for the next reading.
LOST = 25
WRENCH_FRAME = 'force_sensor'  # of what the simulated one measures


class PlantSensor:
    """Reads a rig, and sends what it says.

    Parameters
    ----------
    node : Node
        The plant's node.
    p : SimPlantParameters
        What there is.
    counts : Counter
        Takes how many readings are sent and lost.

    Raises
    ------
    ConfigurationError
        If the device cannot be served, or what it takes is missing.
    ValueError
        If values of parameters do not fit together.
    """

    def __init__(self, node: Node, p: SimPlantParameters, counts: 'Counter[str]') -> None:
        self._counts = counts
        self._mount = mount(p)
        self._readout = Readout(faults(p).sensor, p.seed)
        self._force_readout = ForceReadout(p.seed)
        self._sequence = 0
        self._last: Reading | None = None  # if a contact has to follow
        self._under_way = 0  # for how many repetitions it may still become a contact
        with refusing('device'):
            self._device = serve(p.device)
        self._wrench = (
            node.create_publisher(WrenchStamped, WRENCH, PUBLISHED) if p.publish_wrench else None
        )
        self._camera = _camera(node, p) if p.publish_image else None

    @property
    def feels_force(self) -> bool:
        """Whether it measures forces, so that it begins with the object pressed to it."""
        return self._wrench is not None

    def close(self) -> None:
        """Stop serving the device."""
        self._device.close()

    def err(self, sensor: Sensor) -> None:
        """Err in another way from now on."""
        self._readout.sensor = sensor

    def read(self, rig: 'Rig | MujocoRig', time: float, stamp: Time) -> bool:
        """Read the rig at a time [s] and send what is felt.

        Returns
        -------
        bool
            Whether a contact has to follow from it.
        """
        self._last = None
        if self._wrench is not None:
            truth = self._mount.wrench(rig.contact_force, rig.theta, rig.psi)
            wrench = self._force_readout.read(rig.faults.force_sensor, truth, time)
            at = (stamp.sec, stamp.nanosec)
            publish(self._wrench, wrench_fields(at, WRENCH_FRAME, wrench.tolist()))
        if self._camera is not None:
            self._camera.publish(rig.reading(), rig.contact_force, stamp)
        for sample in self._readout.read(rig.reading(), time):
            if sample.reading is None:
                self._sequence += 1  # as of a sentence that never arrives
                self._counts['readings lost'] += 1
                continue
            self._send(sample.reading)
            if sample.likely and (self._camera is None or self._camera.touches):
                self._last = sample.reading
        return self._last is not None

    def heard(self) -> None:
        """Take note that the last reading was heard, whatever became of it."""
        self._under_way = 0

    def repeat(self) -> None:
        """Send the last reading again if a contact has to follow, and it was refused or is lost."""
        if self._last is None:
            return
        if self._under_way > 0:
            self._under_way -= 1
        else:
            self._send(self._last)

    def _send(self, reading: Reading) -> None:
        self._device.send(encode(Sentence(self._sequence, reading)))
        self._under_way = LOST
        self._sequence += 1
        self._counts['readings sent'] += 1


def _camera(node: Node, p: SimPlantParameters) -> 'PlantCamera':
    if needed := missing_for_images('cv2'):
        raise ConfigurationError(f'parameter publish_image: {needed}')
    from tactile_push.nodes.ros.plant_camera import PlantCamera

    return PlantCamera(node, p)
