# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Fields that several nodes declare under the same name and with the same words."""

from tactile_push import paper
from tactile_push.interface import JOINT_STATES, POINTS, TOPICS
from tactile_push.parameters.parameter import parameter
from tactile_push.tactile.planar_finger import USUAL_FINGER as FINGER

DEVICE = 'socket://127.0.0.1:54320'  # where `sim_plant` and `sensor_driver` meet
X, Y = paper.BLOCK_EDGE / 2.0, paper.BLOCK_L  # of a corner of the paper's block [m]
JOINT_NAMES = list(TOPICS[JOINT_STATES].field_names)

# fmt: off
finger_radius = parameter(paper.FINGER_RADIUS, 'm',
    "effective radius of the finger's disk", 1e-4, 1.0, read_only=True)
belt_speed = parameter(paper.BELT_SPEED, 'm/s', 'speed of the belt', 1e-5, 1.0, read_only=True)
finger_lag = parameter(0.0, 's',
    'time constant with which the finger follows its commands', 0.0, 10.0, read_only=True)
proximal_length = parameter(FINGER.proximal_length, 'm',
    'distance between the moving joints of the finger', 1e-3, 1.0, read_only=True)
distal_length = parameter(FINGER.distal_length, 'm',
    'distance from the last joint to the centre of the disk', 1e-3, 1.0, read_only=True)
mount_angle = parameter(FINGER.mount_angle, 'rad',
    'angle of the finger at joint angles zero', -6.3, 6.3, read_only=True)
commanded_point = parameter(POINTS[0], '',
    "point of the tip that follows the commanded velocity: the disk's centre, the pole as in the "
    'paper, or the contact', choices=POINTS, read_only=True)
calibrated_frame = parameter('', '',
    "frame of the calibrated sensor's messages; others are refused; empty takes any",
    read_only=True)
tip_xyz = parameter([0.0, 0.0, 0.02], 'm',
    "where the centre of the hemispherical tip is in the force/torque sensor's frame",
    read_only=True)
tip_rpy = parameter([0.0, 0.0, 0.0], 'rad',
    "roll, pitch and yaw of fingertip in the sensor's frame, as in a URDF: its z leads to the "
    'pole, its x lies in the plane of motion, to the left of the pole', read_only=True)
vertices = parameter([-X, -Y, X, -Y, X, Y, -X, Y], 'm',
    'outline of the object: x, y of every corner from its centre of mass, counterclockwise',
    read_only=True)
autostart = parameter(True, '', 'configure and activate without a manager', read_only=True)
# fmt: on
