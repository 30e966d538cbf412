# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Publish a bag with its timing."""

import sys
from collections import Counter

from rclpy.clock import Clock
from rclpy.clock_type import ClockType
from rclpy.expand_topic_name import expand_topic_name
from rclpy.node import Node
from rclpy.validate_full_topic_name import validate_full_topic_name
from std_srvs.srv import SetBool, Trigger

from tactile_push.bags import BagError, BagReader
from tactile_push.interface import BAG_PLAYER, CLOCK, PAUSE, STEP
from tactile_push.nodes.ros.diagnostics import OK, WARN, Diagnostics, Health
from tactile_push.nodes.ros.parameters import ConfigurationError, declare
from tactile_push.nodes.ros.process import run
from tactile_push.parameters import BagPlayerParameters
from tactile_push.playing.player import Player
from tactile_push.playing.schedule import Part, part_of, topic_in_bag
from tactile_push.playing.terminal import Terminal
from tactile_push.streams import complain

TERMINAL_PERIOD = 0.05  # between looks at the keyboard [s]; a person does not notice less
PAUSE_KEYS, STEP_KEYS = (' ',), ('s', '\x1b[C', '\x1bOC')  # the last two are the right arrow
SWITCH_INTERVAL = 1e-4  # between threads that want to run [s]; Python's 5e-3 makes messages late


class BagPlayer(Node):
    """Node: publishes the messages of a bag when they are due, and ends with the bag."""

    NAME = BAG_PLAYER

    def __init__(self) -> None:
        super().__init__(self.NAME)
        self._settings = p = declare(self, BagPlayerParameters)
        if not p.bag:
            raise ConfigurationError("parameter bag: expected the folder of a bag, got ''")
        try:
            bag = BagReader(p.bag, self.get_logger().warning)
            part = part_of(
                bag, p.topics, p.start, p.duration, with_clock=p.clock > 0.0, loop=p.loop
            )
            self._player = Player(
                self,
                part,
                self._on_finished,
                rate=p.rate,
                loop=p.loop,
                clock_rate=p.clock,
                paused=p.start_paused,
                names=self._new_names(part),
            )
        except BagError as error:
            raise ConfigurationError(str(error)) from None
        self._end = (part.end - bag.start_time) * 1e-9
        self.create_service(SetBool, PAUSE, self._on_pause)
        self.create_service(Trigger, STEP, self._on_step)
        self._diagnostics = Diagnostics(self, self._health, self._counts)
        self._terminal = Terminal(self._hold, self._release)
        if self._terminal.there:
            steady_clock = Clock(clock_type=ClockType.STEADY_TIME)
            self.create_timer(TERMINAL_PERIOD, self._serve_terminal, clock=steady_clock)

    def destroy_node(self) -> None:
        """Stop playing, leave the terminal as it was and end."""
        self._player.stop()
        self._terminal.close()
        super().destroy_node()

    def _new_names(self, part: Part) -> dict[str, str]:
        names = {topic: topic for topic in part.topics}
        for word in self._settings.remap:
            old, sign, new = word.partition(':=')
            if not (old and sign and new):
                raise ConfigurationError(f'parameter remap: expected OLD:=NEW, got {word!r}')
            topic = topic_in_bag(part.bag, old)
            if topic not in names:
                raise ConfigurationError(
                    f'parameter remap: expected a topic that is played, got {topic}'
                )
            try:
                names[topic] = expand_topic_name(new, self.get_name(), self.get_namespace())
                validate_full_topic_name(names[topic])
            except ValueError:
                raise ConfigurationError(
                    f'parameter remap: expected the name of a topic, got {new!r}'
                ) from None
        taken = Counter(names.values())
        if self._settings.clock > 0.0:
            taken[CLOCK] += 1
        name, count = taken.most_common(1)[0]
        if count > 1:
            raise ConfigurationError(
                f'parameter remap: expected different names, got {name} for {count} topics'
            )
        return names

    def _on_pause(self, request: SetBool.Request, response: SetBool.Response) -> SetBool.Response:
        self._player.pause(request.data)
        response.success = True
        response.message = self._words()
        return response

    def _on_step(self, request: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        message = self._player.step()
        response.success = message is not None
        response.message = self._words() if message is None else message.topic
        return response

    def _on_finished(self) -> None:
        error = self._player.error
        if error is None:
            self.context.shutdown()
        elif isinstance(error, BagError):
            self._terminal.close()
            complain(self.NAME, error)
            sys.exit(1)
        else:
            raise error

    def _serve_terminal(self) -> None:
        for key in self._terminal.read_keys():
            if key in PAUSE_KEYS:
                self._player.pause(not self._player.paused)
            elif key in STEP_KEYS:
                self._player.step()
        self._terminal.show(f'{self._words()}; space pauses and goes on, s steps')

    def _hold(self) -> None:
        self._was_paused = self._player.paused
        self._player.pause(True)

    def _release(self) -> None:
        self._player.pause(self._was_paused)

    def _words(self) -> str:
        return f'{self._state()}, {self._player.position:.1f} s of {self._end:.1f} s'

    def _state(self) -> str:
        if self._player.waiting:
            return 'waiting for subscribers'
        return 'paused' if self._player.paused else 'playing'

    def _counts(self) -> dict[str, int]:
        return {'messages': self._player.published, 'late': self._player.late}

    def _health(self) -> Health:
        values = {
            'bag': self._settings.bag,
            'position [s]': f'{self._player.position:.3f}',
            'rate [s/s]': self._settings.rate,
        }
        if self._player.waiting:
            return Health(WARN, self._state(), values)
        if self._diagnostics.rates['late']:
            return Health(WARN, f'{self._state()}, some late', values)
        return Health(OK, self._state(), values)


def main() -> int:
    """Run the node as a process."""
    # The playing thread must get its turn when a message is due.
    sys.setswitchinterval(SWITCH_INTERVAL)
    return run(BagPlayer)


if __name__ == '__main__':
    sys.exit(main())
