# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import math

import numpy as np
import pytest

from support.simulated_pushes import (
    BELT,
    BLOCK,
    NOISE,
    PERIOD,
    PLATE,
    TRIANGLE,
    follow,
    pushes,
    pushes_by_a_tip,
    rig_of,
)
from tactile_push.estimation import (
    CONTRADICTIONS,
    DiskEstimator,
    Edge,
    ObjectEstimator,
    edges_of,
)
from tactile_push.estimation.contradictions import (
    ANYWHERE,
    JUMPED,
    LEFT,
    MOVED,
    OTHERWISE,
    STILL,
    Probation,
    Watch,
)


def known(vertices=BLOCK, edge=0):
    return ObjectEstimator(edges_of(vertices)[edge : edge + 1], NOISE)


def assert_nothing_is_known(estimate, estimator):
    before = type(estimator).estimate(known())
    for name in ('d', 'c', 'mu_c'):
        now, then = getattr(estimate, name), getattr(before, name)
        assert (now.lower, now.upper) == (then.lower, then.upper)
        assert (now.least, now.most) == (then.least, then.most)


def random_pushes(seed, steps=150, vertices=BLOCK):
    rng = np.random.default_rng(seed)
    mu_c = [0.0, 0.2, 0.6, math.inf][seed % 4]
    edge = edges_of(vertices)[0]
    d = sum(edge.d) / 2.0 + rng.uniform(-0.4, 0.4) * edge.length
    rig = rig_of(vertices, 0, rng.uniform(-0.4, 0.4), d, mu_c, rng.uniform(0.005, 0.036))
    return pushes(rig, steps, seed)


@pytest.mark.slow
def test_normal_pushes_raise_none():
    for seed in range(40):
        estimator = known()
        assert {one.contradiction for one in follow(estimator, random_pushes(seed))} == {''}


def test_a_right_model_is_not_contradicted_in_an_hour():
    # It knows that the edge stands still, of which the explanations know nothing or as much.
    noise, outlier = 0.0035, 0.001
    rng, watch = np.random.default_rng(0), Watch(noise, outlier, 0.02375, 0.0)
    for _ in range(36000):
        theta = noise * rng.standard_normal()
        if rng.random() < outlier:
            theta = rng.uniform(-1.5, 1.5)
        likely = math.exp(-0.5 * (theta / noise) ** 2) / (noise * math.sqrt(math.tau))
        density = (1.0 - outlier) * likely + outlier / math.pi
        watch.read(theta, 5e-4, theta / noise, math.log(density), 0.0)
        assert watch.reason == ''


@pytest.mark.parametrize(
    ('theta', 'reason'),
    [(lambda k: 0.0, STILL), (lambda k: 0.005 * k, OTHERWISE), (lambda k: (-1) ** k, ANYWHERE)],
)
def test_the_explanation_that_is_right_names_the_reason(theta, reason):
    # The model expects the edge somewhere else, ever farther.
    noise = 0.0035
    watch = Watch(noise, 0.001, 0.02375, 0.0)
    for k in range(1, 60):
        error = theta(k) + 0.002 * k
        density = math.exp(-0.5 * (error / noise) ** 2) / (noise * math.sqrt(math.tau))
        watch.read(theta(k), 5e-4, error / noise, math.log(density + 0.001 / math.pi), 0.0)
    assert watch.reason == reason


@pytest.mark.slow
def test_a_belt_that_stops_while_the_object_turns_is_told():
    # The object stays as it is, and the finger, which follows the law, is taken to push it on.
    told = 0
    for seed in range(24):
        rng = np.random.default_rng(seed)
        theta, d, c = rng.uniform((-0.4, -0.02, 0.005), (0.4, 0.02, 0.036))
        made = pushes(rig_of(BLOCK, 0, theta, d, c=c), 20, seed)
        estimator = ObjectEstimator(edges_of(BLOCK)[:1], NOISE, mu_c=(math.inf, math.inf))
        follow(estimator, made)
        reasons = [
            estimator.push(
                made[-1].theta + NOISE * rng.standard_normal(), made[-1].v_x, BELT, PERIOD
            ).contradiction
            for _ in range(90)
        ]
        assert set(reasons) <= {'', STILL}
        assert reasons[-1] == max(reasons)  # it stays told while the edge stands
        if abs(made[-1].theta - made[-6].theta) > 4.0 * NOISE:
            assert reasons[-1] == STILL
            told += 1
    assert told >= 5


def first_reason(made):
    return next(filter(None, (one.contradiction for one in follow(known(), made))), '')


@pytest.mark.slow
def test_a_belt_that_stops_under_the_law_is_told():
    # The law pushes ever more to the side, which no object on a moving belt explains.
    for seed in range(0, 24, 2):
        stands_from = 20 + 6 * seed
        made = pushes_by_a_tip(seed, stands_from + 80, stands_from=stands_from)
        if abs(made[stands_from].theta - math.radians(-10.0)) > math.radians(2.0):
            assert first_reason(made) == STILL
        else:  # the edge would hardly turn anyway, as it does if the finger pushes elsewhere
            assert first_reason(made) in (STILL, MOVED, '')


@pytest.mark.slow
@pytest.mark.parametrize('seed', [0, 1, 3, 4, 8, 12])
def test_a_contact_that_moves_by_itself_is_not_blamed_on_the_belt_or_the_outline(seed):
    # The belt runs and the object is the right one, but the tip turns and nobody says so. In these
    # runs, which are most, the readings look as if the finger pushed the same object elsewhere.
    made = pushes_by_a_tip(seed, turn=-13.0)
    assert first_reason(made) == MOVED
    told = known()
    for one in made:
        spin = -13.0 * one.v_x
        assert told.push(one.theta, one.v_x, BELT, one.duration, spin).contradiction == ''


