# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Estimators that compete for the same readings."""

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from tactile_push.estimation.contact_estimator import ContactEstimator, Estimate
from tactile_push.estimation.contradictions import Probation
from tactile_push.mechanics.compiled import Array

EDGE_GONE = 16.0  # an estimator less likely than the best by exp(16), 9e6 times, is dropped
UNLIKELY = 'another edge agrees far better with the readings'


class Contenders:
    """Weighs estimators by how well they agree with the readings.

    It drops an estimator that has become too unlikely or that the readings contradict. When none is
    left, all begin anew with the last reading; `Probation` decides when to believe them again.
    """

    def __init__(self, estimators: Sequence[ContactEstimator], prior: Array, noise: float) -> None:
        self._estimators = estimators
        self._prior = prior
        self._before = [estimator.estimate() for estimator in estimators]
        self._probation = Probation(noise)
        self.reset()

    @property
    def contradiction(self) -> str:
        """Why none is to be believed; empty if one is."""
        return self._probation.reason

    @property
    def estimates(self) -> list[Estimate]:
        """Their estimates; before any data and of those not to be believed, the prior."""
        reasons = {i: '' for i in self._alive}
        if self.contradiction:
            reasons = dict.fromkeys(range(len(self._before)), self.contradiction)
        return [
            replace(before, theta=self._theta, contradiction=reasons.get(i, UNLIKELY))
            if reasons.get(i, UNLIKELY)
            else latest
            for i, (before, latest) in enumerate(zip(self._before, self._latest, strict=True))
        ]

    @property
    def possible(self) -> list[bool]:
        """Whether the data do not exclude an estimator for certain."""
        return [
            bool(self.contradiction) or not estimator.impossible for estimator in self._estimators
        ]

    def reset(self) -> None:
        """Forget everything but the prior."""
        self._probation.reset()
        self._theta = math.nan
        self._begin()

    def push(self, theta: float, v_x: float, v_y: float, duration: float, spin: float) -> None:
        """Take a push and the reading at its end, as `ContactEstimator.push` does."""
        for i in self._alive:
            self._latest[i] = self._estimators[i].push(theta, v_x, v_y, duration, spin)
        if math.isfinite(theta):
            self._theta = theta
            self._weigh()

    def touch_again(self, theta: float, way: float, unfelt: float) -> None:
        """Take the first reading of another contact, as `ContactEstimator.touch_again` does."""
        for i in self._alive:
            self._latest[i] = self._estimators[i].touch_again(theta, way, unfelt)
        self._theta = theta
        self._weigh()

    def _begin(self) -> None:
        """Begin anew with all, at the last reading."""
        self._latest = list(self._before)
        for i, estimator in enumerate(self._estimators):
            estimator.reset()
            if math.isfinite(self._theta):
                self._latest[i] = estimator.push(self._theta, 0.0, 0.0, 0.0)
        self._alive = list(range(len(self._estimators)))
        self.weights = self._prior

    def _weigh(self) -> None:
        """Weigh those that are left by all readings so far."""
        evidence = np.full(len(self._estimators), -math.inf)
        for i in self._alive:
            evidence[i] = math.log(self._prior[i]) + self._estimators[i].log_evidence
        agree = [i for i in self._alive if not self._latest[i].contradiction]
        if not agree:
            reason = self._estimators[int(np.argmax(evidence))].reconsider()
            self._probation.contradicted(reason, self._theta)
            self._begin()
        elif self._probation.agreed(self._theta):
            self._begin()
        else:
            best = evidence[agree].max()
            self._alive = [i for i in agree if evidence[i] > best - EDGE_GONE]
            weights = np.zeros(len(evidence))
            weights[self._alive] = np.exp(evidence[self._alive] - best)
            self.weights = weights / weights.sum()
