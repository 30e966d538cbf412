# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Which number goes into which field of a message.

The fields of a message are nested dicts by field name. `tactile_push.nodes.ros.messages` turns them
into a ROS message and `tactile_push.replay.new_bag` into CDR. A field that is not there has its
default value.
"""

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from tactile_push.interface import FINGER_BASE, FINGER_DISK, TACTILE, TOPICS
from tactile_push.pipeline.orientation import covariance_in_space, quaternion_of_yaw
from tactile_push.pipeline.stamps import Stamp
from tactile_push.tactile.reading import Reading

Fields = dict[str, Any]
"""Fields of a message by name; those of a message within it again as `Fields`."""
Output = tuple[str, Fields]
"""Topic without the namespace, and the fields of the message."""


def joint_state_fields(stamp: Stamp, values: Mapping[str, float]) -> Fields:
    """Return the fields of a JointState with positions by name."""
    header = _header(stamp, '')
    return {'header': header, 'name': list(values), 'position': list(values.values())}


def tactile_fields(stamp: Stamp, reading: Reading, tangential_force: float | None = None) -> Fields:
    """Return the fields of a message of `tactile`, with the tangential force [N] if it is given."""
    more = [] if tangential_force is None else [tangential_force]
    values = [reading.azimuth, reading.elevation, reading.normal_force, *more]
    fields = TOPICS[TACTILE].fields[: len(values)]

    def array(name: str) -> list[float]:
        """Return an array of the message, NaN for fields that stand in the other one."""
        together = zip(fields, values, strict=True)
        return [value if field.array == name else math.nan for field, value in together]

    return {
        'header': _header(stamp, ''),
        'name': [field.name for field in fields],
        'position': array('position'),
        'effort': array('effort'),
    }


def wrench_fields(stamp: Stamp, frame: str, wrench: Sequence[float]) -> Fields:
    """Return the fields of a WrenchStamped: force [N], then moment [N m]."""
    force, torque = (dict(zip('xyz', three, strict=True)) for three in (wrench[:3], wrench[3:]))
    return {'header': _header(stamp, frame), 'wrench': {'force': force, 'torque': torque}}


def pose_fields(stamp: Stamp, x: float, y: float, yaw: float) -> Fields:
    """Return the fields of a PoseStamped in `finger_disk`: a point [m] and an angle [rad]."""
    return {'header': _header(stamp, FINGER_DISK), 'pose': _pose(x, y, yaw)}


def place_goal_fields(stamp: Stamp, x: float, theta: float) -> Fields:
    """Return the fields of a goal in `finger_base`: the centre of mass [m] and the edge [rad]."""
    return {'header': _header(stamp, FINGER_BASE), 'pose': _pose(x, 0.0, theta)}


def command_fields(stamp: Stamp, v_x: float, v_y: float = 0.0) -> Fields:
    """Return the fields of a TwistStamped: the finger's velocity across and along [m/s]."""
    return {'header': _header(stamp, FINGER_BASE), 'twist': {'linear': {'x': v_x, 'y': v_y}}}


def velocities_fields(velocities: Sequence[float]) -> Fields:
    """Return the fields of a Float64MultiArray: a velocity for each joint [rad/s] or [m/s]."""
    return {'data': list(velocities)}


def object_pose_fields(
    stamp: Stamp, pose: npt.NDArray[np.float64], covariance: npt.NDArray[np.float64]
) -> Fields:
    """Return the fields of a PoseWithCovarianceStamped: x, y [m] and angle [rad] of the object."""
    in_space = covariance_in_space(covariance.tolist())
    uncertain = {'pose': _pose(*pose.tolist()), 'covariance': in_space}
    return {'header': _header(stamp, FINGER_DISK), 'pose': uncertain}


def _header(stamp: Stamp, frame: str) -> Fields:
    return {'stamp': {'sec': stamp[0], 'nanosec': stamp[1]}, 'frame_id': frame}


def _pose(x: float, y: float, yaw: float) -> Fields:
    z, w = quaternion_of_yaw(yaw)
    return {'position': {'x': x, 'y': y}, 'orientation': {'z': z, 'w': w}}
