# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""From control periods to what is known of the object: what `active_sensing` does."""

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from tactile_push.control import Tick, tick_of
from tactile_push.estimation import ActiveSensing, ObjectEstimate, sensing_values, tells_pose
from tactile_push.interface import OBJECT_POSE, SENSING_STATE
from tactile_push.pipeline.messages import Output, joint_state_fields, object_pose_fields
from tactile_push.pipeline.named import by_name
from tactile_push.pipeline.stamps import Seconds, Stamp, stamp_before
from tactile_push.tactile import ReadingRejectedError
from tactile_push.tactile.pole_history import PoleHistory


class Sensed(NamedTuple):
    """What is known of the object after one control period."""

    stamp: Stamp  #: when the control period began [s, ns]
    values: dict[str, float]  #: numbers of `active_sensing/state` by name
    estimate: ObjectEstimate  #: what is known of the object
    took: bool  #: whether there was a reading
    forgot: str  #: why everything was forgotten; empty if it was not
    has_pose: bool  #: whether there is a new pose to publish
    blind: str  #: why the direction of the finger tip is not believed; empty if it is

    @property
    def known(self) -> bool:
        """Whether anything is known of the object."""
        return self.values['readings'] > 0.0 and not self.estimate.contradiction

    @property
    def read(self) -> Stamp:
        """When the reading was taken that the pose belongs to [s, ns]."""
        return stamp_before(*self.stamp, self.values['age'])

    def outputs(self) -> Iterator[Output]:
        """Yield the messages: the state and, if there is a new one, the pose."""
        yield SENSING_STATE, joint_state_fields(self.stamp, self.values)
        if self.has_pose:
            pose, covariance = self.estimate.pose, self.estimate.covariance
            yield OBJECT_POSE, object_pose_fields(self.read, pose, covariance)


class Sensing:
    """Senses the object from control periods.

    Parameters
    ----------
    sensing : ActiveSensing
        Finger motion and estimator.
    seconds : callable
        Returns the time [s] of a stamp.
    """

    def __init__(self, sensing: ActiveSensing, seconds: Seconds) -> None:
        self.sensing = sensing
        self._seconds = seconds
        self._ticked = -math.inf
        self._v_x = math.nan  # from the last tick on [m/s]

    def state(self, stamp: Stamp, names: Sequence[str], positions: Sequence[float]) -> Sensed:
        """Take a message of `push_controller/state`; ValueError if it is no control period.

        Parameters
        ----------
        stamp, names, positions : tuple of int, sequence of str, sequence of float
            When the control period began [s, ns], names and their values.

        Returns
        -------
        Sensed
            What is known then.
        """
        return self.tick(stamp, tick_of(by_name(names, positions)))

    def tick(self, stamp: Stamp, tick: Tick) -> Sensed:
        """Take a control period.

        Parameters
        ----------
        stamp, tick : tuple of int, Tick
            When it began [s, ns], and what the controller used and gave.

        Returns
        -------
        Sensed
            What is known then.
        """
        sensing = self.sensing
        now = self._seconds(*stamp)
        psi = self._psi(now, tick)
        x = self._x(tick) if math.isfinite(psi) else math.nan
        felt = tick.theta, tick.silence
        estimate = sensing.tick(now, *felt, tick.known_velocity, psi, x, tick.apart)
        return Sensed(
            stamp,
            sensing_values(estimate, sensing),
            estimate,
            sensing.took,
            sensing.forgot,
            tells_pose(estimate, sensing),
            sensing.blind,
        )

    def _x(self, tick: Tick) -> float:
        """Return where the finger was at the tick's reading [m]; NaN if the joints do not tell."""
        before, self._v_x = self._v_x, tick.known_velocity
        return tick.x_at_reading(before)

    def _psi(self, now: float, tick: Tick) -> float:
        """Return the direction of the finger tip at the tick's reading [rad]; NaN if unknown."""
        if not now >= self._ticked > -math.inf:  # the clock was set, or this is the first tick
            self._pole = PoleHistory(self.sensing.timeout)
        self._ticked = now
        self._pole.record(now - (0.0 if math.isnan(tick.finger_age) else tick.finger_age), tick.psi)
        try:
            return self._pole.at(now - tick.silence)
        except ReadingRejectedError:
            return math.nan
