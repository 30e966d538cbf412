# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""From the ticks of the controller to what is known of the object."""

import math
from dataclasses import replace

from tactile_push.estimation.contradictions import BLIND, DISOBEYED
from tactile_push.estimation.finger_motion import FingerMotion
from tactile_push.estimation.joint_way import JointWay
from tactile_push.estimation.object_estimator import Estimator, ObjectEstimate
from tactile_push.interface import SILENT, STRAIGHT, WIDEN
from tactile_push.mechanics import CENTRE, added_way
from tactile_push.paper import FINGER_RADIUS

# Reasons to forget everything.
CONTACT_LOST = 'contact lost'
MOTION_UNKNOWN = 'the finger moved unknown to the controller'
TICKS_MISSING = 'ticks missing'
TIME_WENT_BACK = 'time went back'
TIP_UNKNOWN = 'direction of the finger tip unknown'
JOINTS_DOUBTED = 'the joints tell of another motion than was commanded'

SAME_STAMP = 1e-6  # in which two stamps are the same [s]
TOUCHING = 2.0  # control periods of pushing without a reading at two ends of a contact, at the most
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

    The finger tip turns while it moves, and its surface passes the contact. A tick tells the tip's
    direction at the moment of the reading, too. A reading without it is left out, and the next push
    is a longer one. After `timeout` it depends on `without_psi`: `SILENT` says nothing before the
    direction is told again, `WIDEN` takes each reading for the first one, and `STRAIGHT` takes the
    tip for one that does not turn.

    The joints tell where the finger is, too. A finger that does not quite follow its commands is
    believed (`JointWay`). If the joints tell of a quite different motion, they tell no direction of
    the tip either: the readings are taken for ones without it until the two agree again.

    A tick tells, too, when the finger is `apart`: it has left the object on purpose, or is about
    to. Then readings are left out and nothing is forgotten. The first reading after that is of
    another contact on the same edge, at the finger's way from the last one. If there is none in the
    tick in which the finger is not apart any more, everything is forgotten.

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
    point : int, optional
        Which point of the tip follows the commands: `CENTRE`, `POLE` or `CONTACT`.
    radius : float, optional
        Effective radius of the tip [m].
    without_psi : str, optional
        One of `interface.WITHOUT_PSI`.

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
    timeout : float
        As given.
    blind : str
        Why the last tick had a new reading, but no direction of the finger tip to believe, one of
        `CONTRADICTIONS`; empty if it had, or no reading.
    """

    def __init__(
        self,
        estimator: Estimator,
        motion: FingerMotion,
        belt_speed: float,
        timeout: float,
        *,
        point: int = CENTRE,
        radius: float = FINGER_RADIUS,
        without_psi: str = SILENT,
    ) -> None:
        self._estimator = estimator
        self._motion = motion
        self._joints = JointWay()
        self._belt_speed = belt_speed
        self.timeout = timeout
        self._point = point
        self._radius = radius
        self._without_psi = without_psi
        self._ticked = -math.inf
        self._read = math.nan  # when the last reading was taken [s]
        self._newest = math.nan  # the same of the last tick's, taken or not [s]
        self._seen = math.nan  # the first tick that had it [s]
        self._v_x = math.nan  # from the last tick on
        self._theta = self._psi = math.nan  # at the last reading [rad]
        self._apart = False  # whether the finger was off the object after the last tick
        self.readings = 0
        self.took = False
        self.forgot = ''
        self.age = math.nan
        self.blind = ''

    @property
    def noise(self) -> float:
        """Standard deviation of the readings of theta that the estimator expects [rad]."""
        return self._estimator.noise

    def tick(
        self,
        stamp: float,
        theta: float,
        silence: float,
        v_x: float,
        psi: float = math.pi / 2.0,
        x: float = math.nan,
        apart: bool = False,
    ) -> ObjectEstimate:
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
        psi : float, optional
            Direction of the finger tip at the moment of the reading [rad]; NaN if it is not known.
            By default it does not turn.
        x : float, optional
            Where the joints say that the finger is at that moment [m]; NaN if it is not known.
        apart : bool, optional
            Whether the finger is off the object on purpose from the tick on, or about to leave it.

        Returns
        -------
        ObjectEstimate
            What is known of the object at the moment of the last reading.
        """
        read = stamp - silence
        if not abs(read - self._newest) <= SAME_STAMP:
            self._newest, self._seen = read, stamp
        touches = self._touches(stamp, theta, silence)
        if self._without_psi == STRAIGHT and math.isnan(psi):
            psi = math.pi / 2.0
        is_new = not read <= self._read + SAME_STAMP
        untold = math.isnan(psi - self._psi if self.readings else psi)
        self.blind = BLIND if touches and is_new and untold else ''
        was_apart, self._apart = self._apart and self.readings > 0, apart
        left_out = was_apart and apart
        touched = touches and (not was_apart or (is_new and not self.blind))
        self.forgot = self._reason_to_forget(stamp, left_out or touched)
        too_long = read - self._read > self.timeout and not left_out
        if not self.forgot and self.blind and self.readings and too_long:
            self.forgot = TIP_UNKNOWN
        if self.forgot:
            self._estimator.reset()
            self.readings = 0
            self._read = math.nan
        before = 0.0 if math.isnan(self._v_x) else self._v_x
        ticked, self._ticked = self._ticked, stamp
        self._v_x = v_x if abs(v_x) <= FASTEST else math.nan
        self.age = silence if touches else math.nan
        is_new |= not self.readings
        left_out |= self.blind != '' and (self.readings > 0 or self._without_psi != WIDEN)
        self.took = touched and is_new and not left_out and not math.isnan(self._v_x)
        if self.took and not self.readings:
            self._motion.reset(read, before)
            self._joints.reset(x)
        if self.took or self.readings:
            self._motion.command(stamp, self._v_x)
        if self.took:
            again = was_apart and self.readings > 0
            unfelt = TOUCHING * (stamp - ticked) * self._belt_speed if again else None
            return self._take(theta, psi, x, read, unfelt)
        estimate = self._estimator.estimate()
        silent = self.blind and not self.readings
        return replace(estimate, contradiction=self.blind) if silent else estimate

    def _take(
        self, theta: float, psi: float, x: float, read: float, unfelt: float | None
    ) -> ObjectEstimate:
        """Take a reading and the push that led to it; the first one has none.

        If it is of another contact, there is a way on which the finger may have pushed `unfelt`.
        """
        way, duration, turned = self._motion.way(read), 0.0, 0.0
        if self.readings:
            duration = read - self._read
            turned = math.remainder(psi - self._psi, 2.0 * math.pi)
            mean = (self._theta + theta) / 2.0
            way += added_way(self._point, psi - turned, psi, mean, self._radius)
            if self._without_psi != STRAIGHT:
                doubted = self._joints.doubted
                way = self._joints.corrected(way, x, duration)
                self.forgot = JOINTS_DOUBTED if self._joints.doubted > doubted else ''
        self.readings += 1
        self._theta, self._psi, self._read = theta, psi, read
        if self._joints.doubted:
            return self._take_for_the_first(theta)
        if unfelt is not None:
            return self._estimator.touch_again(theta, way, unfelt)
        v_x, spin = (way / duration, turned / duration) if duration else (0.0, 0.0)
        return self._estimator.push(theta, v_x, self._belt_speed, duration, spin)

    def _take_for_the_first(self, theta: float) -> ObjectEstimate:
        """Take a reading before which nothing is known, because the joints are not believed."""
        self.blind = DISOBEYED
        self._estimator.reset()
        estimate = self._estimator.push(theta, 0.0, self._belt_speed, 0.0, 0.0)
        return (
            estimate if self._without_psi == WIDEN else replace(estimate, contradiction=DISOBEYED)
        )

    def _touches(self, stamp: float, theta: float, silence: float) -> bool:
        """Return whether a pushed edge was felt a moment ago.

        A clock that is ahead must not make a reading last longer than a right one would.
        """
        recent = abs(silence) <= self.timeout and stamp - self._seen <= self.timeout
        return abs(theta) < math.pi / 2.0 and recent

    def _reason_to_forget(self, stamp: float, touches: bool) -> str:
        if not self.readings:
            return ''
        if stamp < self._ticked:
            return TIME_WENT_BACK
        if stamp - self._ticked > self.timeout:
            return TICKS_MISSING
        if not touches:
            return CONTACT_LOST
        if math.isnan(self._v_x):
            return MOTION_UNKNOWN
        return ''
