# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""One finger's way from reading to command and estimate, over a bag's messages."""

from collections.abc import Callable, Collection, Iterable, Mapping
from dataclasses import replace
from functools import partial
from typing import Any

from tactile_push.bags import BagReader, Message
from tactile_push.control import Tick
from tactile_push.interface import (
    COMMAND,
    CONTACT,
    CONTACT_GEOMETRY,
    CONTROLLER_STATE,
    GEOMETRY_STATE,
    JOINT_STATES,
    OBJECT_POSE,
    PLACE_STATE,
    PUSH,
    PUSH_CONTROLLER,
    SENSING_STATE,
    TACTILE,
    TOPICS,
)
from tactile_push.parameters import (
    ActiveSensingParameters,
    ContactGeometryParameters,
    PushControllerParameters,
)
from tactile_push.parameters.active_sensing import make_sensing
from tactile_push.pipeline import Felt, Output, Stamp, edge_angle
from tactile_push.pipeline.orientation import quaternion_of_yaw
from tactile_push.pipeline.stamps import epoch_of, seconds_since, stamp_of
from tactile_push.replay.comparison import Comparison
from tactile_push.replay.controller import PATIENCE, ReplayedController
from tactile_push.replay.geometry import ReplayedGeometry
from tactile_push.replay.messages import Replayed, Written, nanoseconds, only
from tactile_push.replay.new_bag import NewBag
from tactile_push.replay.own_ticks import OwnTicks
from tactile_push.replay.parameters import FingerParameters
from tactile_push.replay.sensing import ReplayedSensing

FOREIGN = 2 * PATIENCE  # after which a recorded command belongs to no tick [ns]
REMEMBERED = 10_000  # control periods whose recorded command has not come; picked, far more

FOLLOWS_CHANGES = (ReplayedGeometry, ReplayedController)
GROWING = (CONTROLLER_STATE, SENSING_STATE)  # topics that had fewer fields in earlier versions

Handler = Callable[[Message], None]


