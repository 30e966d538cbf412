# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""From readings and joint states to contacts: what `contact_geometry` does with each message."""

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from tactile_push.interface import CONTACT, GEOMETRY_STATE
from tactile_push.pipeline.messages import Output, joint_state_fields, pose_fields
from tactile_push.pipeline.named import OTHER_JOINTS, REFUSED, TAKEN, Joints, by_name
from tactile_push.pipeline.stamps import Seconds, Stamp
from tactile_push.tactile import (
    NO_CONTACT,
    Contact,
    ContactFinder,
    Reading,
    ReadingRejectedError,
    reading_values,
)

UNREADABLE, NEGATIVE_STAMP = 'no azimuth and elevation', 'negative stamp'


class Felt(NamedTuple):
    """What came of one reading."""

    stamp: Stamp  #: when the sensor was read [s, ns]
    reading: Reading  #: what the sensor sent; `NO_CONTACT` if the message had no angles
    joint_angle: float  #: how far the joints had turned the finger tip [rad]; NaN if unknown
    contact: Contact | None  #: None if the reading was refused
    refusal: str  #: why it was refused, one of `REFUSALS`; empty if it was not

    def outputs(self) -> Iterator[Output]:
        """Yield the messages: what became of the reading, and the contact, if there is one.

        The contact comes last: wherever a recording ends, a command that followed from a contact
        is then in it with the reading.
        """
        theta = math.nan if self.contact is None else self.contact.theta
        values = reading_values(self.reading, self.joint_angle, theta, self.refusal)
        yield GEOMETRY_STATE, joint_state_fields(self.stamp, values)
        if self.contact is not None:
            yield CONTACT, pose_fields(self.stamp, self.contact.x, self.contact.y, theta)


class Geometry:
    """Finds the contact that each reading tells of.

    Parameters
    ----------
    finder, joint_names : ContactFinder, sequence of str
        Finds contacts, and the joints whose angles add up to the direction of the finger tip.
    seconds : callable
        Returns the time [s] of a stamp.

    Attributes
    ----------
    joints : Joints
        What was found in the joint states.
    """

    def __init__(self, finder: ContactFinder, joint_names: Sequence[str], seconds: Seconds) -> None:
        self.finder = finder
        self.joints = Joints(joint_names)
        self._seconds = seconds

    def joint_states(self, stamp: Stamp, names: Sequence[str], positions: Sequence[float]) -> str:
        """Take a message of `joint_states`.

        Parameters
        ----------
        stamp, names, positions : tuple of int, sequence of str, sequence of float
            When the joints were read [s, ns], their names and their angles [rad].

        Returns
        -------
        str
            What the message was: `TAKEN`, `REFUSED` or `OTHER_JOINTS`.
        """
        angles = self.joints.angles(names, positions)
        if angles is None:
            return OTHER_JOINTS
        return TAKEN if self.finder.joints(self._seconds(*stamp), angles) else REFUSED

    def tactile(
        self,
        stamp: Stamp,
        names: Sequence[str],
        positions: Sequence[float],
        joint_angle: float | None = None,
    ) -> Felt:
        """Take a message of `tactile`.

        Parameters
        ----------
        stamp : tuple of int
            When the sensor was read [s, ns].
        names, positions : sequence of str, sequence of float
            Names, `azimuth` and `elevation` among them, and angles [rad]; NaN without a contact.
        joint_angle : float, optional
            How far the joints had turned the finger tip then [rad], if that is known otherwise than
            from `joint_states`; NaN if it is known that nobody knew.

        Returns
        -------
        Felt
            What came of the reading.
        """
        values = by_name(names, positions)
        try:
            reading = Reading(values['azimuth'], values['elevation'])
        except KeyError:
            return Felt(stamp, NO_CONTACT, math.nan, None, UNREADABLE)
        if stamp[0] < 0:  # the contact would have it, too
            return Felt(stamp, NO_CONTACT, math.nan, None, NEGATIVE_STAMP)
        try:
            contact = self.finder.contact(reading, self._seconds(*stamp), joint_angle)
        except ReadingRejectedError as reason:
            return Felt(stamp, reading, self.finder.joint_angle, None, str(reason))
        return Felt(stamp, reading, self.finder.joint_angle, contact, '')
