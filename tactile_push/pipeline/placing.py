# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""From goals and estimates to the moment to let go: what `push_controller` does beside its ticks.

A control period begins with `begin`, which tells the law what is believed. Then the control ticks,
and `finish` takes what came of it. `PushControl` decides when the finger stops, as with any law.
"""

import math
from collections.abc import Iterator, Mapping, Sequence

from tactile_push.control import CONTACT_SILENT, PUSHING, PushControl, Tick
from tactile_push.control.placing.law import PlaceLaw
from tactile_push.control.placing.model import Goal
from tactile_push.control.placing.stages import (
    AWAITING_CONTACT,
    CANCELLED,
    CONTRADICTED,
    HELD_STILL,
    LEARNING,
    LETTING_GO,
    LIFTED,
    NO_EDGE,
    NOTHING_KNOWN,
    OBJECT_LOST,
    OUT_OF_REACH,
    OUTSIDE_WORKSPACE,
    PLACING,
    REASONS,
    REGRASPING,
    RELEASED,
    VERDICTS,
)
from tactile_push.estimation.contradictions import BLIND, CONTRADICTIONS
from tactile_push.interface import PLACE_RELEASE
from tactile_push.pipeline.believing import OLDEST, Believing
from tactile_push.pipeline.messages import Output
from tactile_push.pipeline.outlook import ReachOutlook
from tactile_push.pipeline.stamps import Seconds, Stamp

PUSHES = (LEARNING, PLACING, REGRASPING)  # stages in which a goal is served and nothing decided


class Placing(Believing):
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
    reach : ReachOutlook
        Whether the goal can be reached.
    """

    _law: PlaceLaw

    def __init__(self, push: PushControl, law: PlaceLaw, seconds: Seconds) -> None:
        super().__init__(push, law, seconds)
        self.reach = ReachOutlook()
        self._goal = law.goal
        self._lifted = False
        self._next: Goal | None = None  # for which the finger has to be put down again
        self._says_down = False
        self._began = math.inf  # when the law first felt the object [s]

    def take(self, goal: Goal) -> None:
        """Serve a goal, in place of the one that is served."""
        super().take(goal)
        self._goal = goal
        if self._lifted:
            self._next = goal
        else:
            self._start(goal)

    def cancel(self) -> bool:
        """Give up the goal; return whether there was one that the object was not let go for."""
        if self._next is None and not self._unfinished:
            return False
        self._next = None
        self._law.end(CANCELLED)
        return True

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
        is_new = self._take_estimate()
        if not self._acts:
            return
        law = self._law
        if self._contradicts:
            law.end(CONTRADICTED)
            return
        if law.stage == REGRASPING:  # what was believed is about the contact that is left
            self._belief, self._unknown = None, 0
            self.reach = ReachOutlook()
        elif is_new and self._belief is not None:
            self._unknown = 0
        elif self._push.state == PUSHING:
            self._unknown += 1
        if self._unknown > OLDEST:
            law.end(NOTHING_KNOWN)
        law.believe(self._belief, self._ticked - self._read)

    def finish(self, now: float, tick: Tick, turning: float, links: Sequence[float]) -> None:
        """Take what came of a control period, as in `Believing`."""
        super().finish(now, tick, turning, links)
        if self._acts:
            self._began = min(self._began, now)
            if tick.stop_reason == CONTACT_SILENT:
                self._law.end(OBJECT_LOST)
        at, values = self._heard
        forgotten = values.get('readings', 0.0) == 0.0 or now - at > OLDEST * self._push.period
        silent = tick.silence > self._push.limits.contact_timeout
        # The next object can be no other, and the finger is where it takes objects.
        if self._next is not None and silent and forgotten and not self._law.returns:
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
        yield from super().outputs(stamp)
        if self._says_down:
            self._says_down = False
            yield PLACE_RELEASE, {'data': False}

    def values(self) -> dict[str, float]:
        """Return the numbers of `place/state` after a tick, by name."""
        law, reach = self._law, self.reach
        plan = law.plan if law.stage in (PLACING, LETTING_GO, RELEASED) else None
        return super().values() | {
            'goal_x': self._goal.x,
            'goal_theta': self._goal.theta,
            'x_miss': plan.x_error if plan else math.nan,
            'theta_miss': plan.theta_error if plan else math.nan,
            'way_left': plan.length if plan else math.nan,
            'belt_left': max(law.belt - law.used, 0.0) if self.goals else math.nan,
            'reachable': float(VERDICTS.index(reach.verdict)),
            'reach_reason': float(REASONS.index(reach.reason)),
            'nearest_x': reach.nearest.x,
            'nearest_theta': reach.nearest.theta,
            'let_go_in': self.let_go_in,
        }

    @property
    def doubt(self) -> str:
        """What somebody should hear of, in words: that the goal is out of reach."""
        reach = self.reach
        out = reach.verdict == OUT_OF_REACH
        return f'out of reach by what is known: {reach.reason}' if out else ''

    @property
    def told(self) -> dict[str, object]:
        """What diagnostics tell of the goal."""
        return super().told | {'goal reachable': self.reach.verdict}

    @property
    def _unfinished(self) -> bool:
        """Whether a goal is served and the object not let go."""
        return self._law.stage in PUSHES or self._waits_to_tell

    @property
    def _acts(self) -> bool:
        """Whether the object is brought to a goal."""
        return self._law.began and self._law.stage in PUSHES

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
        refusal = super()._refusal(goal)
        if refusal not in ('', HELD_STILL):
            return refusal
        _, values = self._heard
        if values and math.isnan(values.get('edge', math.nan)):
            return NO_EDGE
        return refusal if self._within_workspace(goal, values) else OUTSIDE_WORKSPACE

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
