# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Control periods for a bag that does not tell when the controller ticked, or had none."""

import math
from collections.abc import Iterator, Mapping
from typing import Any

from tactile_push.control import PushLaw
from tactile_push.parameters.push_controller import (
    PushControllerParameters,
    make_control,
    make_finger,
)
from tactile_push.pipeline.stamps import seconds_since
from tactile_push.replay.controller import Replayed
from tactile_push.replay.geometry import Stamp


class OwnTicks:
    """Runs the law at its own rate on the contacts' stamps, from the first contact on.

    Parameters
    ----------
    given : mapping of str to object
        Values of the node's parameters that are not the default.
    epoch : int
        From when on times count [s].

    Attributes
    ----------
    law : PushLaw
        The law.

    Raises
    ------
    ValueError
        If a value is refused.
    """

    def __init__(self, given: Mapping[str, Any], epoch: int) -> None:
        values = PushControllerParameters.of(given)
        self._names = values.joint_names
        self._control = make_control(values)
        self._finger = make_finger(values)
        self._epoch = epoch
        self._begin: int | None = None  # of the first period [ns]
        self._ticks = 0

    @property
    def law(self) -> PushLaw:
        """The law."""
        return self._control.law

    def joint_states(self, message: Any) -> None:
        """Take a message of `joint_states`.

        Parameters
        ----------
        message : sensor_msgs/JointState
            The message.
        """
        angles = dict(zip(message.name, message.position, strict=False))
        try:
            x = self._finger.forward(*(angles[name] for name in self._names)).x
        except (KeyError, ValueError):
            return
        stamp = message.header.stamp
        self._control.locate_finger(x, seconds_since(self._epoch, stamp.sec, stamp.nanosec))

    def reading(self, theta: float | None, stamp: Stamp, log_time: int) -> Iterator[Replayed]:
        """Take a reading.

        Parameters
        ----------
        theta : float or None
            Angle of the pushed edge [rad]; None if the reading tells of no contact.
        stamp : tuple of int
            When the sensor was read [s, ns].
        log_time : int
            When that was recorded [ns].

        Yields
        ------
        Replayed
            The ticks that were due before it.
        """
        at = stamp[0] * 10**9 + stamp[1]
        if self._begin is None:
            if theta is None:
                return
            self._begin = at
            self._control.activate(self._seconds(at))
        while (due := self._begin + round(self._ticks * self._control.period * 1e9)) < at:
            tick = self._control.tick(self._seconds(due), math.nan)
            self._ticks += 1
            yield Replayed(divmod(due, 10**9), log_time, tick, None)
        if theta is not None:
            self._control.feel(theta, self._seconds(at))

    def _seconds(self, nanoseconds: int) -> float:
        return seconds_since(self._epoch, *divmod(nanoseconds, 10**9))
