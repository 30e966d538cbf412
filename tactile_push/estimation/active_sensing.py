# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""From the ticks of the controller to what is known of the object."""

import math

from tactile_push.estimation.finger_motion import FingerMotion
from tactile_push.estimation.object_estimator import Estimator, ObjectEstimate

# Reasons to forget everything.
CONTACT_LOST = 'contact lost'
MOTION_UNKNOWN = 'the finger moved unknown to the controller'
TICKS_MISSING = 'ticks missing'
TIME_WENT_BACK = 'time went back'

SAME_STAMP = 1e-6  # in which two stamps are the same [s]
FASTEST = 1.0  # a faster command counts as an unknown motion [m/s]


class ActiveSensing:
    """Feeds an estimator with the controller's ticks, each with a reading and a command.

    A push is the finger's motion between two readings. If the controller does not know how the
    finger moved, or whether it touched the object all the time, the estimator forgets everything,
    because what is known of one contact says nothing about another.

    It has no clock: the same ticks in the same order give the same estimates.

    Parameters
    ----------
    estimator : ObjectEstimator or DiskEstimator
        What is fed.
    motion : FingerMotion
        How the finger answers its commands.
    belt_speed : float
        Speed of the belt [m/s].
    timeout : float
        Without a reading or a tick for longer the contact may have been lost meanwhile [s].

    Attributes
    ----------
    readings : int
        Readings taken since everything was forgotten.
    took : bool
        Whether the last tick brought one.
    forgot : str
        Why everything was forgotten at the last tick; empty if it was not.
    age : float
        Age of the last reading at the last tick [s]; NaN without one.
    """

    def __init__(
        self, estimator: Estimator, motion: FingerMotion, belt_speed: float, timeout: float
    ) -> None:
        self._estimator = estimator
        self._motion = motion
        self._belt_speed = belt_speed
        self._timeout = timeout
        self._ticked = -math.inf
        self._read = math.nan  # when the last reading was taken [s]
        self._v_x = math.nan  # from the last tick on
        self.readings = 0
        self.took = False
        self.forgot = ''
        self.age = math.nan

    def tick(self, stamp: float, theta: float, silence: float, v_x: float) -> ObjectEstimate:
        """Take a tick.

        Parameters
        ----------
        stamp : float
            Time of the tick [s].
        theta : float
            Last reading of the edge's angle [rad]; NaN if there is none.
        silence : float
            How old the reading was [s].
        v_x : float
            Velocity of the finger that was commanded from then on [m/s]; NaN if somebody else may
            move it.

        Returns
        -------
        ObjectEstimate
            What is known of the object at the moment of the last reading.
        """
        self.took = False
        self.forgot = self._reason_to_forget(stamp, theta, silence)
        if self.forgot:
            self._estimator.reset()
            self.readings = 0
            self._read = math.nan
        before = 0.0 if math.isnan(self._v_x) else self._v_x
        self._ticked, self._v_x = stamp, v_x if abs(v_x) <= FASTEST else math.nan
        touches = self._touches(theta, silence)
        self.age = silence if touches else math.nan
        read = stamp - silence
        if not touches or math.isnan(self._v_x) or read <= self._read + SAME_STAMP:
            estimate = self._estimator.estimate()
        elif not self.readings:
            self._motion.reset(read, before)
            estimate = self._take(theta, read, 0.0, 0.0)
        else:
            duration = read - self._read
            estimate = self._take(theta, read, self._motion.way(read) / duration, duration)
        if self.readings:
            self._motion.command(stamp, self._v_x)
        return estimate

    def _take(self, theta: float, read: float, v_x: float, duration: float) -> ObjectEstimate:
        self.took = True
        self.readings += 1
        self._read = read
        return self._estimator.push(theta, v_x, self._belt_speed, duration)

    def _touches(self, theta: float, silence: float) -> bool:
        """Return whether a pushed edge was felt a moment ago."""
        return abs(theta) < math.pi / 2.0 and 0.0 <= silence <= self._timeout

    def _reason_to_forget(self, stamp: float, theta: float, silence: float) -> str:
        if not self.readings:
            return ''
        if stamp < self._ticked:
            return TIME_WENT_BACK
        if stamp - self._ticked > self._timeout:
            return TICKS_MISSING
        if not self._touches(theta, silence):
            return CONTACT_LOST
        if math.isnan(self._v_x):
            return MOTION_UNKNOWN
        return ''
