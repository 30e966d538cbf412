# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What `active_sensing` does, over a bag's control periods."""

import math
from collections.abc import Iterator, Mapping, Set
from typing import Any, NamedTuple

from tactile_push.bags import Message
from tactile_push.control import Tick
from tactile_push.estimation import sensing_values, tells_pose
from tactile_push.parameters.active_sensing import ActiveSensingParameters
from tactile_push.parameters.estimator import make_sensing
from tactile_push.pipeline.cdr import encode_joint_state, encode_unsure_pose
from tactile_push.pipeline.orientation import covariance_in_space, quaternion_of_yaw
from tactile_push.pipeline.stamps import seconds_since, stamp_before
from tactile_push.replay.comparison import SensedTick
from tactile_push.replay.geometry import Stamp

STATE, POSE = 'active_sensing/state', 'object_pose'
TOPICS = {
    STATE: 'sensor_msgs/msg/JointState',
    POSE: 'geometry_msgs/msg/PoseWithCovarianceStamped',
}
DISK = 'finger_disk'  # frame of the pose

Output = tuple[str, bytes, int]
"""Topic without the namespace, message in CDR, log time [ns]."""
_Waiting = tuple[Stamp, int, Tick]
NOWHERE, EVERYWHERE = (-math.inf, 0), (math.inf, 0)  # before and after all stamps


class Sensed(NamedTuple):
    """What one control period told of the object.

    Parameters
    ----------
    values : dict of str to float
        The numbers of `active_sensing/state`.
    state : bytes
        That message.
    pose : bytes or None
        The message of `object_pose`, if there is one.
    took : bool
        Whether there was a reading.
    forgot : str
        Why everything was forgotten; empty if it was not.
    """

    values: dict[str, float]
    state: bytes
    pose: bytes | None
    took: bool
    forgot: str


class Sensing:
    """Senses the object from control periods.

    Parameters
    ----------
    given : mapping of str to object
        Values of the node's parameters that are not the default.
    epoch : int
        From when on times count [s].

    Raises
    ------
    ValueError
        If a value is refused.
    """

    def __init__(self, given: Mapping[str, Any], epoch: int) -> None:
        self._sensing = make_sensing(ActiveSensingParameters.of(given))
        self._epoch = epoch

    def tick(self, stamp: Stamp, tick: Tick) -> Sensed:
        """Take a control period.

        Parameters
        ----------
        stamp : tuple of int
            When it was [s, ns].
        tick : Tick
            What the controller used and gave.

        Returns
        -------
        Sensed
            What it told.
        """
        sensing = self._sensing
        now = seconds_since(self._epoch, *stamp)
        estimate = sensing.tick(now, tick.theta, tick.silence, tick.known_velocity)
        values = sensing_values(estimate, sensing)
        pose = None
        if tells_pose(estimate, sensing):
            x, y, angle = estimate.pose.tolist()
            pose = encode_unsure_pose(
                stamp_before(*stamp, sensing.age),
                DISK,
                (x, y, 0.0),
                (0.0, 0.0, *quaternion_of_yaw(angle)),
                covariance_in_space(estimate.covariance.tolist()),
            )
        state = encode_joint_state(stamp, values)
        return Sensed(values, state, pose, sensing.took, sensing.forgot)


