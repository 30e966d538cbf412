# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What `push_controller` does, over a bag's messages."""

import math
from collections import deque
from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any, NamedTuple

from tactile_push.control import (
    ANOTHER_COMMAND,
    CLOCK_JUMPED,
    HELD,
    INACTIVE,
    PUSHING,
    PushLaw,
    Tick,
    plausible,
    tick_of,
)
from tactile_push.parameters.push_controller import (
    PushControllerParameters,
    make_control,
    take_values,
)
from tactile_push.pipeline.stamps import seconds_since
from tactile_push.replay.geometry import Stamp

PATIENCE = 10**9  # so much later in the bag a contact may come that a tick has used [ns]
HALF_A_NANOSECOND = 0.5e-9  # stamps differ by more [s]
REMEMBERED = 10_000  # contacts that no tick has used yet
LAW = ('kp', 'kd', 'theta_desired')  # what each tick tells of the law


class _Contact(NamedTuple):
    theta: float
    stamp: float
    log_time: int


class Recorded(NamedTuple):
    """A tick as the node made it."""

    stamp: Stamp
    log_time: int
    tick: Tick
    law: Mapping[str, float]


class Replayed(NamedTuple):
    """A tick as it comes out now, None where that is not known, beside the recorded one."""

    stamp: Stamp
    log_time: int
    tick: Tick | None
    recorded: Tick | None


