# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""From goals and estimates to the moment to let go: what `push_controller` does beside its ticks.

A control period begins with `begin`, which tells the law what is believed. Then the control ticks,
and `finish` takes what came of it. `PushControl` decides when the finger stops, as with any law.
"""

import math
from collections import deque
from collections.abc import Iterator, Mapping, Sequence

from tactile_push.control import CONTACT_SILENT, PUSHING, PushControl, Tick
from tactile_push.control.placing.believing import Belief
from tactile_push.control.placing.law import PlaceLaw
from tactile_push.control.placing.model import Goal, centre_of_mass
from tactile_push.control.placing.stages import (
    AWAITING_CONTACT,
    CANCELLED,
    CONTRADICTED,
    FACES_AWAY,
    HELD_STILL,
    LEARNING,
    LETTING_GO,
    LIFTED,
    NO_EDGE,
    NOT_FINITE,
    NOTHING_KNOWN,
    OBJECT_LOST,
    OTHER_FRAME,
    OTHER_ROTATION,
    OUTSIDE_WORKSPACE,
    PLACING,
    REASONS,
    REFUSALS,
    RELEASED,
    STAGES,
    VERDICTS,
)
from tactile_push.estimation.contradictions import BLIND, CONTRADICTIONS
from tactile_push.interface import FINGER_BASE, PLACE_RELEASE, PLACE_STATE, is_frame
from tactile_push.pipeline.belief import belief_of
from tactile_push.pipeline.messages import Output, joint_state_fields
from tactile_push.pipeline.named import by_name
from tactile_push.pipeline.orientation import yaw_of_quaternion
from tactile_push.pipeline.outlook import ReachOutlook
from tactile_push.pipeline.stamps import Seconds, Stamp

OLDEST = 5  # control periods for which the law does without a new estimate; picked
NOTHING: tuple[float, dict[str, float]] = (-math.inf, {})  # heard of the object


class Placing:
    """Serves goals with the law that places.

    Parameters
    ----------
    push : PushControl
        The control, which gets the law.
    law : PlaceLaw
        The law, without a goal.
    seconds : callable
        Returns the time [s] of a stamp.

    Attributes
    ----------
    goals, refused, released : int
        Goals taken and refused, and objects let go.
    refusal : str
        Why the last goal was refused, one of `REFUSALS`; empty if it was not.
    reach : ReachOutlook
        Whether the goal can be reached.
    """

    def __init__(self, push: PushControl, law: PlaceLaw, seconds: Seconds) -> None:
        push.law = law
        self._push, self._law = push, law
        self._seconds = seconds
        self.goals = self.refused = self.released = 0
        self.refusal = ''
        self.reach = ReachOutlook()
        self._goal = law.goal
        self._lifted = False
        self._next: Goal | None = None  # for which the finger has to be put down again
        self._says_down = False
        self._heard = NOTHING  # of the object, and of which control period [s]
        self._used = -math.inf  # the control period that the law's estimate is about [s]
        self._unknown = 0  # periods of pushing since the last estimate
        self._belief: Belief | None = None
        self._read = math.nan  # when the reading was taken that it is about [s]
        self._began = math.inf  # when the law first felt the object [s]
        # When a control period began [s], where the finger was at its reading [m], and how the tip
        # turned there for its way [rad/m].
        self._periods: deque[tuple[float, float, float]] = deque(maxlen=4 * OLDEST)
        self._ticked = math.nan  # [s]
        self._v_x = math.nan  # from the last tick on [m/s]

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
        elif not all(map(math.isfinite, (x, *rotation))):
            refusal = NOT_FINITE
        else:
            refusal = self._refusal(goal)
        if refusal:
            self.refuse(refusal)
        else:
            self.take(goal)
        return refusal

    def take(self, goal: Goal) -> None:
        """Serve a goal, in place of the one that is served."""
        self.goals += 1
        self.refusal = ''
        self._goal = goal
        if self._lifted:
            self._next = goal
        else:
            self._start(goal)

    def refuse(self, refusal: str) -> None:
        """Take note that a goal was refused, for one of `REFUSALS`."""
        self.refused += 1
        self.refusal = refusal

    def cancel(self) -> bool:
        """Give up the goal; return whether there was one that the object was not let go for."""
        if self._next is None and not self._unfinished:
            return False
        self._next = None
        self._law.end(CANCELLED)
        return True

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

    @property
    def awaits_estimate(self) -> bool:
        """Whether the estimate of the last control period is still to come."""
        return self._acts and self._push.state == PUSHING and self._heard[0] < self._ticked

    @property
    def stage(self) -> str:
        """What becomes of the goal, one of `STAGES`."""
        if self._next is not None:
            return LIFTED
        if self._law.stage == LEARNING and not self._law.began:
            return AWAITING_CONTACT
        return LETTING_GO if self._waits_to_tell else self._law.stage

    @property
    def let_go_in(self) -> float:
        """When to say that the object is let go, after the last tick [s]; NaN if not yet."""
        return self._law.tell_in

    def release(self) -> bool:
        """Let the object go if that still holds, at the moment for it; return whether to say so."""
        holds = self._push.state == PUSHING and not self._contradicts
        if not (self._waits_to_tell and holds):
            return False
        self._law.told()
        self._lifted = True
        self.released += 1
        return True

    def begin(self) -> None:
        """Begin a control period, before the control ticks."""
        if self._waits_to_tell:  # in vain
            self._law.take_back()
        at, values = self._heard
        is_new = at != self._used
        if is_new:
            self._used = at
            self._belief, self._read = self._believed(at, values)
        if not self._acts:
            return
        law = self._law
        if self._contradicts:
            law.end(CONTRADICTED)
            return
        if is_new and self._belief is not None:
            self._unknown = 0
        elif self._push.state == PUSHING:
            self._unknown += 1
        if self._unknown > OLDEST:
            law.end(NOTHING_KNOWN)
        law.believe(self._belief, self._ticked - self._read)

    def finish(self, now: float, tick: Tick, turning: float) -> None:
        """Take what came of a control period.

        Parameters
        ----------
        now, tick, turning : float, Tick, float
            When it began [s], what the control used and gave, and by how much the tip turns for
            each metre across the belt [rad/m].
        """
        self._periods.append((now, tick.x_at_reading(self._v_x), turning))
        self._ticked, self._v_x = now, tick.known_velocity
        if self._acts:
            self._began = min(self._began, now)
            if tick.stop_reason == CONTACT_SILENT:
                self._law.end(OBJECT_LOST)
        at, values = self._heard
        forgotten = values.get('readings', 0.0) == 0.0 or now - at > OLDEST * self._push.period
        silent = tick.silence > self._push.limits.contact_timeout
        if self._next is not None and silent and forgotten:  # the next object can be no other
            self._lifted = False
            self._start(self._next)

    def look_ahead(self) -> None:
        """Make a plan to find out whether the goal can be reached, unless that is known."""
        if not self._acts:
            self.reach.pause()
        elif self._belief is not None:
            self.reach.look(self._law, self._goal, self._belief.spread.d)

    def outputs(self, stamp: Stamp) -> Iterator[Output]:
        """Yield the messages of a control period."""
        yield PLACE_STATE, joint_state_fields(stamp, self.values())
        if self._says_down:
            self._says_down = False
            yield PLACE_RELEASE, {'data': False}

    def values(self) -> dict[str, float]:
        """Return the numbers of `place/state` after a tick, by name."""
        law, reach = self._law, self.reach
        plan = law.plan if law.stage in (PLACING, LETTING_GO, RELEASED) else None
        x = theta = d = math.nan
        present = law.present()
        if present is not None:
            now, belief = present
            x, theta, d = centre_of_mass(now, belief.pushed), now.theta, now.d
        return {
            'stage': float(STAGES.index(self.stage)),
            'refusal': float(REFUSALS.index(self.refusal)),
            'goals': float(self.goals),
            'refused': float(self.refused),
            'released': float(self.released),
            'goal_x': self._goal.x,
            'goal_theta': self._goal.theta,
            'x': x,
            'theta': theta,
            'd': d,
            'x_miss': plan.x_error if plan else math.nan,
            'theta_miss': plan.theta_error if plan else math.nan,
            'way_left': plan.length if plan else math.nan,
            'belt_left': max(law.belt - law.used, 0.0) if self.goals else math.nan,
            'reachable': float(VERDICTS.index(reach.verdict)),
            'reach_reason': float(REASONS.index(reach.reason)),
            'nearest_x': reach.nearest.x,
            'nearest_theta': reach.nearest.theta,
            'let_go_in': self.let_go_in,
            'estimate_age': self._ticked - self._used if self._heard is not NOTHING else math.nan,
            'turning': self._periods[-1][2] if self._periods else math.nan,
        }

    @property
    def _unfinished(self) -> bool:
        """Whether a goal is served and the object not let go."""
        return self._law.stage in (LEARNING, PLACING) or self._waits_to_tell

    @property
    def _acts(self) -> bool:
        """Whether the object is pushed to a goal."""
        return self._law.began and self._law.stage in (LEARNING, PLACING)

    @property
    def _waits_to_tell(self) -> bool:
        """Whether the law has said when to let go, and nobody has heard it yet."""
        return math.isfinite(self._law.tell_in)

    @property
    def _contradicts(self) -> bool:
        """Whether the last reading contradicts the object that the goal is about."""
        at, values = self._heard
        known = values.get('contradiction', 0.0) > 0.0 and at >= self._began
        return known and values['contradiction'] != CONTRADICTIONS.index(BLIND)

    def _start(self, goal: Goal) -> None:
        """Let the law serve a goal."""
        self._next = None
        self._says_down = True
        self._unknown = 0
        self._began = math.inf
        self._law.aim_at(goal)
        self.reach = ReachOutlook()

    def _refusal(self, goal: Goal) -> str:
        """Return why a goal of finite numbers is refused, empty if it is not."""
        if math.isnan(goal.theta):
            return OTHER_ROTATION
        if abs(goal.theta) >= math.pi / 2.0:
            return FACES_AWAY
        _, values = self._heard
        if values and math.isnan(values.get('edge', math.nan)):
            return NO_EDGE
        if not self._within_workspace(goal, values):
            return OUTSIDE_WORKSPACE
        return HELD_STILL if self._push.held else ''

    def _within_workspace(self, goal: Goal, values: Mapping[str, float]) -> bool:
        """Return whether the finger stays in the workspace at a goal, wherever it touches the edge.

        As long as no edge is known, the goal itself has to be in the workspace.
        """
        limits = self._push.limits
        least = most = goal.x
        numbers = [values.get(name, math.nan) for name in ('edge_start', 'edge_end', 'l', 'radius')]
        if all(map(math.isfinite, numbers)):
            start, end, l, r = numbers
            across = goal.x + (l + r) * math.sin(goal.theta)
            least, most = (across + d * math.cos(goal.theta) for d in (start, end))
        return most >= limits.workspace_min and least <= limits.workspace_max

    def _believed(self, at: float, values: Mapping[str, float]) -> tuple[Belief | None, float]:
        """Return what is believed of a control period, and when its reading was taken [s]."""
        read = at - values.get('age', math.nan)
        for began, x, turning in self._periods:
            if began == at and math.isfinite(read):
                piece = self._push.period * self._push.belt_speed
                return belief_of(values, x, turning, piece), read
        return None, math.nan
