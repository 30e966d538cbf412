# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What `push_controller` did with a bag's contacts."""

import math
from collections import deque
from collections.abc import Collection, Iterator, Mapping
from dataclasses import replace
from functools import partial
from typing import Any, NamedTuple

from tactile_push.control import (
    ANOTHER_COMMAND,
    CLOCK_JUMPED,
    FINGER_UNKNOWN,
    HELD,
    INACTIVE,
    PUSHING,
    Steadying,
    Tick,
    plausible,
    tick_of,
)
from tactile_push.interface import PUSH
from tactile_push.parameters.push_controller import (
    PushControllerParameters,
    choose_law,
    make_control,
    make_finger,
    take_values,
)
from tactile_push.pipeline import Control, Stamp, by_name
from tactile_push.pipeline.stamps import seconds_since, stamp_of
from tactile_push.replay.messages import Replayed
from tactile_push.replay.placing import RecordedPlacing

# So much later than a tick the bag may have a contact that the tick used [ns]. The middleware sends
# a message again after 3 s that a busy recorder has lost, and simulated time, by which it records,
# passes twenty times as fast in the demonstration.
PATIENCE = 60 * 10**9
HALF_A_NANOSECOND = 0.5e-9  # two stamps differ by more [s]
REMEMBERED = 10_000  # contacts that no tick has used yet: ten seconds of the fastest sensor
LAW = ('kp', 'kd', 'theta_desired')  # what each tick tells of the law


class _Contact(NamedTuple):
    theta: float
    stamp: float
    log_time: int


class _Recorded(NamedTuple):
    """A tick as the node made it."""

    stamp: Stamp
    log_time: int
    tick: Tick
    law: Mapping[str, float]