class Controller:
    """Makes the ticks of a bag again, on the contacts that they had.

    `push_controller/state` says when the node ticked, which contact and which position of the
    finger were its newest, and what befell it otherwise: activation, another's command, a clock
    that was set, a resume. The rest follows.

    Parameters
    ----------
    given : mapping of str to object
        Values of the node's parameters that are not the default.
    overridden : set of str
        Parameters that do not follow the bag.
    epoch : int
        From when on times count [s].

    Attributes
    ----------
    law : PushLaw
        The law of the last tick.

    Raises
    ------
    ValueError
        If a value is refused.
    """

    def __init__(self, given: Mapping[str, Any], overridden: set[str], epoch: int) -> None:
        self._values = PushControllerParameters.of(given)
        self._control = make_control(self._values)
        self._overridden = overridden
        self._epoch = epoch
        self._contacts: deque[_Contact] = deque(maxlen=REMEMBERED)
        self._newest = -math.inf
        self._waiting: deque[Recorded] = deque()
        self._last: Tick | None = None  # of the replay
        self._before: Recorded | None = None  # of the bag
        self._following = False

    @property
    def law(self) -> PushLaw:
        """The law, with the gains of the last tick."""
        return self._control.law

    def change(self, given: Mapping[str, Any]) -> None:
        """Take values of parameters that changed while the node ran.

        Parameters
        ----------
        given : mapping of str to object
            The values by name.
        """
        self._values = replace(self._values, **given)
        take_values(self._control, self._values)

    def contact(self, theta: float, stamp: Stamp, log_time: int) -> Iterator[Replayed]:
        """Take a contact.

        Parameters
        ----------
        theta : float
            Angle of the pushed edge [rad].
        stamp : tuple of int
            When the sensor was read [s, ns].
        log_time : int
            When that was recorded [ns].

        Yields
        ------
        Replayed
            Ticks that had waited for it.
        """
        at = seconds_since(self._epoch, *stamp)
        self._contacts.append(_Contact(theta, at, log_time))
        self._newest = max(self._newest, at)
        yield from self.go_on(log_time)

    def state(self, message: Any, log_time: int) -> Iterator[Replayed]:
        """Take a message of `push_controller/state`.

        Parameters
        ----------
        message : sensor_msgs/JointState
            The message.
        log_time : int
            When it was recorded [ns].

        Yields
        ------
        Replayed
            Ticks whose contacts are there.
        """
        stamp = (message.header.stamp.sec, message.header.stamp.nanosec)
        values = dict(zip(message.name, message.position, strict=False))
        law = {name: values[name] for name in LAW}
        self._waiting.append(Recorded(stamp, log_time, tick_of(values), law))
        yield from self.go_on(log_time)

    def go_on(self, log_time: float) -> Iterator[Replayed]:
        """Make the ticks that need to wait no longer.

        Parameters
        ----------
        log_time : float
            How far in the bag everything has been read [ns].

        Yields
        ------
        Replayed
            The ticks.
        """
        while self._waiting:
            recorded = self._waiting[0]
            used = seconds_since(self._epoch, *recorded.stamp) - recorded.tick.silence
            felt = recorded.tick.state != INACTIVE and math.isfinite(recorded.tick.theta)
            complete = not felt or self._newest > used - HALF_A_NANOSECOND
            if not complete and log_time < recorded.log_time + PATIENCE:
                return
            self._waiting.popleft()
            self._last = self._make(recorded)
            self._before = recorded
            yield Replayed(recorded.stamp, recorded.log_time, self._last, recorded.tick)

    def _make(self, recorded: Recorded) -> Tick | None:
        """Make one tick; None as long as it is not known what the node remembers."""
        now = seconds_since(self._epoch, *recorded.stamp)
        law: dict[str, Any] = {k: v for k, v in recorded.law.items() if k not in self._overridden}
        self._values = replace(self._values, **law)
        take_values(self._control, self._values)
        before = self._before
        if not self._following or before is None:
            return self._begin(recorded, now)
        if recorded.tick.state == INACTIVE:
            return self._control.deactivate()
        if before.tick.state == INACTIVE or recorded.tick.ticks <= before.tick.ticks:
            self._control.activate(now - _waited(recorded.tick))
            self._last = None
        self._feed(recorded, now)
        self._befall(recorded, now)
        return self._control.tick(now, recorded.tick.elapsed)

    def _begin(self, recorded: Recorded, now: float) -> Tick | None:
        """Begin with an activation, or in the middle of pushing."""
        tick, before = recorded.tick, self._before
        used = now - tick.silence
        known = math.isnan(tick.theta) or any(
            abs(contact.stamp - used) < HALF_A_NANOSECOND for contact in self._contacts
        )
        if tick.state == INACTIVE or not known:
            return None
        if tick.ticks == 1:
            self._following = True
            self._control.activate(now - _waited(tick))
            self._feed(recorded, now)
            return self._control.tick(now, tick.elapsed)
        if before is None or not before.tick.state == tick.state == PUSHING:
            return None
        if used > seconds_since(self._epoch, *before.stamp) - before.tick.silence:
            self._following = True
            self._control.continue_from(tick, now)
            self._take_contacts(used, recorded.log_time)
        return None

    def _feed(self, recorded: Recorded, now: float) -> None:
        """Let the law feel what had arrived: up to its newest contact, and finger position."""
        control, tick = self._control, recorded.tick
        newest = now - tick.silence if math.isfinite(tick.theta) else -math.inf
        for contact in self._take_contacts(newest, recorded.log_time):
            control.feel(contact.theta, contact.stamp)
        age = tick.finger_age if math.isfinite(tick.finger_age) else 0.0
        control.locate_finger(tick.finger_x, now - age)

    def _take_contacts(self, newest: float, log_time: int) -> list[_Contact]:
        """Give the contacts that had arrived, and keep the others."""

        def had_arrived(contact: _Contact) -> bool:
            if plausible(contact.theta):
                return contact.stamp < newest + HALF_A_NANOSECOND
            return contact.log_time <= log_time  # a tick does not tell more of these

        taken = [contact for contact in self._contacts if had_arrived(contact)]
        kept = [contact for contact in self._contacts if not had_arrived(contact)]
        self._contacts.clear()
        self._contacts.extend(kept)
        return taken

    def _befall(self, recorded: Recorded, now: float) -> None:
        """Let happen what is no reading's doing."""
        control, tick, last, before = self._control, recorded.tick, self._last, self._before
        if last is None or before is None:  # just activated
            return
        waited = last.silence + now - seconds_since(self._epoch, *before.stamp)
        forgot = math.isfinite(last.theta) or tick.silence < waited - HALF_A_NANOSECOND
        if math.isnan(tick.theta) and forgot:
            control.notice_clock_jump(now - tick.silence)
        elif tick.stop_reason == last.stop_reason:
            return
        elif last.stop_reason in HELD and tick.stop_reason not in HELD:
            control.resume()
        elif tick.stop_reason == ANOTHER_COMMAND:
            control.notice_another_command()
        elif tick.stop_reason == CLOCK_JUMPED:
            control.notice_clock_jump(now)


def _waited(tick: Tick) -> float:
    """Give how long before its first tick a controller was activated [s]."""
    return tick.silence if math.isnan(tick.theta) else 0.0
