# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""When the law may act on what was felt, and when the finger has to stop."""

import math

from tactile_push.control.law import PushLaw, finger_velocity, motion_angle
from tactile_push.control.limits import Limits, plausible
from tactile_push.control.newest import Newest
from tactile_push.control.states import (
    ANOTHER_COMMAND,
    CLOCK_JUMPED,
    CONTACT_SILENT,
    FINGER_UNKNOWN,
    HELD,
    IMPLAUSIBLE_CONTACT,
    INACTIVE,
    NO_REASON,
    PUSHING,
    STOPPED,
    TICKS_LOST,
    WAITING,
    WORKSPACE_LIMIT,
)
from tactile_push.control.steadying import Steadying
from tactile_push.control.steering import Steering
from tactile_push.control.tick_state import Tick


class PushControl:
    """Runs the law on fresh contacts, within bounds, and stops the finger when it must.

    A contact that was used once is not used again: without a new one the push goes on as it was,
    and after `contact_timeout` the finger stops. Whatever stopped it, the law starts over from
    straight ahead, the push angle of the resting finger: it resumes without a kick. It does so on
    its own when the cause is seen to be gone, and after `resume` or `activate` when the cause is
    one of `HELD`.

    Parameters
    ----------
    law : PushLaw
        The control law.
    belt_speed : float
        Speed of the belt, v_y [m/s].
    period : float
        Control period [s].
    limits : Limits, optional
        When to stop and how fast to go at the most; may be changed at any time.
    steadying : Steadying or Steering, optional
        What trims theta_d; nothing by default; may be changed at any time.

    Attributes
    ----------
    state : str
        One of `STATES`.
    """

    def __init__(
        self,
        law: PushLaw,
        belt_speed: float,
        period: float,
        limits: Limits | None = None,
        steadying: Steadying | Steering | None = None,
    ) -> None:
        self.law = law
        self.belt_speed = belt_speed
        self.period = period
        self.limits = limits or Limits()
        self.steadying = steadying or Steadying()
        self._finger_due = math.inf  # when its position has to be known [s]
        self._steadied_at = math.nan  # stamp of the last reading that steadying took [s]
        self.activate(0.0)
        self.state = INACTIVE

    @property
    def held(self) -> bool:
        """Whether the finger rests until somebody says to resume."""
        return self._reason in HELD

    def activate(self, now: float) -> None:
        """Start over: no contact yet, no tick yet, no reason to stop.

        Parameters
        ----------
        now : float
            Time [s], from which the wait for the first contact counts.
        """
        self.state = WAITING
        self._reason = NO_REASON
        self._v_x = self._v_y = 0.0
        self._along = 0.0  # way of the finger along the belt, as commanded [m]
        self._limited = False
        self._ticks = 0
        self._ticks_lost = 0
        self._last_tick = self._elapsed = math.nan
        self._forget(now)

    def continue_from(self, tick: Tick, now: float) -> None:
        """Go on where another control has pushed, as if its last tick had been made here.

        Parameters
        ----------
        tick : Tick
            A tick of the other, in which it pushed on a new contact.
        now : float
            Time of that tick [s].
        """
        self.activate(now)
        self.law.reset(tick.phi)
        self.law.update(tick.theta)
        self._v_x = tick.v_x or 0.0
        self._contact.take(tick.theta, now - tick.silence)
        self._contact.fresh(now, math.inf)
        self.locate_finger(tick.finger_x, now - tick.finger_age, tick.psi)
        self._finger.fresh(now, math.inf)
        self._pole.fresh(now, math.inf)
        self._note_finger()
        self.state = PUSHING
        self._ticks, self._ticks_lost = tick.ticks, tick.ticks_lost
        self._last_tick = now

    def deactivate(self) -> Tick:
        """Rest until the next activation.

        Returns
        -------
        Tick
            The last one, with a velocity of 0.
        """
        self.state = INACTIVE
        self._rest(NO_REASON)
        return self._tick(self._last_tick)

    def feel(self, theta: float, stamp: float) -> None:
        """Take a contact as it arrives.

        Parameters
        ----------
        theta : float
            Angle of the pushed edge [rad]. One that no pushed edge can have stops the finger.
        stamp : float
            When the sensor was read [s]. A contact not newer than the last one is ignored.
        """
        if plausible(theta):
            if stamp - self._contact.newest > self.limits.contact_timeout:
                self._interrupted = True
            self._contact.take(theta, stamp)
        else:
            self._implausible = True

    def locate_finger(self, x: float, stamp: float, psi: float = math.nan) -> None:
        """Take the finger's position as it arrives.

        Parameters
        ----------
        x : float
            Centre of the disk across the belt, in `finger_base` [m]. NaN is ignored.
        stamp : float
            When it was there [s]. A position not newer than the last one is ignored.
        psi : float, optional
            Angle of the finger tip's pole there [rad]; NaN if it is not known.
        """
        if math.isfinite(x):
            self._finger.take(x, stamp)
            self._pole.take(psi, stamp)

    def expect_finger(self, due: float) -> None:
        """Take note that the finger's position has to be known from a time on.

        It has to be anyhow once it was known.

        Parameters
        ----------
        due : float
            From then on the finger stops without it [s]. The earliest time counts.
        """
        self._finger_due = min(self._finger_due, due)

    def notice_another_command(self) -> None:
        """Take note that somebody else commands the finger: it cannot serve two."""
        self._hold(ANOTHER_COMMAND)

    def notice_clock_jump(self, now: float) -> None:
        """Take note that the clock was set, so that every stamp is meaningless.

        Parameters
        ----------
        now : float
            Time after the jump [s].
        """
        self._forget(now)
        self._last_tick = math.nan
        self._hold(CLOCK_JUMPED)

    def resume(self) -> bool:
        """Allow the finger to move again after a stop whose cause somebody has looked at.

        Returns
        -------
        bool
            Whether there was such a stop.
        """
        if self._reason not in HELD:
            return False
        self._rest(CONTACT_SILENT)
        return True

    def tick(self, now: float, elapsed: float = math.nan) -> Tick:
        """Decide on the finger's velocity for the next control period.

        Parameters
        ----------
        now : float
            Time of the tick [s], on the clock of the contacts' stamps.
        elapsed : float, optional
            Time since the last tick on a clock that cannot be set [s]; NaN for the first tick, and
            if time is simulated.

        Returns
        -------
        Tick
            What to command and why.
        """
        self._count(now, elapsed)
        felt = self._contact.fresh(now, self.limits.contact_timeout)
        self._finger.fresh(now, self.limits.joint_state_timeout)
        self._pole.fresh(now, self.limits.joint_state_timeout)
        self._note_finger()
        if self._implausible:
            self._implausible = False
            self._implausible_at = now
        reason = self._reason if self._reason in HELD else self._cause_to_rest(now)
        if self.state == WAITING:
            if felt and not self.law.rests:
                self.state = PUSHING
                if reason:
                    self._rest(reason)
        elif reason:
            self._rest(reason)
        elif self._reason not in (NO_REASON, WORKSPACE_LIMIT):
            self._rest(NO_REASON)
        if self.state == PUSHING or (self.state == STOPPED and not reason):
            self._push(felt)
        return self._tick(now)

    def _push(self, felt: bool) -> None:
        """Let the law act on a new contact, as far as the bounds allow."""
        limits = self.limits
        if felt:
            if self._interrupted:  # the last reading is too long ago to differ from
                self._interrupted = False
                if self.law.away is None:
                    self.law.reset()
            self._steady()
            self.law.update(self._contact.value)
        else:
            self.law.go_on()
        away = self.law.away
        wanted, along = away or (finger_velocity(self.law.phi, self.belt_speed), 0.0)
        bounded = limits.velocity(wanted, self._v_x, self.period)
        self._v_x = limits.inward(bounded, self._finger.value)
        self._v_y = limits.velocity(along, self._v_y, self.period)
        if self._v_y < 0.0 and self._along + self._v_y * self.period < -limits.retreat_max:
            self._v_y = 0.0
        self._limited = bounded != wanted or self._v_y != along
        if away is not None:
            self.law.away = self._v_x, self._v_y
        elif self._v_x != wanted:
            # What the finger does is what the law goes on from: phi(k-1) of (18).
            self.law.phi = motion_angle(self._v_x, self.belt_speed)
        stays = self._reason == WORKSPACE_LIMIT and not felt
        at_limit = self._v_x != bounded or stays
        self.state = STOPPED if at_limit else PUSHING
        self._reason = WORKSPACE_LIMIT if at_limit else NO_REASON
        if at_limit:
            self._end_steadying()

    def _steady(self) -> None:
        """Trim theta_d for the law."""
        x, psi = self._finger.value, self._pole.value
        theta, theta_desired = self._contact.value, self.law.theta_desired
        elapsed = self._contact.stamp - self._steadied_at
        if not elapsed > 0.0:  # this is the first one
            elapsed = self.period
        self._steadied_at = self._contact.stamp
        self.law.trim = self.steadying.follow(theta, theta_desired, x, psi, elapsed)

    def _end_steadying(self) -> None:
        self._steadied_at = math.nan
        self.steadying.reset()
        self.law.trim = 0.0

    def _cause_to_rest(self, now: float) -> str:
        """Find what forbids to push and will be seen to go away."""
        limits = self.limits
        if self.law.rests:
            return self.law.rests
        if abs(now - self._implausible_at) <= limits.contact_timeout:
            return IMPLAUSIBLE_CONTACT
        silent = not abs(now - self._contact.since) <= limits.contact_timeout
        if silent and self.law.away is None:
            return CONTACT_SILENT
        # Not even a new start lets go of a finger that could be watched and cannot be any more.
        known = abs(now - self._finger.since) <= limits.joint_state_timeout
        if now > self._finger_due and not known:
            return FINGER_UNKNOWN
        return NO_REASON

    def _note_finger(self) -> None:
        """Expect from now on that the finger's position is known, if it is."""
        if self._finger.known:
            self._finger_due = -math.inf

    def _rest(self, reason: str) -> None:
        """Hold the finger still; the law will start over."""
        self.law.reset()
        self._end_steadying()
        self._v_x = self._v_y = 0.0
        self._limited = False
        self._reason = reason
        if self.state != INACTIVE:
            self.state = STOPPED

    def _hold(self, reason: str) -> None:
        """Stop until somebody says to resume, unless the finger was never moved."""
        if self.state in (PUSHING, STOPPED) and self._reason not in HELD:
            self._rest(reason)

    def _count(self, now: float, elapsed: float) -> None:
        """Count the ticks, and stop if too many are missing or the clock was set."""
        self._elapsed = elapsed
        passed = now - self._last_tick
        if math.isnan(elapsed):
            jumped = passed < 0.0
        else:
            jumped = abs(passed - elapsed) > self.period
            if not math.isnan(passed):  # there was a tick before
                passed = elapsed
        if jumped:
            self.notice_clock_jump(now)
        if passed > 0.0:
            self._along += self._v_y * passed
            self.law.pass_time(passed)
            lost = max(0, round(passed / self.period) - 1)
            self._ticks_lost += lost
            if lost > self.limits.max_ticks_lost:
                self._hold(TICKS_LOST)
        self._ticks += 1
        self._last_tick = now

    def _forget(self, now: float) -> None:
        """Forget all that was felt."""
        self.law.reset()
        self._end_steadying()
        self._since = now
        if self._finger_due < math.inf:
            self._finger_due = -math.inf  # it has been waited for
        self._contact = Newest()
        self._finger = Newest()
        self._pole = Newest()
        self._interrupted = False
        self._implausible = False
        self._implausible_at = -math.inf

    def _tick(self, now: float) -> Tick:
        silent_since = self._contact.stamp if self._contact.known else self._since
        return Tick(
            self.state,
            self._reason,
            self._contact.value,
            self.law.phi,
            None if self.state == WAITING else self._v_x,
            now - silent_since,
            self.law.saturated,
            self._limited,
            self._finger.value,
            self._ticks,
            self._ticks_lost,
            self._elapsed,
            now - self._finger.stamp if self._finger.known else math.nan,
            self._pole.value,
            self.law.trim,
            self._v_y,
            self.law.apart,
        )