class SensingAgain:
    """Makes what a node said again, from where it knew nothing on, as far as it was recorded.

    A node that came later than the controller did not hear the first control periods, and of one
    that was there before the recording nobody knows what it had heard. So what was recorded is kept
    until the node says that there was no reading before. At the end of a recording the node may not
    have come to the last control periods yet.

    Parameters
    ----------
    sensing : Sensing
        What senses.
    recorded : set of str
        Topics on which the node was recorded; of the others all is made.
    start : int
        First log time of the bag [ns].

    Attributes
    ----------
    sensed : list of SensedTick
        What the control periods told.
    kept : int
        Recorded messages of `active_sensing/state` that are kept.
    """

    def __init__(self, sensing: Sensing, recorded: Set[str], start: int) -> None:
        self._sensing = sensing
        self._start = start
        self._begun = STATE not in recorded
        self._begins: Stamp | None = (0, 0) if self._begun else None
        self._come_to: dict[str, tuple[float, int]] = {
            topic: NOWHERE if topic in recorded else EVERYWHERE for topic in TOPICS
        }
        # What is made of control periods to which the node has not come yet.
        self._ahead: dict[str, list[tuple[Stamp, Output]]] = {topic: [] for topic in TOPICS}
        self._before: _Waiting | None = None  # the last control period before it begins
        self._waiting: list[_Waiting] = []
        self._pose: tuple[Stamp, Message] | None = None  # which may belong to where it begins
        self.sensed: list[SensedTick] = []
        self.kept = 0

    def tick(self, stamp: Stamp, log_time: int, tick: Tick) -> Iterator[Output]:
        """Take a control period.

        Parameters
        ----------
        stamp : tuple of int
            When it was [s, ns].
        log_time : int
            When that was recorded [ns].
        tick : Tick
            What the controller used and gave.

        Yields
        ------
        tuple
            Messages to write.
        """
        if self._begins is None:
            self._waiting.append((stamp, log_time, tick))
            return
        if not self._begun and stamp < self._begins:
            self._before = stamp, log_time, tick
            return
        if not self._begun and self.kept and self._before is not None:
            # The node forgot what it knew, but not how the finger was moving.
            self._sensing.tick(self._before[0], self._before[2])
        self._begun = True
        sensed = self._sensing.tick(stamp, tick)
        since = (stamp[0] * 10**9 + stamp[1] - self._start) * 1e-9
        self.sensed.append(SensedTick.of(since, sensed.values))
        yield from self._give(stamp, (STATE, sensed.state, log_time))
        if sensed.pose is not None:
            read = stamp_before(*stamp, sensed.values['age'])
            yield from self._give(read, (POSE, sensed.pose, log_time))

    def state(self, message: Message, decoded: Any) -> Iterator[Output]:
        """Take a recorded message of `active_sensing/state`.

        Parameters
        ----------
        message : Message
            As it lies in the bag.
        decoded : sensor_msgs/JointState
            What it says.

        Yields
        ------
        tuple
            Messages to write.
        """
        stamp = decoded.header.stamp.sec, decoded.header.stamp.nanosec
        if self._begins is not None:
            yield from self._come(STATE, stamp)
            return
        self._come_to[STATE] = stamp
        values = dict(zip(decoded.name, decoded.position, strict=False))
        readings, age = values.get('readings', 0.0), values.get('age', math.nan)
        # Control periods wait for their contacts: this one may still be to come.
        stamps = [waiting[0] for waiting in self._waiting]
        place = stamps.index(stamp) if stamp in stamps else len(stamps)
        if readings > 1.0:
            del self._waiting[:place]
            self.kept += 1
            yield from self._keep_pose(None)
            yield STATE, message.data, message.log_time
            return
        self._begins = stamp
        made_again = readings == 1.0 and math.isfinite(age)
        yield from self._keep_pose(stamp_before(*stamp, age) if made_again else None)
        waiting, self._waiting = self._waiting, []
        self._before = waiting[place - 1] if place else None
        for one in waiting[place:]:
            yield from self.tick(*one)

    def pose(self, message: Message, decoded: Any) -> Iterator[Output]:
        """Take a recorded message of `object_pose`.

        Parameters
        ----------
        message : Message
            As it lies in the bag.
        decoded : geometry_msgs/PoseWithCovarianceStamped
            What it says.

        Yields
        ------
        tuple
            Messages to write.
        """
        stamp = decoded.header.stamp.sec, decoded.header.stamp.nanosec
        if self._begins is not None:
            yield from self._come(POSE, stamp)
            return
        self._come_to[POSE] = stamp
        yield from self._keep_pose(None)
        self._pose = stamp, message

    def finish(self) -> Iterator[Output]:
        """End with what the node came to.

        Yields
        ------
        tuple
            Messages to write.
        """
        yield from self._keep_pose(None)
        del self.sensed[len(self.sensed) - len(self._ahead[STATE]) :]

    def _give(self, stamp: Stamp, output: Output) -> Iterator[Output]:
        """Give what is made, or keep it until the node has come to it."""
        topic = output[0]
        if stamp <= self._come_to[topic]:
            yield output
        else:
            self._ahead[topic].append((stamp, output))

    def _come(self, topic: str, stamp: Stamp) -> Iterator[Output]:
        """Give what the node has come to."""
        self._come_to[topic] = stamp
        ahead = self._ahead[topic]
        said = [place for place, (of, _) in enumerate(ahead, 1) if of <= stamp]
        if said:
            yield from (output for _, output in ahead[: said[-1]])
            del ahead[: said[-1]]

    def _keep_pose(self, made_again: Stamp | None) -> Iterator[Output]:
        if self._pose is not None and self._pose[0] != made_again:
            yield POSE, self._pose[1].data, self._pose[1].log_time
        self._pose = None