def test_a_contradiction_is_doubtful_from_well_before_it_began():
    noise = 0.0035
    watch = Watch(noise, 0.001, 0.02375, 0.0)
    assert watch.doubtful == 0
    for k in range(1, 60):
        error = 0.0 if k < 30 else 0.001 * (k - 29)  # the model goes astray from reading 30 on
        density = math.exp(-0.5 * (error / noise) ** 2) / (noise * math.sqrt(math.tau))
        watch.read(0.0, 5e-4, error / noise, math.log(density + 0.001 / math.pi), 0.0)
        if watch.reason:
            break
    assert watch.reason == STILL
    assert (k - 29) / 2 < watch.doubtful - 40 <= k - 29
    watch.compare(0.0)  # nothing explains the readings better than the model that is contradicted
    assert watch.reason == STILL
    watch.compare(12.0)  # as likely as what contradicts it, which is 12 above the model
    assert (watch.reason, watch.doubtful) == (MOVED, 0)


def test_another_object_is_told():
    # Exchanged within a control period for one that lies there otherwise.
    for seed in range(6):
        first, second = random_pushes(seed, 60), random_pushes(seed + 20, 60, TRIANGLE)
        if abs(second[0].theta - first[-1].theta) > 0.1:
            estimator = known()
            follow(estimator, first)
            reasons = [one.contradiction for one in follow(estimator, second)]
            assert JUMPED in reasons[:6]


@pytest.mark.slow
def test_another_outline_is_told():
    # The plate's long edge, 1 cm from its centre of mass and pushed 2 cm from the middle, turns
    # faster than any object can that is pushed 4 cm from its centre of mass.
    reasons = []
    for seed in range(8):
        estimator = known(PLATE, 1)
        made = pushes(rig_of(PLATE, 0, 0.2 - 0.05 * seed, 0.02 * (-1) ** seed), 100, seed)
        reasons += [one.contradiction for one in follow(estimator, made)[-1:]]
    assert sum(map(bool, reasons)) >= 6
    assert set(reasons) <= set(CONTRADICTIONS)


def test_readings_that_jump_are_told():
    made, rng = random_pushes(3, 60), np.random.default_rng(0)
    estimator = known()
    follow(estimator, made[:30])
    for one in made[30:50]:
        estimate = estimator.push(rng.uniform(-1.5, 1.5), one.v_x, BELT, PERIOD)

    assert estimate.contradiction == ANYWHERE
    assert_nothing_is_known(estimate, estimator)


def test_a_contact_that_runs_off_the_edge_is_told():
    # Of an edge that ends where the contact is halfway, by rolling along.
    made = pushes(rig_of(BLOCK, 0, math.radians(20.0), -0.006), 173, 0)
    end = made[60].d
    assert made[0].d < end < made[-1].d - 0.001
    edge = Edge(0, (-0.025, end), 0.02375, 0.0)
    estimator = ObjectEstimator([edge], NOISE, mu_c=(math.inf, math.inf))

    reasons = [one.contradiction for one in follow(estimator, made)]

    assert set(reasons[:60]) == {''}
    assert next(filter(None, reasons)) == LEFT


def test_after_a_contradiction_nothing_is_known_until_readings_agree_again():
    made, rng = random_pushes(7, 300), np.random.default_rng(0)
    estimator = known()
    follow(estimator, made[:30])
    for _ in range(15):
        contradicted = estimator.push(rng.uniform(-1.5, 1.5), 0.0, BELT, PERIOD)
    assert contradicted.contradiction
    assert_nothing_is_known(contradicted, estimator)

    estimates = follow(estimator, made[30:])

    agreed = [not one.contradiction for one in estimates]
    first = agreed.index(True)
    assert first >= 39
    assert all(agreed[first:])
    for estimate, one in zip(estimates[:first], made[30:], strict=False):
        assert_nothing_is_known(estimate, estimator)
        assert estimate.theta == one.theta
    last = estimates[-1].d
    assert last.upper - last.lower < 0.01
    assert last.lower <= made[-1].d <= last.upper


def test_after_a_stop_nothing_is_known_before_the_edge_turns_again():
    probation = Probation(0.01)
    probation.contradicted(STILL, 0.2)
    assert all(probation.agreed(0.2 + 0.02 * (-1) ** k) for k in range(500))
    assert probation.reason == STILL

    assert probation.agreed(0.3)  # one reading may be wrong
    assert not probation.agreed(0.31)
    for k in range(60):
        probation.agreed(0.3 + 0.01 * k)
    assert probation.reason == ''


def test_a_model_that_is_wrong_for_good_is_not_believed_between_contradictions():
    probation = Probation(0.01)
    for _ in range(120):
        probation.agreed(0.1)
    probation.contradicted(OTHERWISE, 0.1)
    for _ in range(119):  # as long as it took before
        assert not probation.agreed(0.1)
        assert probation.reason == OTHERWISE
    probation.contradicted(JUMPED, 0.1)
    assert probation.reason == JUMPED


def test_a_disk_is_told_from_readings_that_jump():
    estimator, rng = DiskEstimator(0.0285, NOISE), np.random.default_rng(0)
    for _ in range(20):
        estimate = estimator.push(rng.uniform(-1.5, 1.5), 0.0, BELT, PERIOD)
    assert estimate.contradiction == ANYWHERE
