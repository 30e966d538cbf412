# Copyright 2026 The tactile_push authors
#
# Licensed under the Apache License, Version 2.0 (the "License");
# you may not use this file except in compliance with the License.
# You may obtain a copy of the License at
#
#     http://www.apache.org/licenses/LICENSE-2.0
#
# Unless required by applicable law or agreed to in writing, software
# distributed under the License is distributed on an "AS IS" BASIS,
# WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
# See the License for the specific language governing permissions and
# limitations under the License.
"""When the law may act: a contact is there and fresh, or the finger rests."""

import math
from dataclasses import dataclass

from tactile_push.control.law import PushLaw, finger_velocity

# No contact since activation; the law acts; contact is lost and the finger rests.
WAITING, PUSHING, CONTACT_LOST = 'waiting for contact', 'pushing', 'contact lost'
STATES = (WAITING, PUSHING, CONTACT_LOST)


@dataclass(frozen=True)
class Tick:
    """All that one control period used and gave.

    Parameters
    ----------
    state : str
        One of `STATES`.
    theta : float
        Last sensed angle of the edge [rad]; NaN if there is none.
    phi : float
        Push angle [rad]; straight ahead while the finger rests.
    v_x : float or None
        Commanded finger velocity [m/s]; None before the first contact: whoever moves the finger
        then, it is not this controller.
    silence : float
        Time since the last contact was sensed or, before the first one, since activation or since
        the clock went back [s].
    saturated : bool
        Whether phi is at one of its bounds.
    ticks : int
        Ticks of the law since activation, this one included.
    ticks_lost : int
        Control periods since activation that passed without a tick.
    """

    state: str
    theta: float
    phi: float
    v_x: float | None
    silence: float
    saturated: bool
    ticks: int
    ticks_lost: int


class PushControl:
    """Runs the law on fresh contacts and stops the finger without them.

    A contact that was used once is not used again: without a new one the push goes on as it was,
    and after `contact_timeout` the finger stops. When contact returns the law starts over from
    straight ahead, the push angle of the resting finger: it resumes by itself and without a kick.

    Parameters
    ----------
    law : PushLaw
        The control law.
    belt_speed : float
        Speed of the belt, v_y [m/s].
    period : float
        Control period [s].
    contact_timeout : float
        Age of the last contact beyond which the finger stops [s].
    """

    def __init__(
        self, law: PushLaw, belt_speed: float, period: float, contact_timeout: float
    ) -> None:
        self.law = law
        self.belt_speed = belt_speed
        self.period = period
        self.contact_timeout = contact_timeout
        self._theta = math.nan
        self._stamp = -math.inf
        self._felt: tuple[float, float] | None = None
        self._last_tick = -math.inf
        self.activate(0.0)

    def activate(self, now: float) -> None:
        """Start over: no contact yet, no tick yet.

        Parameters
        ----------
        now : float
            Time [s], from which the wait for the first contact counts.
        """
        self.state = WAITING
        self._ticks = 0
        self._ticks_lost = 0
        self._forget(now)

    def feel(self, theta: float, stamp: float) -> None:
        """Take a contact as it arrives.

        Parameters
        ----------
        theta : float
            Angle of the pushed edge [rad]. One that is not finite is no contact.
        stamp : float
            When the sensor was read [s]. A contact not newer than the last one is ignored.
        """
        newest = self._stamp if self._felt is None else self._felt[1]
        if math.isfinite(theta) and math.isfinite(stamp) and stamp > newest:
            self._felt = theta, stamp

    def tick(self, now: float) -> Tick:
        """Decide on the finger's velocity for the next control period.

        Parameters
        ----------
        now : float
            Time of the tick [s], on the clock of the contacts' stamps.

        Returns
        -------
        Tick
            What to command and why.
        """
        self._count(now)
        # A contact from the future is as useless as an old one: somebody's clock is wrong.
        felt, self._felt = self._felt, None
        if felt is not None and felt[1] - now <= self.contact_timeout:
            lost_meanwhile = felt[1] - self._stamp > self.contact_timeout
            self._theta, self._stamp = felt
            if now - self._stamp <= self.contact_timeout:
                if lost_meanwhile:
                    self.law.reset()
                self.state = PUSHING
                self.law.update(self._theta)
        silence = now - (self._stamp if math.isfinite(self._stamp) else self._since)
        if self.state == PUSHING and not abs(silence) <= self.contact_timeout:
            self.state = CONTACT_LOST
            self.law.reset()
        v_x = None if self.state == WAITING else finger_velocity(self.law.phi, self.belt_speed)
        return Tick(
            self.state,
            self._theta,
            self.law.phi,
            v_x,
            silence,
            self.law.saturated,
            self._ticks,
            self._ticks_lost,
        )

    def _count(self, now: float) -> None:
        if now < self._last_tick:  # the clock went back, so every stamp is meaningless
            self._forget(now)
        elif math.isfinite(self._last_tick):
            self._ticks_lost += max(0, round((now - self._last_tick) / self.period) - 1)
        self._ticks += 1
        self._last_tick = now

    def _forget(self, now: float) -> None:
        self.law.reset()
        self._since = now
        self._theta = math.nan
        self._stamp = -math.inf
        self._felt = None
        self._last_tick = -math.inf
