# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Competing estimators: how they are weighed, dropped and taken back."""

import math
from dataclasses import replace

import numpy as np
import pytest

from tactile_push.estimation.contact_estimator import Estimate, Quantity
from tactile_push.estimation.contenders import UNLIKELY, Contenders
from tactile_push.estimation.contradictions import FEWEST, STILL
from tactile_push.mechanics.resistance import Pressure

NOISE = 0.0035
PRIOR = np.array([0.5, 0.3, 0.2])
NOTHING = Quantity(math.nan, 0.0, 1.0, 0.0, 1.0)
PRESSURE = Pressure(4e-4, 1.5, 0.0, np.array((1.0, 0.0, 1.0)))
BEFORE = Estimate(NOTHING, NOTHING, NOTHING, math.nan, np.eye(4), 0.02, 0.0135, 1.0, '', PRESSURE)


class Estimator:
    """An estimator that gains evidence by a given amount a reading."""

    def __init__(self, gain, contradiction=''):
        self.gain, self.contradiction = gain, contradiction
        self.reconsidered = ''
        self.impossible = False
        self.reset()

    def reset(self):
        self.log_evidence, self.pushes = 0.0, []

    def estimate(self):
        return BEFORE

    def reconsider(self):
        return self.reconsidered or self.contradiction

    def push(self, theta, v_x, v_y, duration, spin=0.0):
        self.pushes.append((theta, v_x, v_y, duration))
        if duration and math.isfinite(theta):
            self.log_evidence += self.gain
        contradiction = self.contradiction if duration else ''
        return replace(BEFORE, theta=theta, contradiction=contradiction)


def contenders(*estimators):
    return Contenders(estimators, PRIOR, NOISE)


def push(compared, theta=0.1):
    compared.push(theta, 0.001, 0.005, 0.1, 0.0)


def test_reason_is_what_the_likeliest_says_when_it_has_reconsidered():
    estimators = [Estimator(gain, 'contradicted') for gain in (0.0, 2.0, 1.0)]
    for number, estimator in enumerate(estimators):
        estimator.reconsidered = f'reconsidered by {number}'
    compared = contenders(*estimators)
    push(compared)
    push(compared)
    assert compared.contradiction == 'reconsidered by 1'


def test_nobody_reconsiders_while_another_one_agrees():
    agreeing, contradicted = Estimator(0.0), Estimator(1.0, 'contradicted')
    contradicted.reconsider = None  # would raise
    compared = contenders(agreeing, contradicted, Estimator(0.5))
    push(compared)
    push(compared)
    assert compared.contradiction == ''


def test_before_any_data_the_weights_are_those_of_the_prior():
    compared = contenders(*map(Estimator, (1.0, 2.0, 3.0)))
    assert compared.weights == pytest.approx(PRIOR)
    push(compared, math.nan)
    assert compared.weights == pytest.approx(PRIOR)


def test_weights_are_the_prior_times_the_evidence():
    compared = contenders(*map(Estimator, (math.log(1.0), math.log(2.0), math.log(5.0))))
    push(compared)
    assert compared.weights == pytest.approx(np.array([0.5, 0.6, 1.0]) / 2.1)
    push(compared)
    assert compared.weights == pytest.approx(np.array([0.5, 1.2, 5.0]) / 6.7)


def test_one_that_is_far_behind_is_dropped_and_hears_no_more():
    behind = Estimator(-9.0)
    compared = contenders(Estimator(0.0), Estimator(0.0), behind)
    for _ in range(3):
        push(compared)
    assert compared.weights == pytest.approx([0.625, 0.375, 0.0])
    assert len(behind.pushes) == 2
    assert [one.contradiction for one in compared.estimates] == ['', '', UNLIKELY]
    assert compared.contradiction == ''


def test_one_that_readings_contradict_is_dropped():
    compared = contenders(Estimator(0.0, 'no'), Estimator(0.0), Estimator(0.0))
    push(compared)
    assert compared.weights == pytest.approx([0.0, 0.6, 0.4])
    assert compared.estimates[0].contradiction == UNLIKELY


def test_when_none_is_left_all_begin_anew_with_the_reason_of_the_likeliest():
    estimators = Estimator(0.0, 'less likely'), Estimator(5.0, 'likeliest'), Estimator(0.0, 'no')
    compared = contenders(*estimators)
    push(compared)
    assert compared.contradiction == 'likeliest'
    assert compared.weights == pytest.approx(PRIOR)
    assert {one.contradiction for one in compared.estimates} == {'likeliest'}
    assert {one.theta for one in compared.estimates} == {0.1}
    assert [one.pushes for one in estimators] == [[(0.1, 0.0, 0.0, 0.0)]] * 3
    assert compared.possible == [True] * 3


def test_they_are_believed_again_after_enough_readings_that_agree():
    estimators = [Estimator(0.0, 'no') for _ in range(3)]
    compared = contenders(*estimators)
    push(compared)
    for one in estimators:
        one.contradiction = ''
    for _ in range(FEWEST - 1):
        push(compared)
    assert compared.contradiction == 'no'
    push(compared)
    assert compared.contradiction == ''
    assert [one.contradiction for one in compared.estimates] == ['', '', '']


def test_an_edge_that_stood_still_has_to_turn_before_anything_counts():
    estimators = [Estimator(1.0, STILL) for _ in range(3)]
    compared = contenders(*estimators)
    push(compared)
    for one in estimators:
        one.contradiction = ''
    for _ in range(2 * FEWEST):
        push(compared)
    assert compared.contradiction == STILL
    assert estimators[0].log_evidence == 0.0  # each reading is a new beginning


def test_what_is_impossible_is_told_unless_nothing_is_believed():
    one, others = Estimator(0.0), (Estimator(0.0), Estimator(0.0))
    compared = contenders(one, *others)
    one.impossible = True
    assert compared.possible == [False, True, True]
    for each in (one, *others):
        each.contradiction = 'no'
    push(compared)
    assert compared.possible == [True, True, True]


def test_a_reset_forgets_all_but_the_prior():
    compared = contenders(*(Estimator(float(i), 'no') for i in range(3)))
    push(compared)
    compared.reset()
    assert compared.contradiction == ''
    assert compared.weights == pytest.approx(PRIOR)
    assert all(math.isnan(one.theta) for one in compared.estimates)
