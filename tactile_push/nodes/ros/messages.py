# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The messages by which the nodes tell what they have computed."""

from collections.abc import Mapping

from builtin_interfaces.msg import Time
from geometry_msgs.msg import PoseStamped, PoseWithCovarianceStamped, TwistStamped
from sensor_msgs.msg import JointState

from tactile_push.interface import FINGER_BASE, FINGER_DISK
from tactile_push.mechanics.compiled import Array
from tactile_push.pipeline.orientation import covariance_in_space, quaternion_of_yaw
from tactile_push.pipeline.stamps import stamp_before
from tactile_push.tactile import Contact


def named_values(stamp: Time, values: Mapping[str, float]) -> JointState:
    """Give numbers with names, as plotting tools unfold them.

    Parameters
    ----------
    stamp : Time
        Their time.
    values : mapping of str to float
        The numbers by name.

    Returns
    -------
    JointState
        The message.
    """
    message = JointState(name=list(values), position=list(values.values()))
    message.header.stamp = stamp
    return message


class ContactMessage:
    """Gives the message of a contact: the same one every time, for publishing copies it."""

    def __init__(self) -> None:
        self._pose = PoseStamped()
        self._pose.header.frame_id = FINGER_DISK

    def of(self, contact: Contact, stamp: Time) -> PoseStamped:
        """Give the message.

        Parameters
        ----------
        contact : Contact
            The contact.
        stamp : Time
            When the sensor was read.

        Returns
        -------
        PoseStamped
            Its position and the edge's angle.
        """
        pose = self._pose
        pose.header.stamp = stamp
        pose.pose.position.x, pose.pose.position.y = contact.x, contact.y
        orientation = pose.pose.orientation
        orientation.z, orientation.w = quaternion_of_yaw(contact.theta)
        return pose


def velocity_command(v_x: float, stamp: Time) -> TwistStamped:
    """Give a command to the finger.

    Parameters
    ----------
    v_x : float
        Velocity across the belt [m/s].
    stamp : Time
        When it was decided on.

    Returns
    -------
    TwistStamped
        The message.
    """
    command = TwistStamped()
    command.header.stamp = stamp
    command.header.frame_id = FINGER_BASE
    command.twist.linear.x = v_x
    return command


def object_pose_message(
    pose: Array, covariance: Array, stamp: Time, age: float
) -> PoseWithCovarianceStamped:
    """Give the message of where the object is.

    Parameters
    ----------
    pose : ndarray, shape (3,)
        x, y of the centre of mass [m] and angle of the object [rad].
    covariance : ndarray, shape (3, 3)
        Their covariance.
    stamp : Time
        When the pose was told.
    age : float
        How much earlier the object was there [s].

    Returns
    -------
    PoseWithCovarianceStamped
        The message; what sticks out of the plane is exactly 0.
    """
    sec, nanosec = stamp_before(stamp.sec, stamp.nanosec, age)
    message = PoseWithCovarianceStamped()
    message.header.stamp = Time(sec=sec, nanosec=nanosec)
    message.header.frame_id = FINGER_DISK
    x, y, angle = pose.tolist()
    message.pose.pose.position.x, message.pose.pose.position.y = x, y
    orientation = message.pose.pose.orientation
    orientation.z, orientation.w = quaternion_of_yaw(angle)
    message.pose.covariance = covariance_in_space(covariance.tolist())
    return message
