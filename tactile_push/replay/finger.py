# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""One finger's way from reading to command and estimate, over a bag's messages."""

import math
from collections.abc import Callable, Iterable, Mapping, Set
from typing import Any

from tactile_push.bags import Message
from tactile_push.control import Tick, tick_values
from tactile_push.parameters import ContactGeometryParameters, PushControllerParameters
from tactile_push.pipeline.cdr import encode_joint_state, encode_pose, encode_twist
from tactile_push.pipeline.orientation import quaternion_of_yaw, yaw_of_quaternion
from tactile_push.replay.comparison import Comparison
from tactile_push.replay.controller import Controller, Replayed
from tactile_push.replay.geometry import Felt, Geometry, Stamp
from tactile_push.replay.own_ticks import OwnTicks
from tactile_push.replay.sensing import POSE, TOPICS, Output, Sensing, SensingAgain
from tactile_push.tactile import reading_values

INPUTS = {
    'tactile': 'sensor_msgs/msg/JointState',
    'joint_states': 'sensor_msgs/msg/JointState',
    'contact': 'geometry_msgs/msg/PoseStamped',
    'contact_geometry/state': 'sensor_msgs/msg/JointState',
    'push_controller/state': 'sensor_msgs/msg/JointState',
    'finger/cmd_vel': 'geometry_msgs/msg/TwistStamped',
    **TOPICS,
}
OUTPUTS = (
    'contact',
    'contact_geometry/state',
    'push_controller/state',
    'finger/cmd_vel',
    *TOPICS,
)
DISK, BASE = 'finger_disk', 'finger_base'  # frames of contacts and commands
PATIENCE = 2 * 10**9  # after which a recorded command belongs to no tick [ns]
REMEMBERED = 1000  # control periods whose recorded command has not come

Write = Callable[[str, bytes, int], None]


