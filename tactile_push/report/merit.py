# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The paper's figures of merit, from the states that the controller published (Section V.C)."""

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from tactile_push.control import PUSHING, STATES, STOP_REASONS, STOPPED, settle_step
from tactile_push.estimation import contact_of_translation
from tactile_push.paper import PaperFigures, Range, paper_figures

TRANSLATING = 400  # the step after which the paper reads off its ranges

# What is taken of `push_controller/state`.
_OF_STEPS = ('theta', 'theta_desired', 'phi', 'v_x', 'saturated', 'limited')
FIELDS = (*_OF_STEPS, 'silence', 'state', 'stop_reason', 'ticks', 'ticks_lost')
_BLOCK = 4096  # steps that are kept until they are evaluated; more than TRANSLATING


@dataclass(frozen=True)
class Stop:
    """A time for which the finger was held.

    Parameters
    ----------
    reason : str
        Why: one of `STOP_REASONS`.
    at : float
        When it began [s], from the start of the bag.
    duration : float
        How long it took [s]; as far as is recorded, if it did not end.
    ended : bool
        Whether it ended in the bag.
    """

    reason: str
    at: float
    duration: float
    ended: bool


@dataclass(frozen=True)
class PushFigures:
    """How well a finger pushed. What the bag does not tell is None.

    Parameters
    ----------
    states : int
        States in the bag.
    steps : int
        Those in which the law acted: the steps of the paper, counted from 0.
    missing : tuple of str
        Fields that no state had: the bag is older than they are.
    theta_desired : float or None
        Desired angle at the last step [rad].
    theta_desired_changes : int
        How often it was changed between steps.
    band : float
        How near to it counts as settled [rad].
    settle_step : int or None
        Step from which theta stays so near.
    ranges_from : int
        Step from which the following ranges are taken: `TRANSLATING` or, in a shorter run, the
        beginning of its last third.
    theta_range, phi_range : tuple of float or None
        Least and greatest angle [rad].
    l : float or None
        Distance from the edge to the centre of mass [m].
    d_range : tuple of float or None
        Bounds on d by (17) [m].
    v_x_range : tuple of float or None
        Least and greatest command in all steps [m/s].
    saturated_share, limited_share : float or None
        Share of the steps in which phi was at a bound, and v_x or its change.
    ticks, ticks_lost : int or None
        Ticks of the controller, and control periods without one, over all activations.
    silence : float or None
        Longest time without a contact after the first one [s].
    silence_at : float or None
        When that was [s], from the start of the bag.
    stops : list of Stop
        When the finger was held.
    paper : PaperFigures or None
        What to compare with.
    """

    states: int
    steps: int
    missing: tuple[str, ...]
    theta_desired: float | None
    theta_desired_changes: int
    band: float
    settle_step: int | None
    ranges_from: int
    theta_range: Range | None
    phi_range: Range | None
    l: float | None
    d_range: Range | None
    v_x_range: Range | None
    saturated_share: float | None
    limited_share: float | None
    ticks: int | None
    ticks_lost: int | None
    silence: float | None
    silence_at: float | None
    stops: list[Stop]
    paper: PaperFigures | None


