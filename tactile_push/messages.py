# Copyright 2026 The tactile_push authors
#
# Licensed under the Apache License, Version 2.0 (the "License");
# you may not use this file except in compliance with the License.
# You may obtain a copy of the License at
#
#     http://www.apache.org/licenses/LICENSE-2.0
#
# Unless required by applicable law or agreed to in writing, software
# distributed under the License is distributed on an "AS IS" BASIS,
# WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
# See the License for the specific language governing permissions and
# limitations under the License.
"""The messages by which the nodes tell what they have computed."""

from collections.abc import Mapping

from builtin_interfaces.msg import Time
from geometry_msgs.msg import PoseStamped, TwistStamped
from sensor_msgs.msg import JointState

from tactile_push.control import STATES, STOP_REASONS, PushLaw, Tick
from tactile_push.tactile import REFUSALS, Contact, Reading, quaternion_of_yaw

FINGER_DISK = 'finger_disk'  # frame of the contacts
FINGER_BASE = 'finger_base'  # frame of the commands


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


def reading_state(
    reading: Reading, joint_angle: float, theta: float, refusal: str, stamp: Time
) -> JointState:
    """Give all that the contact geometry used and gave for one reading.

    Parameters
    ----------
    reading : Reading
        The sensor's angles [rad].
    joint_angle : float
        By how far the joints had turned the finger tip at its moment [rad]; NaN if not known.
    theta : float
        Angle of the pushed edge [rad]; NaN if the reading was refused.
    refusal : str
        Why it was refused, one of `REFUSALS`.
    stamp : Time
        When the sensor was read.

    Returns
    -------
    JointState
        The message.
    """
    values = {
        'azimuth': reading.azimuth,
        'elevation': reading.elevation,
        'joint_angle': joint_angle,
        'theta': theta,
        'refusal': float(REFUSALS.index(refusal)),
    }
    return named_values(stamp, values)


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


def tick_state(tick: Tick, law: PushLaw, stamp: Time) -> JointState:
    """Give all that one control period used and gave.

    Parameters
    ----------
    tick : Tick
        The control period.
    law : PushLaw
        The law that acted in it.
    stamp : Time
        Its time.

    Returns
    -------
    JointState
        The message.
    """
    values = {
        'theta': tick.theta,
        'theta_desired': law.theta_desired,
        'phi': tick.phi,
        'v_x': float('nan') if tick.v_x is None else tick.v_x,
        'kp': law.kp,
        'kd': law.kd,
        'silence': tick.silence,
        'saturated': float(tick.saturated),
        'limited': float(tick.limited),
        'finger_x': tick.finger_x,
        'state': float(STATES.index(tick.state)),
        'stop_reason': float(STOP_REASONS.index(tick.stop_reason)),
        'ticks': float(tick.ticks),
        'ticks_lost': float(tick.ticks_lost),
        'elapsed': tick.elapsed,
        'finger_age': tick.finger_age,
    }
    return named_values(stamp, values)