class ReplayedController:
    """Makes the ticks of a bag again, on the contacts that they had.

    `push_controller/state` says when the node ticked, which contact and which position of the
    finger were the newest, and what happened otherwise: an activation, another node's command, a
    clock that was set, a resume. The rest follows. Overridden parameters do not follow the bag.
    With a law that believes, `place/state` says what else happened, if it was recorded.
    """

    def __init__(
        self,
        values: PushControllerParameters,
        overridden: Collection[str],
        epoch: int,
        places: bool = False,
    ) -> None:
        self._values = replace(values, steadying_max=0.0)  # each tick tells how it was trimmed
        self._overridden = overridden
        self._seconds = partial(seconds_since, epoch)
        self._push = make_control(self._values)
        self.step = Control(self._push, make_finger(values), values.joint_names, self._seconds)
        self.placing = RecordedPlacing(self._seconds) if places else None
        self._contacts: deque[_Contact] = deque(maxlen=REMEMBERED)
        self._newest = -math.inf
        self._waiting: deque[_Recorded] = deque()
        self._last: Tick | None = None  # of the replay
        self._before: _Recorded | None = None  # of the bag
        self._following = False

    def change(self, values: Mapping[str, Any]) -> None:
        """Take values of parameters that changed while the node ran."""
        self._values = replace(self._values, **{**values, 'steadying_max': 0.0})
        take_values(self._push, self._values)

    def feel(self, theta: float | None, stamp: Stamp, log_time: int) -> Iterator[Replayed]:
        """Take a reading, None without a contact, and yield the ticks that waited for it."""
        if theta is not None:
            at = self._seconds(*stamp)
            self._contacts.append(_Contact(theta, at, log_time))
            self._newest = max(self._newest, at)
            yield from self.go_on(log_time)

    def state(self, message: Any, log_time: int) -> Iterator[Replayed]:
        """Take a message of `push_controller/state` and yield the ticks that can be made."""
        values = by_name(message.name, message.position)
        law = {name: values[name] for name in LAW if name in values}
        self._waiting.append(_Recorded(stamp_of(message), log_time, tick_of(values), law))
        yield from self.go_on(log_time)

    def finish(self) -> Iterator[Replayed]:
        """Yield the ticks that still wait."""
        return self.go_on(math.inf)

    def go_on(self, log_time: float) -> Iterator[Replayed]:
        """Yield the ticks whose contacts are there, or waited for long enough."""
        while self._waiting:
            recorded = self._waiting[0]
            used = self._seconds(*recorded.stamp) - recorded.tick.silence
            felt = recorded.tick.state != INACTIVE and math.isfinite(recorded.tick.theta)
            complete = not felt or self._newest > used - HALF_A_NANOSECOND
            if self.placing is not None:
                last = recorded.tick.state == INACTIVE
                complete = complete and self.placing.complete(recorded.stamp, last)
            if not complete and log_time < recorded.log_time + PATIENCE:
                return
            self._waiting.popleft()
            made = self._make(recorded)
            self._last = made and self._as_recorded(made, recorded.tick)
            self._before = recorded
            yield Replayed(recorded.stamp, recorded.log_time, self._last, recorded.tick)
            if self.step.placing is not None:
                self.step.placing.look_ahead()

    def _as_recorded(self, tick: Tick, recorded: Tick) -> Tick:
        """Return a tick with the recorded psi, and the trim that the recorded theta_d has in it."""
        tick = replace(tick, psi=recorded.psi)  # where it was not recorded, nothing follows from it
        return tick if 'theta_desired' in self._overridden else replace(tick, trim=recorded.trim)

    def _make(self, recorded: _Recorded) -> Tick | None:
        """Make one tick; None as long as the node's memory is not known."""
        now = self._seconds(*recorded.stamp)
        law: dict[str, Any] = {k: v for k, v in recorded.law.items() if k not in self._overridden}
        self._values = replace(self._values, **law)
        take_values(self._push, self._values)
        before = self._before
        if not self._following or before is None:
            return self._begin(recorded, now)
        if recorded.tick.state == INACTIVE:
            self._feed_placing(recorded)
            return self.step.deactivate()
        if before.tick.state == INACTIVE or recorded.tick.ticks <= before.tick.ticks:
            self._following = self._activate(recorded, now)
            self._last = None
            if not self._following:
                return None
        self._feed_placing(recorded)
        self._feed(recorded, now)
        self._befall(recorded, now)
        return self.step.tick(recorded.stamp, recorded.tick.elapsed)

    def _begin(self, recorded: _Recorded, now: float) -> Tick | None:
        """Begin with an activation or, while the node pushes, with a contact that is in the bag."""
        tick, before = recorded.tick, self._before
        used = now - tick.silence
        known = math.isnan(tick.theta) or any(
            abs(contact.stamp - used) < HALF_A_NANOSECOND for contact in self._contacts
        )
        if tick.state == INACTIVE or not known:
            return None
        if tick.ticks == 1:
            self._following = self._activate(recorded, now)
            if not self._following:
                return None
            self._feed_placing(recorded)
            self._feed(recorded, now)
            return self.step.tick(recorded.stamp, tick.elapsed)
        if {self._law(recorded), self._values.law} != {PUSH}:
            return None  # the law's memory is not in the bag
        if before is None or not before.tick.state == tick.state == PUSHING:
            return None
        if used > self._seconds(*before.stamp) - before.tick.silence:
            self._following = True
            self._push.continue_from(tick, now)
            self._take_contacts(used, recorded.log_time)
        return None

    def _law(self, recorded: _Recorded) -> str:
        """Return which law acted in a control period."""
        law = None if self.placing is None else self.placing.law(recorded.stamp)
        return law or PUSH

    def _activate(self, recorded: _Recorded, now: float) -> bool:
        """Begin with the law that the node began with; return whether it can be followed."""
        law = self._law(recorded)
        if self._values.law != PUSH == law:  # nobody recorded what it was told
            return False
        choose_law(self.step, replace(self._values, law=law), self._seconds)
        self._push.steadying = Steadying()  # each tick tells how it was trimmed
        self._push.activate(now - _waited(recorded.tick))
        return True

    def _feed_placing(self, recorded: _Recorded) -> None:
        """Give a law that believes its goals and estimates."""
        if self.placing is not None and self._law(recorded) != PUSH:
            self.placing.feed(self.step, recorded.stamp)

    def _feed(self, recorded: _Recorded, now: float) -> None:
        """Give the law the contacts up to its newest one, and the position of the finger."""
        push, tick = self._push, recorded.tick
        newest = now - tick.silence if math.isfinite(tick.theta) else -math.inf
        for contact in self._take_contacts(newest, recorded.log_time):
            push.feel(contact.theta, contact.stamp)
        if tick.stop_reason == FINGER_UNKNOWN:
            push.expect_finger(-math.inf)
        age = tick.finger_age if math.isfinite(tick.finger_age) else 0.0
        push.locate_finger(tick.finger_x, now - age, tick.psi)

    def _take_contacts(self, newest: float, log_time: int) -> list[_Contact]:
        """Return the contacts that had arrived, and keep the others."""

        def had_arrived(contact: _Contact) -> bool:
            if plausible(contact.theta):
                return contact.stamp < newest + HALF_A_NANOSECOND
            return contact.log_time <= log_time  # all that a tick tells of these

        taken = [contact for contact in self._contacts if had_arrived(contact)]
        kept = [contact for contact in self._contacts if not had_arrived(contact)]
        self._contacts.clear()
        self._contacts.extend(kept)
        return taken

    def _befall(self, recorded: _Recorded, now: float) -> None:
        """Repeat what happened to the node besides contacts."""
        push, tick, last, before = self._push, recorded.tick, self._last, self._before
        if last is None or before is None:  # just activated
            return
        waited = last.silence + now - self._seconds(*before.stamp)
        forgot = math.isfinite(last.theta) or tick.silence < waited - HALF_A_NANOSECOND
        if math.isnan(tick.theta) and forgot:
            push.notice_clock_jump(now - tick.silence)
        elif tick.stop_reason == last.stop_reason:
            return
        elif last.stop_reason in HELD and tick.stop_reason not in HELD:
            push.resume()
        elif tick.stop_reason == ANOTHER_COMMAND:
            push.notice_another_command()
        elif tick.stop_reason == CLOCK_JUMPED:
            push.notice_clock_jump(now)


def _waited(tick: Tick) -> float:
    """Return how long before its first tick a controller was activated [s]."""
    return tick.silence if math.isnan(tick.theta) else 0.0
