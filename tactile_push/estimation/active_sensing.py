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

    The sensor's clock may differ from the controller's: a tick tells how much older its reading is,
    or how far ahead. What the controller believes (`control.newest`) is believed here: a stamp
    within `timeout` of the tick, and no longer than `timeout` after the first tick that had it.
    A reading is about the moment of its stamp. If that lies after the tick, the tick's command
    moves the finger up to there, and a command that comes in between changes the next push.

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
        Without a reading or a tick for longer the contact may have been lost meanwhile [s]. A
        reading that is stamped further ahead is none.

    Attributes
    ----------
    readings : int
        Readings taken since everything was forgotten.
    took : bool
        Whether the last tick brought one.
    forgot : str
        Why everything was forgotten at the last tick; empty if it was not.
    age : float
        Age of the last reading at the last tick [s], negative if it is stamped ahead; NaN without
        one.
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
        self._newest = math.nan  # the same of the last tick's, taken or not [s]
        self._seen = math.nan  # the first tick that had it [s]
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
            How old the reading was [s], negative if it is stamped ahead.
        v_x : float
            Velocity of the finger that was commanded from then on [m/s]; NaN if somebody else may
            move it.

        Returns
        -------
        ObjectEstimate
            What is known of the object at the moment of the last reading.
        """
        read = stamp - silence
        if not abs(read - self._newest) <= SAME_STAMP:
            self._newest, self._seen = read, stamp
        touches = self._touches(stamp, theta, silence)
        self.forgot = self._reason_to_forget(stamp, touches)
        if self.forgot:
            self._estimator.reset()
            self.readings = 0
            self._read = math.nan
        before = 0.0 if math.isnan(self._v_x) else self._v_x
        self._ticked, self._v_x = stamp, v_x if abs(v_x) <= FASTEST else math.nan
        self.age = silence if touches else math.nan
        is_new = not read <= self._read + SAME_STAMP
        self.took = touches and is_new and not math.isnan(self._v_x)
        if self.took and not self.readings:
            self._motion.reset(read, before)
        if self.took or self.readings:
            self._motion.command(stamp, self._v_x)
        return self._take(theta, read) if self.took else self._estimator.estimate()

    def _take(self, theta: float, read: float) -> ObjectEstimate:
        """Take a reading and the push that led to it; the first one has none."""
        way = self._motion.way(read)
        duration = read - self._read if self.readings else 0.0
        self.readings += 1
        self._read = read
        v_x = way / duration if duration else 0.0
        return self._estimator.push(theta, v_x, self._belt_speed, duration)

    def _touches(self, stamp: float, theta: float, silence: float) -> bool:
        """Return whether a pushed edge was felt a moment ago.

        A clock that is ahead must not make a reading last longer than a right one would.
        """
        recent = abs(silence) <= self._timeout and stamp - self._seen <= self._timeout
        return abs(theta) < math.pi / 2.0 and recent

    def _reason_to_forget(self, stamp: float, touches: bool) -> str:
        if not self.readings:
            return ''
        if stamp < self._ticked:
            return TIME_WENT_BACK
        if stamp - self._ticked > self._timeout:
            return TICKS_MISSING
        if not touches:
            return CONTACT_LOST
        if math.isnan(self._v_x):
            return MOTION_UNKNOWN
        return ''
