# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The parameters of the nodes, for nodes that run and for runs without nodes."""

from tactile_push import interface
from tactile_push.parameters.active_sensing import ActiveSensingParameters
from tactile_push.parameters.bag_player import BagPlayerParameters
from tactile_push.parameters.bag_recorder import BagRecorderParameters
from tactile_push.parameters.camera_sensor import CameraSensorParameters
from tactile_push.parameters.config_file import config_file
from tactile_push.parameters.contact_geometry import ContactGeometryParameters
from tactile_push.parameters.experiment import ExperimentParameters
from tactile_push.parameters.finger_servo import FingerServoParameters
from tactile_push.parameters.live_page import LivePageParameters
from tactile_push.parameters.mujoco_plant import MujocoPlantParameters
from tactile_push.parameters.parameter import NodeParameters, Parameter
from tactile_push.parameters.push_controller import PushControllerParameters
from tactile_push.parameters.sensor_driver import SensorDriverParameters
from tactile_push.parameters.sim_plant import SimPlantParameters
from tactile_push.parameters.wrench_sensor import WrenchSensorParameters

PARAMETERS: dict[str, type[NodeParameters]] = {
    interface.SENSOR_DRIVER: SensorDriverParameters,
    interface.WRENCH_SENSOR: WrenchSensorParameters,
    interface.CAMERA_SENSOR: CameraSensorParameters,
    interface.CONTACT_GEOMETRY: ContactGeometryParameters,
    interface.PUSH_CONTROLLER: PushControllerParameters,
    interface.ACTIVE_SENSING: ActiveSensingParameters,
    interface.FINGER_SERVO: FingerServoParameters,
    interface.SIM_PLANT: SimPlantParameters,
    interface.MUJOCO_PLANT: MujocoPlantParameters,
    interface.EXPERIMENT: ExperimentParameters,
    interface.BAG_RECORDER: BagRecorderParameters,
    interface.BAG_PLAYER: BagPlayerParameters,
    interface.LIVE_PAGE: LivePageParameters,
}
"""The parameters of each node by the name of its executable."""

__all__ = [
    'PARAMETERS',
    'ActiveSensingParameters',
    'BagPlayerParameters',
    'BagRecorderParameters',
    'CameraSensorParameters',
    'ContactGeometryParameters',
    'ExperimentParameters',
    'FingerServoParameters',
    'LivePageParameters',
    'MujocoPlantParameters',
    'NodeParameters',
    'Parameter',
    'PushControllerParameters',
    'SensorDriverParameters',
    'SimPlantParameters',
    'WrenchSensorParameters',
    'config_file',
]