class Finger:
    """Replays one finger.

    Parameters
    ----------
    namespace : str
        Its namespace with a slash at either end, '/' for the root.
    recorded : set of str
        Its topics in the bag, without the namespace.
    given : mapping of str to mapping
        Parameters of its nodes that are not the default, by node. Without `active_sensing` the
        object is not sensed.
    overridden : set of str
        Parameters of `push_controller` that do not follow the bag.
    begin : tuple of int
        First log time of the bag [ns], and the epoch from which times count [s].
    decode : callable
        Gives a message's content.

    Attributes
    ----------
    comparison : Comparison
        How the commands compare.
    write : callable
        Takes a topic without the namespace, a message in CDR and its log time [ns]; does nothing
        unless it is set.
    """

    def __init__(
        self,
        namespace: str,
        recorded: Set[str],
        given: Mapping[str, Mapping[str, Any]],
        overridden: set[str],
        begin: tuple[int, int],
        decode: Callable[[Message], Any],
    ) -> None:
        self._start, epoch = begin
        self._decode = decode
        self.write: Write = _nowhere
        self._geometry = None
        if recorded & {'tactile', 'contact_geometry/state'}:
            as_recorded = 'contact_geometry/state' in recorded
            self._geometry = Geometry(given['contact_geometry'], epoch, as_recorded)
        self._controller: Controller | OwnTicks
        if 'push_controller/state' in recorded:
            self._controller = Controller(given['push_controller'], overridden, epoch)
        else:
            self._controller = OwnTicks(given['push_controller'], epoch)
        self._sensing: SensingAgain | None = None
        self.comparison = Comparison(namespace.strip('/'))
        if 'active_sensing' in given:
            alike = recorded if 'push_controller/state' in recorded else set()
            sensing = Sensing(given['active_sensing'], epoch)
            self._sensing = SensingAgain(sensing, alike, self._start)
            self.comparison.sensed = self._sensing.sensed
        self._first: Stamp | None = None  # reading that is replayed
        self._as_recorded: list[tuple[str, Stamp, Message]] = []  # of before, or to be replaced
        self._commands: dict[Stamp, Message] = {}
        self._states: dict[Stamp, Message] = {}
        # Whether a control period has made its command again; a recorded one may come after it.
        self._made: dict[Stamp, bool] = {}

    def take(self, topic: str, message: Message) -> None:
        """Take a message of the bag.

        Parameters
        ----------
        topic : str
            Its topic, without the namespace.
        message : Message
            The message as it lies in the bag.
        """
        at = message.log_time
        geometry, controller = self._geometry, self._controller
        if topic == 'tactile' and geometry is not None and not geometry.as_recorded:
            self._feel(geometry.tactile(self._decode(message)), at)
        elif topic == 'contact_geometry/state' and geometry is not None:
            decoded = self._decode(message)
            self._keep(topic, message, decoded)
            felt = geometry.state(decoded)
            if felt is not None:
                self._feel(felt, at)
        elif topic == 'contact' and geometry is None:
            self._take_contact(message, self._decode(message))
        elif topic == 'contact' and self._first is None:
            self._keep(topic, message, self._decode(message))
        elif topic == 'joint_states':
            self._take_joint_states(message)
        elif topic == 'push_controller/state' and isinstance(controller, Controller):
            decoded = self._decode(message)
            self._states[_stamp(decoded)] = message
            self._conclude(controller.state(decoded, at))
        elif topic == 'finger/cmd_vel' and isinstance(controller, Controller):
            self._take_command(message)
        elif topic in TOPICS:
            self._take_sensed(topic, message)

    def change(self, node: str, values: Mapping[str, Any]) -> None:
        """Take parameters that changed.

        Parameters
        ----------
        node : str
            The node, without the namespace.
        values : mapping of str to object
            Its new values by name.
        """
        if node == 'contact_geometry' and self._geometry is not None:
            known = {parameter.name for parameter in ContactGeometryParameters.declared()}
            self._geometry.change({k: v for k, v in values.items() if k in known})
        elif node == 'push_controller' and isinstance(self._controller, Controller):
            known = {parameter.name for parameter in PushControllerParameters.declared()}
            self._controller.change({k: v for k, v in values.items() if k in known})

    def finish(self) -> None:
        """Make the ticks that still wait, and write what is left as it was recorded."""
        if isinstance(self._controller, Controller):
            self._conclude(self._controller.go_on(math.inf))
        self._keep_commands(math.inf)
        if self._sensing is not None:
            self._write(self._sensing.finish())
        if self._first is None:
            self._write_as_recorded(lambda stamp: True)

    def _take_command(self, message: Message) -> None:
        stamp = _stamp(self._decode(message))
        made = self._made.pop(stamp, None)
        if made is None:
            self._commands[stamp] = message
        elif not made:
            self.write('finger/cmd_vel', message.data, message.log_time)
        self._keep_commands(message.log_time - PATIENCE)

    def _take_joint_states(self, message: Message) -> None:
        own = isinstance(self._controller, OwnTicks)
        if self._geometry is not None and (own or not self._geometry.as_recorded):
            decoded = self._decode(message)
            self._geometry.joint_states(decoded)
            if isinstance(self._controller, OwnTicks):
                self._controller.joint_states(decoded)

    def _take_contact(self, message: Message, decoded: Any) -> None:
        """Take a recorded contact for what it is: there are no readings."""
        self.write('contact', message.data, message.log_time)
        rotation = decoded.pose.orientation
        theta = yaw_of_quaternion(rotation.x, rotation.y, rotation.z, rotation.w)
        self.comparison.contacts += 1
        self._give(theta, _stamp(decoded), message.log_time)

    def _feel(self, felt: Felt, log_time: int) -> None:
        self._begin_with(felt.stamp)
        self._tell(felt, log_time)
        theta = None
        if felt.contact is not None:
            turn = (0.0, 0.0, *quaternion_of_yaw(felt.contact.theta))
            place = (felt.contact.x, felt.contact.y, 0.0)
            self.write('contact', encode_pose(felt.stamp, DISK, place, turn), log_time)
            theta = yaw_of_quaternion(*turn)  # which is what the controller gets
        self._give(theta, felt.stamp, log_time)

    def _tell(self, felt: Felt, log_time: int) -> None:
        comparison = self.comparison
        comparison.readings += 1
        comparison.contacts += felt.contact is not None
        if felt.refusal:
            comparison.refused[felt.refusal] = comparison.refused.get(felt.refusal, 0) + 1
        theta = math.nan if felt.contact is None else felt.contact.theta
        values = reading_values(felt.reading, felt.joint_angle, theta, felt.refusal)
        self.write('contact_geometry/state', encode_joint_state(felt.stamp, values), log_time)

    def _give(self, theta: float | None, stamp: Stamp, log_time: int) -> None:
        if isinstance(self._controller, OwnTicks):
            self._conclude(self._controller.reading(theta, stamp, log_time))
        elif theta is not None:
            self._conclude(self._controller.contact(theta, stamp, log_time))

    def _conclude(self, ticks: Iterable[Replayed]) -> None:
        for stamp, log_time, tick, recorded in ticks:
            state, command = self._states.pop(stamp, None), self._commands.pop(stamp, None)
            if command is None:
                self._made[stamp] = tick is not None and tick.v_x is not None
                if len(self._made) > REMEMBERED:
                    del self._made[next(iter(self._made))]
            if tick is None:
                self.comparison.keep(stamp[0] * 10**9 + stamp[1])
                for topic, message in (
                    ('finger/cmd_vel', command),
                    ('push_controller/state', state),
                ):
                    if message is not None:
                        self.write(topic, message.data, message.log_time)
                self._sense(stamp, log_time, recorded)
                continue
            if tick.v_x is not None:
                self.write('finger/cmd_vel', encode_twist(stamp, BASE, tick.v_x), log_time)
            values = tick_values(tick, self._controller.law)
            self.write('push_controller/state', encode_joint_state(stamp, values), log_time)
            since = (stamp[0] * 10**9 + stamp[1] - self._start) * 1e-9
            self.comparison.add(since, tick, recorded)
            self._sense(stamp, log_time, tick)

    def _sense(self, stamp: Stamp, log_time: int, tick: Tick | None) -> None:
        if self._sensing is not None and tick is not None:
            self._write(self._sensing.tick(stamp, log_time, tick))

    def _take_sensed(self, topic: str, message: Message) -> None:
        """Take what was recorded of the object, and keep it if it is not made again."""
        if self._sensing is None:
            self.write(topic, message.data, message.log_time)
        elif topic == POSE:
            self._write(self._sensing.pose(message, self._decode(message)))
        else:
            self._write(self._sensing.state(message, self._decode(message)))

    def _write(self, outputs: Iterable[Output]) -> None:
        for output in outputs:
            self.write(*output)

    def _keep(self, topic: str, message: Message, decoded: Any) -> None:
        """Keep what was recorded before the first reading that is replayed."""
        if self._first is None:
            self._as_recorded.append((topic, _stamp(decoded), message))

    def _begin_with(self, stamp: Stamp) -> None:
        if self._first is None:
            self._first = stamp
            self._write_as_recorded(lambda other: other < stamp)

    def _write_as_recorded(self, wanted: Callable[[Stamp], bool]) -> None:
        for topic, stamp, message in self._as_recorded:
            if wanted(stamp):
                self.write(topic, message.data, message.log_time)
        self._as_recorded.clear()

    def _keep_commands(self, until: float) -> None:
        """Write commands that belong to no tick: somebody else's."""
        for stamp, message in list(self._commands.items()):
            if message.log_time >= until:
                break
            self.write('finger/cmd_vel', message.data, message.log_time)
            del self._commands[stamp]


def _nowhere(topic: str, data: bytes, log_time: int) -> None:
    """Write nothing."""


def _stamp(message: Any) -> Stamp:
    return message.header.stamp.sec, message.header.stamp.nanosec
