# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What `contact_geometry` does, over a bag's messages."""

import math
from collections.abc import Mapping
from dataclasses import replace
from typing import Any, NamedTuple

from tactile_push.parameters.contact_geometry import (
    ContactGeometryParameters,
    make_finder,
    take_values,
)
from tactile_push.pipeline.stamps import seconds_since
from tactile_push.tactile import NO_CONTACT, REFUSALS, Contact, Reading, ReadingRejectedError

UNREADABLE = 'no azimuth and elevation'

Stamp = tuple[int, int]  # [s, ns]


class Felt(NamedTuple):
    """What came out of one reading."""

    stamp: Stamp
    reading: Reading
    joint_angle: float
    contact: Contact | None
    refusal: str


class Geometry:
    """Finds the contacts of a bag's readings as the node did.

    What the node had heard of the joints when a reading came depends on how fast the messages
    travelled, which no bag tells. Where `contact_geometry/state` was recorded, it has the readings
    that the node took, in their order, and how the joints stood for each. Without it readings and
    joint states are taken in the bag's order.

    Parameters
    ----------
    given : mapping of str to object
        Values of the node's parameters that are not the default.
    epoch : int
        From when on times count [s].
    as_recorded : bool
        Whether `contact_geometry/state` was recorded.

    Attributes
    ----------
    as_recorded : bool
        As given.

    Raises
    ------
    ValueError
        If a value is refused.
    """

    def __init__(self, given: Mapping[str, Any], epoch: int, as_recorded: bool) -> None:
        self._values = ContactGeometryParameters.of(given)
        self._finder = make_finder(self._values)
        self._epoch = epoch
        self.as_recorded = as_recorded
        self._started = False

    def change(self, given: Mapping[str, Any]) -> None:
        """Take values of parameters that changed while the node ran.

        Parameters
        ----------
        given : mapping of str to object
            The values by name.
        """
        self._values = replace(self._values, **given)
        take_values(self._finder, self._values)

    def joint_states(self, message: Any) -> None:
        """Take a message of `joint_states`.

        Parameters
        ----------
        message : sensor_msgs/JointState
            The message.
        """
        angles = dict(zip(message.name, message.position, strict=False))
        try:
            joints = [angles[name] for name in self._values.joint_names]
        except KeyError:
            return
        stamp = message.header.stamp
        self._finder.joints(seconds_since(self._epoch, stamp.sec, stamp.nanosec), joints)

    def tactile(self, message: Any) -> Felt:
        """Take a message of `tactile`.

        Parameters
        ----------
        message : sensor_msgs/JointState
            The message.

        Returns
        -------
        Felt
            What came out of it.
        """
        values = dict(zip(message.name, message.position, strict=False))
        return self._feel(message, values, None, '')

    def state(self, message: Any) -> Felt | None:
        """Take a message of `contact_geometry/state`.

        Parameters
        ----------
        message : sensor_msgs/JointState
            The message.

        Returns
        -------
        Felt or None
            What came out of the reading; None as long as none was accepted since the bag's
            beginning, for nobody knows what they were refused by.
        """
        values = dict(zip(message.name, message.position, strict=False))
        refusal = REFUSALS[int(values['refusal'])]
        self._started = self._started or not refusal
        if not self._started:
            return None
        if refusal == UNREADABLE:
            values = {}
        return self._feel(message, values, values.get('joint_angle', math.nan), refusal)

    def _feel(
        self, message: Any, values: Mapping[str, float], joint_angle: float | None, refused: str
    ) -> Felt:
        stamp = (message.header.stamp.sec, message.header.stamp.nanosec)
        try:
            reading = Reading(values['azimuth'], values['elevation'])
        except KeyError:
            return Felt(stamp, NO_CONTACT, math.nan, None, UNREADABLE)
        if stamp[0] < 0:
            return Felt(stamp, NO_CONTACT, math.nan, None, 'negative stamp')
        finder = self._finder
        try:
            contact = finder.contact(reading, seconds_since(self._epoch, *stamp), joint_angle)
        except ReadingRejectedError as reason:
            refusal = str(reason)
            if joint_angle is not None and math.isnan(joint_angle) and refused:
                refusal = refused  # why the node knew of no joint angle
            return Felt(stamp, reading, finder.joint_angle, None, refusal)
        return Felt(stamp, reading, finder.joint_angle, contact, '')