class PushHistory:
    """Takes the states of a controller, one after the other, and tells how well it pushed.

    It keeps a bounded number of them, however many there are.

    Parameters
    ----------
    band : float
        How near to the desired angle counts as settled [rad].
    l : float or None
        Distance from the edge to the centre of mass [m], if it is known.
    pushed : str or None
        What is pushed, if it is known: the parameter `object` of `sim_plant`.
    """

    def __init__(self, band: float, l: float | None = None, pushed: str | None = None) -> None:
        self._band = band
        self._l = l
        self._pushed = pushed
        self._seen: set[str] = set()
        self._states = 0
        self._ticks, self._ticks_lost = _Counter(), _Counter()
        self._silence, self._silence_at = -math.inf, math.nan
        self._stops: list[Stop] = []
        self._open: _OpenStop | None = None
        # Of the steps: those not evaluated yet, and what is known of the others.
        self._rows: list[tuple[float, ...]] = []
        self._steps = 0
        self._ranges_from = TRANSLATING
        self._settled: int | None = None
        self._theta_desired = math.nan
        self._changes = 0
        self._saturated, self._limited = 0.0, 0.0
        self._v_x, self._theta, self._phi, self._beta = (_Extremes() for _ in range(4))

    def add(self, time: float, stamp: float, values: Mapping[str, float]) -> None:
        """Take a state.

        Parameters
        ----------
        time : float
            When it was recorded [s], from the start of the bag.
        stamp : float
            When it was published, by its header [s], from any time on.
        values : mapping of str to float
            Its values by name.
        """
        self._seen.update(values)
        self._states += 1
        self._ticks.add(values.get('ticks', math.nan))
        self._ticks_lost.add(values.get('ticks_lost', math.nan))
        state = values.get('state')
        stopped = state == STATES.index(STOPPED)
        pushing = state == STATES.index(PUSHING)
        if state is None:  # of old
            pushing = math.isfinite(values.get('theta', math.nan))
        self._follow_stops(time, stamp, stopped, values.get('stop_reason', math.nan))
        if (pushing or stopped) and values.get('silence', math.nan) > self._silence:
            self._silence, self._silence_at = values['silence'], time
        if pushing:
            self._rows.append(tuple(values.get(name, math.nan) for name in _OF_STEPS))
            if len(self._rows) == _BLOCK:
                self._evaluate()

    def figures(self) -> PushFigures:
        """Evaluate what is left; no more states are taken after that.

        Returns
        -------
        PushFigures
            The figures of merit of all states.
        """
        steps = self._steps + len(self._rows)
        if steps <= TRANSLATING:
            self._ranges_from = steps - steps // 3
        self._evaluate()
        stops = list(self._stops)
        if self._open is not None:
            stops.append(self._open.close(self._open.last, ended=False))
        has = self._seen.__contains__
        desired = self._theta_desired if math.isfinite(self._theta_desired) else None
        silent = math.isfinite(self._silence)
        return PushFigures(
            states=self._states,
            steps=self._steps,
            missing=tuple(name for name in FIELDS if name not in self._seen),
            theta_desired=desired,
            theta_desired_changes=self._changes,
            band=self._band,
            settle_step=self._settled,
            ranges_from=self._ranges_from,
            theta_range=self._theta.range,
            phi_range=self._phi.range,
            l=self._l,
            d_range=self._d_range(),
            v_x_range=self._v_x.range,
            saturated_share=self._share(self._saturated) if has('saturated') else None,
            limited_share=self._share(self._limited) if has('limited') else None,
            ticks=self._ticks.total if has('ticks') else None,
            ticks_lost=self._ticks_lost.total if has('ticks_lost') else None,
            silence=self._silence if silent else None,
            silence_at=self._silence_at if silent else None,
            stops=stops,
            paper=None if desired is None else paper_figures(desired, self._pushed),
        )

    def _share(self, count: float) -> float | None:
        return count / self._steps if self._steps else None

    def _d_range(self) -> Range | None:
        if self._l is None or self._beta.range is None:
            return None
        # d grows with phi - theta.
        d_lower, d_upper = (contact_of_translation(0.0, beta, self._l) for beta in self._beta.range)
        return d_lower, d_upper

    def _evaluate(self) -> None:
        """Take what is to be known of the steps that are kept, and forget them."""
        count = len(self._rows)
        if count == 0:
            return
        steps = dict(zip(_OF_STEPS, np.array(self._rows, dtype=float).T, strict=True))
        self._rows.clear()
        error = steps['theta'] - steps['theta_desired']
        settled = settle_step(error, 0.0, self._band)
        if settled is None:
            self._settled = None
        elif settled > 0 or self._settled is None:
            self._settled = self._steps + settled
        desired = np.concatenate(([self._theta_desired], steps['theta_desired']))
        desired = desired[np.isfinite(desired)]
        self._changes += int(np.count_nonzero(np.diff(desired)))
        if len(desired):
            self._theta_desired = float(desired[-1])
        self._saturated += float(np.nansum(steps['saturated']))
        self._limited += float(np.nansum(steps['limited']))
        self._v_x.add(steps['v_x'])
        first = max(self._ranges_from - self._steps, 0)
        theta, phi = steps['theta'][first:], steps['phi'][first:]
        self._theta.add(theta)
        self._phi.add(phi)
        beta = phi - theta
        self._beta.add(beta[(beta > 0.0) & (beta < math.pi)])
        self._steps += count

    def _follow_stops(self, time: float, stamp: float, stopped: bool, reason: float) -> None:
        if self._open is not None:
            if stopped and reason == self._open.reason:
                self._open.last = stamp
            else:
                self._stops.append(self._open.close(stamp, ended=True))
                self._open = None
        if stopped and self._open is None:
            self._open = _OpenStop(reason, time, stamp, stamp)


class _Extremes:
    """The least and the greatest of the finite values taken so far."""

    def __init__(self) -> None:
        self.range: Range | None = None

    def add(self, values: npt.NDArray[np.float64]) -> None:
        values = values[np.isfinite(values)]
        if len(values):
            before = self.range or (math.inf, -math.inf)
            self.range = min(before[0], float(values.min())), max(before[1], float(values.max()))


@dataclass
class _Counter:
    """A count that begins anew at each activation."""

    finished: float = 0.0
    current: float = 0.0

    def add(self, count: float) -> None:
        if math.isfinite(count):
            if count < self.current:
                self.finished += self.current
            self.current = count

    @property
    def total(self) -> int:
        return round(self.finished + self.current)


@dataclass
class _OpenStop:
    """A stop that has not ended yet; times by the bag's start, and by the stamps."""

    reason: float
    at: float
    first: float
    last: float

    def close(self, stamp: float, *, ended: bool) -> Stop:
        known = self.reason in range(len(STOP_REASONS))
        name = STOP_REASONS[int(self.reason)] if known else f'unknown ({self.reason:g})'
        return Stop(name, self.at, stamp - self.first, ended)
