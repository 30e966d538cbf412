# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""From readings and joint angles to contacts; readings without a contact are refused."""

import math
from collections.abc import Iterable

from tactile_push.tactile.hemisphere import Contact, ReadingRejectedError, contact_of_reading
from tactile_push.tactile.jumps import JUMP_TOLERANCE, MAX_THETA_RATE, JumpGuard
from tactile_push.tactile.planar_finger import pole_angle
from tactile_push.tactile.pole_history import BELIEVED, PoleHistory
from tactile_push.tactile.reading import Reading

MAX_OUT_OF_PLANE = 0.2  # a face or a finger that leans by 11.5 degrees; picked
REFUSALS = (  # why a reading is refused; '' if it is not
    '',
    'not newer',
    'no joint state',
    'stale joint state',
    'direction of the finger unknown',
    'no contact',
    'off the hemisphere',
    'beyond the detectable range',
    'out of plane',
    'isolated jump',
    'no azimuth and elevation',
    'negative stamp',
)


class ContactFinder:
    """Finds the contact of each reading, and refuses readings without one.

    It has no clock: the same stamps and numbers in the same order give the same contacts.

    The stamps of readings should increase. A reading that is not newer than the last one came late
    or twice and is refused, so the contacts' stamps increase strictly. `BELIEVED` readings in a row
    that are not newer than the last one, but each newer than the one before it, mean that the clock
    was set back: the last of them counts as a first reading. A repeated reading never does.
    Later readings are not compared with one that was refused for its joint state, so a single stamp
    far in the future does not stop them if the finger turns.

    Parameters
    ----------
    radius : float
        Effective radius of the finger's disk [m].
    max_out_of_plane : float, optional
        Bound on |cos(elevation) sin(azimuth)|, the part of the contact's direction that sticks
        out of the plane of motion.
    detectable_range : float, optional
        Largest angle between the pole and a contact that the sensor detects properly [rad].
    max_theta_rate : float, optional
        How fast theta can turn [rad/s]; `jumps` derives it.
    jump_tolerance : float, optional
        How far two readings of the same theta may differ [rad].
    joint_state_timeout : float or None, optional
        How far in time a reading may be from the nearest joint angles [s]. None if the finger tip
        does not turn: its direction is the mount angle.
    mount_angle : float, optional
        Angle of the finger tip's pole in `finger_base` at joint angles zero [rad].
    """

    def __init__(
        self,
        radius: float,
        max_out_of_plane: float = MAX_OUT_OF_PLANE,
        detectable_range: float = math.pi / 2.0,
        max_theta_rate: float = MAX_THETA_RATE,
        jump_tolerance: float = JUMP_TOLERANCE,
        joint_state_timeout: float | None = None,
        mount_angle: float = math.pi / 2.0,
    ) -> None:
        # These four may be changed between readings.
        self.radius = radius
        self.max_out_of_plane = max_out_of_plane
        self.detectable_range = detectable_range
        self.mount_angle = mount_angle
        #: refuses jumps; `max_rate` and `tolerance` may be changed
        self.jumps = JumpGuard(max_theta_rate, jump_tolerance)
        #: where the tip pointed in the past; `timeout` may be changed; None if it does not turn
        self.pole = None if joint_state_timeout is None else PoleHistory(joint_state_timeout)
        #: how far the joints had turned the tip at the last reading [rad]; NaN if unknown
        self.joint_angle = math.nan
        self._newest = -math.inf
        self._newest_late = -math.inf
        self._late = 0

    def joints(self, stamp: float, angles: Iterable[float]) -> bool:
        """Take the angles of the moving joints.

        Parameters
        ----------
        stamp : float
            When they were read [s].
        angles : iterable of float
            Joint angles [rad], counterclockwise.

        Returns
        -------
        bool
            Whether they were taken: False if one is not finite, if they are not newer than those
            before, or if the finger tip does not turn.
        """
        return self.pole is not None and self.pole.record(stamp, pole_angle(0.0, angles))

    def contact(self, reading: Reading, stamp: float, joint_angle: float | None = None) -> Contact:
        """Find the contact of a reading.

        Parameters
        ----------
        reading : Reading
            The sensor's azimuth and elevation [rad].
        stamp : float
            When the sensor was read [s].
        joint_angle : float, optional
            By how far the joints had turned the tip then [rad], if the caller knows it;
            NaN if nobody knew it.

        Returns
        -------
        Contact
            theta and the contact point.

        Raises
        ------
        ReadingRejectedError
            If no contact can be trusted. The message is the reason, one of `REFUSALS`.
        """
        self.joint_angle = math.nan
        self._check_order(stamp)
        self.joint_angle = self._joint_angle(stamp) if joint_angle is None else joint_angle
        if math.isnan(self.joint_angle):
            raise ReadingRejectedError('no joint state')
        self._newest = stamp
        psi = self.mount_angle + self.joint_angle
        try:
            contact = contact_of_reading(
                reading, psi, self.radius, self.max_out_of_plane, self.detectable_range
            )
        except ReadingRejectedError:
            self.jumps.interrupt()
            raise
        self.jumps.check(stamp, contact.theta)
        return contact

    def _joint_angle(self, stamp: float) -> float:
        return 0.0 if self.pole is None else self.pole.at(stamp)

    def _check_order(self, stamp: float) -> None:
        if self._newest < stamp < math.inf:
            self._late = 0
            return
        if not math.isfinite(stamp):
            raise ReadingRejectedError('not newer')
        self._late = self._late + 1 if self._late and stamp > self._newest_late else 1
        self._newest_late = stamp
        if self._late < BELIEVED:
            raise ReadingRejectedError('not newer')
        self._late = 0
        self._newest = -math.inf
        self.jumps.restart()