class Finger:
    """Replays one finger.

    `handlers` take the messages of each topic that the replay needs, by its name without the
    namespace. What comes of them goes to `comparison` and, if that is set, to `new_bag`.
    """

    def __init__(
        self, namespace: str, topics: Collection[str], parameters: FingerParameters, bag: BagReader
    ) -> None:
        self._namespace = namespace
        self._parameters = parameters
        self._decode = bag.decode
        self._start, epoch = bag.start_time, epoch_of(bag.start_time // 10**9)
        self.comparison = Comparison(namespace.removeprefix('/'))
        self.comparison.without_effect = parameters.without_effect(topics)
        self.new_bag: NewBag | None = None
        self.handlers: dict[str, Handler] = {}
        self._felt: Stamp | None = None  # the last reading that was replayed
        # Before the first such reading, or about one that has not come yet.
        self._as_recorded: list[tuple[Stamp, Message]] = []
        self._commands: dict[Stamp, Message] = {}
        self._states: dict[Stamp, Message] = {}
        self._places: dict[Stamp, Message] = {}
        # Fields that the version that recorded had, by topic.
        self._known = {topic: frozenset(TOPICS[topic].field_names) for topic in GROWING}
        # Whether a control period has made its command again; a recorded one may come after it.
        self._made: dict[Stamp, bool] = {}

        self._controller = self._replay_controller(topics, epoch)
        self._geometry = self._replay_geometry(topics, epoch)
        self._sensing = self._replay_sensing(topics, epoch)

    def _replay_controller(
        self, topics: Collection[str], epoch: int
    ) -> ReplayedController | OwnTicks:
        values = PushControllerParameters.of(self._parameters.used[PUSH_CONTROLLER])
        recorded = PushControllerParameters.taken(self._parameters.recorded[PUSH_CONTROLLER])
        values = replace(values, law=recorded.get('law', PUSH))
        if CONTROLLER_STATE not in topics:
            return OwnTicks(values, epoch)
        places = {PLACE_STATE, SENSING_STATE} <= set(topics)
        wanted = self._parameters.wanted[PUSH_CONTROLLER]
        controller = ReplayedController(values, wanted, epoch, places)
        if PLACE_STATE in topics:
            self.handlers[PLACE_STATE] = partial(self._take_place_state, controller)
        if places:
            self.handlers[SENSING_STATE] = partial(self._take_estimate, controller, None)
        self.handlers[CONTROLLER_STATE] = partial(self._take_tick, controller)
        self.handlers[COMMAND] = self._take_command
        return controller

    def _replay_geometry(self, topics: Collection[str], epoch: int) -> ReplayedGeometry | None:
        if not {GEOMETRY_STATE, TACTILE} & set(topics):
            self.handlers[CONTACT] = self._take_contact
            return None
        values = ContactGeometryParameters.of(self._parameters.used[CONTACT_GEOMETRY])
        geometry = ReplayedGeometry(values, epoch)
        joints: list[Callable[..., object]] = []
        if GEOMETRY_STATE in topics:
            self.handlers[GEOMETRY_STATE] = partial(self._take_recorded_reading, geometry)
        else:
            self.handlers[TACTILE] = partial(self._take_reading, geometry)
            joints.append(geometry.step.joint_states)
        if isinstance(self._controller, OwnTicks) and self._controller.uses_joint_states:
            joints.append(self._controller.step.joint_states)
        if joints:
            self.handlers[JOINT_STATES] = partial(self._take_joint_states, joints)
        self.handlers[CONTACT] = self._keep_contact
        return geometry

    def _replay_sensing(self, topics: Collection[str], epoch: int) -> ReplayedSensing | None:
        if not self._parameters.senses:
            return None
        from tactile_push.pipeline import Sensing  # which loads the compiler

        values = ActiveSensingParameters.of(self._parameters.sensing)
        step = Sensing(make_sensing(values), partial(seconds_since, epoch))
        recorded = topics if CONTROLLER_STATE in topics else ()
        sensing = ReplayedSensing(step, recorded, self._start)
        self.comparison.sensed = sensing.sensed
        self.handlers[SENSING_STATE] = partial(self._take_estimate, self._controller, sensing.state)
        self.handlers[OBJECT_POSE] = partial(self._take_sensed, sensing.pose)
        return sensing

    def change(self, node: str, values: Mapping[str, Any]) -> None:
        """Take changed values of a node, by its full name, that nobody wants otherwise."""
        for own, taker, kind in (
            (CONTACT_GEOMETRY, self._geometry, ContactGeometryParameters),
            (PUSH_CONTROLLER, self._controller, PushControllerParameters),
        ):
            if node == f'{self._namespace}/{own}' and isinstance(taker, FOLLOWS_CHANGES):
                wanted = self._parameters.wanted[own]
                taker.change({k: v for k, v in kind.taken(values).items() if k not in wanted})

    def finish(self) -> None:
        """Make the ticks that still wait, and write what is left as it was recorded."""
        for _, message in self._as_recorded:
            if message.topic == f'{self._namespace}/{CONTACT}':  # which a tick may have used
                self._take_contact(message)
            else:
                self._write([message])
        self._conclude(self._controller.finish())
        self._keep_commands(None)
        self._write(self._places.values())
        if self._sensing is not None:
            self._write(self._sensing.finish())

    def _take_reading(self, geometry: ReplayedGeometry, message: Message) -> None:
        self._feel(geometry.tactile(self._decode(message)), message.log_time)

    def _take_recorded_reading(self, geometry: ReplayedGeometry, message: Message) -> None:
        decoded = self._decode(message)
        self._keep(stamp_of(decoded), message)
        felt = geometry.state(decoded)
        if felt is not None:
            self._feel(felt, message.log_time)

    def _take_joint_states(self, takers: Iterable[Callable[..., object]], message: Message) -> None:
        decoded = self._decode(message)
        for take in takers:
            take(stamp_of(decoded), decoded.name, decoded.position)

    def _take_contact(self, message: Message) -> None:
        """Take a recorded contact as it is: there are no readings."""
        decoded = self._decode(message)
        turn = decoded.pose.orientation
        theta = edge_angle(decoded.header.frame_id, turn.x, turn.y, turn.z, turn.w)
        self._write([message])
        self.comparison.contacts += 1
        self._conclude(self._controller.feel(theta, stamp_of(decoded), message.log_time))

    def _take_tick(self, controller: ReplayedController, message: Message) -> None:
        decoded = self._decode(message)
        self._states[stamp_of(decoded)] = message
        self._known[CONTROLLER_STATE] = frozenset(decoded.name)
        self._conclude(controller.state(decoded, message.log_time))

    def _take_command(self, message: Message) -> None:
        stamp = stamp_of(self._decode(message))
        made = self._made.pop(stamp, None)
        if made is None:
            self._commands[stamp] = message
        elif not made:
            self._write([message])
        self._keep_commands(message.log_time - FOREIGN)

    def _take_place_state(self, controller: ReplayedController, message: Message) -> None:
        decoded = self._decode(message)
        self._places[stamp_of(decoded)] = message
        if controller.placing is not None:
            controller.placing.state(decoded)
            self._conclude(controller.go_on(message.log_time))

    def _take_estimate(
        self,
        controller: ReplayedController | OwnTicks,
        take: Callable[[Message, Any], Iterable[Written]] | None,
        message: Message,
    ) -> None:
        """Take what active sensing said: the law may have used it, and it may be made again."""
        decoded = self._decode(message)
        self._known[SENSING_STATE] = frozenset(decoded.name)
        if take is not None:
            self._write(take(message, decoded))
        if isinstance(controller, ReplayedController) and controller.placing is not None:
            controller.placing.estimate(decoded)
            self._conclude(controller.go_on(message.log_time))

    def _take_sensed(
        self, take: Callable[[Message, Any], Iterable[Written]], message: Message
    ) -> None:
        self._write(take(message, self._decode(message)))

    def _feel(self, felt: Felt, log_time: int) -> None:
        """Pass on what came of a reading."""
        if self._felt is None:
            self._write(message for stamp, message in self._as_recorded if stamp < felt.stamp)
        self._felt = felt.stamp
        self._as_recorded = [kept for kept in self._as_recorded if kept[0] > felt.stamp]
        self.comparison.count(felt)
        self._write_outputs(felt.outputs(), log_time)
        theta = None
        if felt.contact is not None:  # the controller gets it as a message
            theta = edge_angle('', 0.0, 0.0, *quaternion_of_yaw(felt.contact.theta))
        self._conclude(self._controller.feel(theta, felt.stamp, log_time))

    def _conclude(self, ticks: Iterable[Replayed]) -> None:
        """Pass on the ticks that were made, and keep recorded ones that cannot be."""
        for stamp, log_time, tick, recorded in ticks:
            state, command = self._states.pop(stamp, None), self._commands.pop(stamp, None)
            place = self._places.pop(stamp, None)
            if command is None:
                self._made[stamp] = tick is not None and tick.v_x is not None
                if len(self._made) > REMEMBERED:
                    del self._made[next(iter(self._made))]
            if tick is None:
                self.comparison.keep(nanoseconds(stamp))
                self._write(m for m in (place, command, state) if m is not None)
                self._sense(stamp, log_time, recorded)
            else:
                self._write_outputs(self._controller.step.outputs(stamp, tick), log_time)
                since = (nanoseconds(stamp) - self._start) * 1e-9
                self.comparison.add(since, tick, recorded)
                self._sense(stamp, log_time, tick)

    def _sense(self, stamp: Stamp, log_time: int, tick: Tick | None) -> None:
        if self._sensing is not None and tick is not None:
            self._write(self._sensing.tick(stamp, log_time, tick))

    def _keep_contact(self, message: Message) -> None:
        self._keep(stamp_of(self._decode(message)), message)

    def _keep(self, stamp: Stamp, message: Message) -> None:
        """Keep what was recorded until the reading is replayed that it is about.

        The recorder may have heard of a contact and not of its reading, at the end of the recording
        as well as at its beginning.
        """
        if self._felt is None or stamp > self._felt:
            self._as_recorded.append((stamp, message))

    def _keep_commands(self, until: int | None) -> None:
        """Write commands of another node, which belong to no tick, up to a log time [ns]."""
        for stamp, message in list(self._commands.items()):
            if until is not None and message.log_time >= until:
                break
            self._write([message])
            del self._commands[stamp]

    def _write_outputs(self, outputs: Iterable[Output], log_time: int) -> None:
        if self.new_bag is not None:
            self._write((output, log_time) for output in outputs)

    def _write(self, messages: Iterable[Written]) -> None:
        for message in messages:
            if self.new_bag is None:
                continue  # what makes the messages goes on all the same
            if isinstance(message, Message):
                self.new_bag.copy(message)
            else:
                (topic, fields), log_time = message
                if topic in GROWING:
                    fields = only(self._known[topic], fields)
                self.new_bag.write(f'{self._namespace}/{topic}', fields, log_time)
