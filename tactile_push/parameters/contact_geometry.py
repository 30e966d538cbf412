# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The parameters of `contact_geometry`, and the contact finder that they make."""

import math
from dataclasses import dataclass

from tactile_push import paper
from tactile_push.parameters import shared
from tactile_push.parameters.parameter import NodeParameters, parameter
from tactile_push.tactile import JUMP_TOLERANCE, MAX_THETA_RATE, ContactFinder
from tactile_push.tactile.contact_finder import MAX_OUT_OF_PLANE
from tactile_push.tactile.planar_finger import USUAL_FINGER
from tactile_push.tactile.pole_history import JOINT_STATE_TIMEOUT


@dataclass(frozen=True)
class ContactGeometryParameters(NodeParameters):
    """The finger tip, and which readings to believe."""

    # fmt: off
    finger_radius: float = parameter(paper.FINGER_RADIUS, 'm',
        "effective radius of the finger's disk", 1e-4, 1.0)
    use_joint_states: bool = parameter(True, '',
        'take the direction of the finger tip from joint_states; otherwise it is mount_angle',
        read_only=True)
    mount_angle: float = parameter(USUAL_FINGER.mount_angle, 'rad',
        'angle of the finger tip in finger_base at joint angles zero', -6.3, 6.3)
    joint_names: list[str] = parameter(shared.JOINT_NAMES, '',
        'the moving joints in joint_states whose angles add up to the direction of the tip',
        read_only=True)
    joint_state_timeout: float = parameter(JOINT_STATE_TIMEOUT, 's',
        'longest time between a reading and the joint state used for it', 0.001, 10.0)
    max_out_of_plane: float = parameter(MAX_OUT_OF_PLANE, '',
        'largest size of cos(elevation) sin(azimuth), by which the direction of a contact sticks '
        'out of the plane of motion', 0.001, 1.0)
    detectable_range: float = parameter(math.pi / 2.0, 'rad',
        'largest angle between the pole and a contact that the sensor detects properly; pi/2 is '
        'the whole hemisphere', 0.01, 1.6)
    max_theta_rate: float = parameter(MAX_THETA_RATE, 'rad/s',
        'fastest turn of theta that is believed; it grows with the speed of the belt', 0.01, 1000.0)
    jump_tolerance: float = parameter(JUMP_TOLERANCE, 'rad',
        'how far two readings of the same theta may differ; pi believes every jump', 0.001, 3.2)
    # fmt: on


def make_finder(p: ContactGeometryParameters) -> ContactFinder:
    """Make a contact finder that has felt nothing yet.

    Raises
    ------
    ValueError
        If the tip turns with joints and none is named.
    """
    if p.use_joint_states and not p.joint_names:
        raise ValueError('joint_names: expected the name of a joint, got []')
    timeout = p.joint_state_timeout if p.use_joint_states else None
    finder = ContactFinder(p.finger_radius, joint_state_timeout=timeout)
    take_values(finder, p)
    return finder


def take_values(finder: ContactFinder, p: ContactGeometryParameters) -> None:
    """Set the finder's values that may change while it runs."""
    finder.radius = p.finger_radius
    finder.max_out_of_plane = p.max_out_of_plane
    finder.detectable_range = p.detectable_range
    finder.mount_angle = p.mount_angle
    finder.jumps.max_rate = p.max_theta_rate
    finder.jumps.tolerance = p.jump_tolerance
    if finder.pole is not None:
        finder.pole.timeout = p.joint_state_timeout
