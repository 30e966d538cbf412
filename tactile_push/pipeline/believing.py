# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""From estimates to what a law believes: what `push_controller` does beside the ticks of such laws.

A control period begins with `begin`, which tells the law what is believed. Then the control ticks,
and `finish` takes what came of it.
"""

import math
from abc import ABC, abstractmethod
from collections import deque
from collections.abc import Iterator, Sequence

from tactile_push.control import PUSHING, UNKNOWN, Drift, Outlook, PushControl, Tick
from tactile_push.control.placing.believing import Belief, BelievingLaw
from tactile_push.control.placing.model import Goal, centre_of_mass
from tactile_push.control.placing.stages import (
    FACES_AWAY,
    HELD_STILL,
    NOT_FINITE,
    OTHER_FRAME,
    OTHER_ROTATION,
    REFUSALS,
    STAGES,
)
from tactile_push.interface import FINGER_BASE, PLACE_STATE, TOPICS, is_frame
from tactile_push.pipeline.belief import belief_of
from tactile_push.pipeline.messages import Output, joint_state_fields
from tactile_push.pipeline.named import by_name
from tactile_push.pipeline.orientation import yaw_of_quaternion
from tactile_push.pipeline.stamps import Seconds, Stamp

OLDEST = 5  # control periods for which a law does without a new estimate; picked
NOTHING: tuple[float, dict[str, float]] = (-math.inf, {})  # heard of the object


class Believing(ABC):
    """Serves goals with a law that believes. Each such law has its own goals and stages.

    Parameters
    ----------
    push : PushControl
        The control, which gets the law.
    law : BelievingLaw
        The law.
    seconds : callable
        Returns the time [s] of a stamp.

    Attributes
    ----------
    goals, refused, released : int
        Goals taken and refused, and objects let go.
    refusal : str
        Why the last goal was refused, one of `REFUSALS`; empty if it was not.
    """

    def __init__(self, push: PushControl, law: BelievingLaw, seconds: Seconds) -> None:
        push.law = law
        self._push, self._law = push, law
        self._seconds = seconds
        self.goals = self.refused = self.released = 0
        self.refusal = ''
        self._heard = NOTHING  # of the object, and of which control period [s]
        self._used = -math.inf  # the control period that the law's estimate is about [s]
        self._unknown = 0  # control periods since the last estimate that said something
        self._belief: Belief | None = None
        self._read = math.nan  # when the reading was taken that it is about [s]
        # When a control period began [s], where the finger was at its reading [m], and its links.
        self._periods: deque[tuple[float, float, Sequence[float]]] = deque(maxlen=4 * OLDEST)
        self._turning = math.nan  # of the tip for its way [rad/m]
        self._ticked = math.nan  # [s]
        self._v_x = math.nan  # from the last tick on [m/s]

    @property
    @abstractmethod
    def stage(self) -> str:
        """What the law does, one of `STAGES`."""

    @property
    def let_go_in(self) -> float:
        """When to say that the object is let go, after the last tick [s]; NaN if not yet."""
        return math.nan

    @property
    @abstractmethod
    def doubt(self) -> str:
        """What somebody should hear of, in words; empty if nothing."""

    @property
    def told(self) -> dict[str, object]:
        """What diagnostics tell of the goal."""
        return {'goal': self.stage}

    @property
    def awaits_estimate(self) -> bool:
        """Whether the estimate of the last control period is still to come."""
        return self._acts and self._push.state == PUSHING and self._heard[0] < self._ticked

    def goal(self, frame: str, x: float, rotation: Sequence[float]) -> str:
        """Take a message of `place/goal`, or refuse it and go on as before.

        Parameters
        ----------
        frame, x, rotation : str, float, sequence of float
            The message's frame, x of its position [m], and its quaternion.

        Returns
        -------
        str
            Why it is refused, one of `REFUSALS`; empty if it is not.
        """
        goal = Goal(x, yaw_of_quaternion(*rotation))
        if not is_frame(frame, FINGER_BASE):
            refusal = OTHER_FRAME
        elif not all(map(math.isfinite, self._numbers(x, rotation))):
            refusal = NOT_FINITE
        else:
            refusal = self._refusal(goal)
        if refusal:
            self.refuse(refusal)
        else:
            self.take(goal)
        return refusal

    def take(self, goal: Goal) -> None:
        """Serve a goal, in place of the one that is served, as far as it matters."""
        self.goals += 1
        self.refusal = ''

    def refuse(self, refusal: str) -> None:
        """Take note that a goal was refused, for one of `REFUSALS`."""
        self.refused += 1
        self.refusal = refusal

    @abstractmethod
    def cancel(self) -> bool:
        """Give up the goal; return whether there was one."""

    def release(self) -> bool:
        """Let the object go if it is the moment for it; return whether to say so."""
        return False

    def sensed(self, stamp: Stamp, names: Sequence[str], positions: Sequence[float]) -> None:
        """Take a message of `active_sensing/state`.

        One that is not the newest, or not about a control period of this controller, is ignored.

        Parameters
        ----------
        stamp, names, positions : tuple of int, sequence of str, sequence of float
            When its control period began [s, ns], names and their values.
        """
        at = self._seconds(*stamp)
        if at > self._heard[0] and any(at == began for began, _, _ in self._periods):
            self._heard = at, by_name(names, positions)

    @abstractmethod
    def begin(self) -> None:
        """Begin a control period, before the control ticks."""

    def finish(self, now: float, tick: Tick, turning: float, links: Sequence[float]) -> None:
        """Take what came of a control period.

        Parameters
        ----------
        now, tick, turning, links : float, Tick, float, sequence of float
            When it began [s], what the control used and gave, by how much the tip turns for each
            metre across the belt [rad/m], and the finger's links, as `Control.links`.
        """
        self._periods.append((now, tick.x_at_reading(self._v_x), links))
        self._turning = turning
        self._ticked, self._v_x = now, tick.known_velocity

    def outlook(self, drift: Drift, tick: Tick, turning: float) -> Outlook:
        """Return where the finger's drift leads, unless it is part of a plan.

        Parameters
        ----------
        drift, tick, turning : Drift, Tick, float
            What averages it; as in `finish`.
        """
        return UNKNOWN

    @abstractmethod
    def look_ahead(self) -> None:
        """Find out about the goal what takes its time, after the command was given."""

    def outputs(self, stamp: Stamp) -> Iterator[Output]:
        """Yield the messages of a control period."""
        yield PLACE_STATE, joint_state_fields(stamp, self.values())

    def values(self) -> dict[str, float]:
        """Return the numbers of `place/state` after a tick, by name."""
        x, theta, d = self._where
        _, _, y, bend = self._periods[-1][2] if self._periods else (math.nan,) * 4
        return dict.fromkeys(TOPICS[PLACE_STATE].field_names, math.nan) | {
            'stage': float(STAGES.index(self.stage)),
            'refusal': float(REFUSALS.index(self.refusal)),
            'goals': float(self.goals),
            'refused': float(self.refused),
            'released': float(self.released),
            'x': x,
            'theta': theta,
            'd': d,
            'estimate_age': self._ticked - self._used if self._heard is not NOTHING else math.nan,
            'turning': self._turning,
            'finger_y': y,
            'bend': bend,
        }

    @property
    def _where(self) -> tuple[float, float, float]:
        """Where the object is believed: x of its centre [m], theta [rad], d [m]; NaN if nowhere."""
        present = self._law.present()
        if present is None:
            return math.nan, math.nan, math.nan
        now, belief = present
        return centre_of_mass(now, belief.pushed), now.theta, now.d

    @property
    @abstractmethod
    def _acts(self) -> bool:
        """Whether the law needs estimates."""

    def _numbers(self, x: float, rotation: Sequence[float]) -> Sequence[float]:
        """Return the numbers of a goal that matter."""
        return x, *rotation

    def _refusal(self, goal: Goal) -> str:
        """Return why a goal of finite numbers is refused, empty if it is not."""
        if math.isnan(goal.theta):
            return OTHER_ROTATION
        if abs(goal.theta) >= math.pi / 2.0:
            return FACES_AWAY
        return HELD_STILL if self._push.held else ''

    def _take_estimate(self) -> bool:
        """Take the newest estimate; return whether it is another than in the last period."""
        at, values = self._heard
        if at == self._used:
            return False
        self._used = at
        self._belief, self._read = None, math.nan
        read = at - values.get('age', math.nan)
        for began, x, links in self._periods:
            if began == at and math.isfinite(read):
                piece = self._push.period * self._push.belt_speed
                self._belief, self._read = belief_of(values, x, links, piece), read
        return True
