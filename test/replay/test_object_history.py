# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What single control periods sum up to, by hand."""

import math

import pytest

from tactile_push.control import PUSHING, STOPPED
from tactile_push.estimation import CONTRADICTIONS
from tactile_push.paper import BLOCK, FIGURE_9, OTHER
from tactile_push.pipeline import Sensed
from tactile_push.replay.object_history import Contradiction, Forgotten, ObjectHistory

START = 50 * 10**9  # of the bag [ns]
EDGE = 0.025  # half of it [m]
THETA_DESIRED = math.radians(-10.0)


def stamp(time):
    """Return the stamp of a time since the start of the bag."""
    return divmod(START + round(time * 1e9), 10**9)


def sensed(time, d=math.nan, half=EDGE, bound=EDGE, contradiction=0, forgot='', age=0.0):
    """Return what a control period told: d and half of its intervals [m]."""
    middle = 0.0 if math.isnan(d) else d
    values = {
        'd': d,
        'd_lower': middle - half,
        'd_upper': middle + half,
        'd_least': middle - bound,
        'd_most': middle + bound,
        'contradiction': float(contradiction),
        'age': age,
    }
    return Sensed(stamp(time), values, None, not math.isnan(d), forgot, has_pose=False, blind=False)


@pytest.fixture
def history():
    return ObjectHistory('left', START, True, OTHER)


def test_nothing_comes_to_nothing(history):
    figures = history.figures()
    assert (figures.finger, figures.ticks, figures.readings) == ('left', [], 0)
    assert figures.values is figures.at is figures.known_step is figures.inside is None
    assert figures.contradictions == figures.forgotten == []


def test_last_that_was_known_stays_when_it_is_forgotten(history):
    history.add(PUSHING, THETA_DESIRED, sensed(0.1, 0.001, 0.002))
    history.add(PUSHING, THETA_DESIRED, sensed(0.2, 0.002, 0.001))
    history.add(STOPPED, THETA_DESIRED, sensed(0.3, forgot='contact lost'))
    figures = history.figures()
    assert figures.at == pytest.approx(0.2)
    assert figures.values['d'] == 0.002
    assert figures.forgotten == [Forgotten('contact lost', pytest.approx(0.3))]
    assert figures.readings == 2
    # The finger was held when it was forgotten, and did not push again.
    assert figures.known_step == 1


def test_what_was_forgotten_while_pushing_was_not_known_for_good(history):
    history.add(PUSHING, THETA_DESIRED, sensed(0.1, 0.001, 0.0005))
    history.add(PUSHING, THETA_DESIRED, sensed(0.2, forgot='ticks missing'))
    assert history.figures().known_step is None


def test_contradictions_last_from_the_first_to_the_next_that_agrees(history):
    for k, kind in enumerate([0, 3, 3, 0, 1, 2, 2]):
        history.add(PUSHING, THETA_DESIRED, sensed(0.1 * k, contradiction=kind))
    assert history.figures().contradictions == [
        Contradiction(CONTRADICTIONS[3], pytest.approx(0.1), pytest.approx(0.2), True),
        Contradiction(CONTRADICTIONS[1], pytest.approx(0.4), pytest.approx(0.1), True),
        Contradiction(CONTRADICTIONS[2], pytest.approx(0.5), pytest.approx(0.1), False),
    ]


def test_truth_is_compared_at_the_moments_of_the_readings(history):
    # The true d goes through 0 at 1 s with 1 mm/s, and is told twice a second.
    for k in range(5):
        history.truth(stamp(0.5 * k), {'d': 0.001 * (0.5 * k - 1.0)})
    history.add(PUSHING, THETA_DESIRED, sensed(0.9))  # nothing is claimed
    history.add(PUSHING, THETA_DESIRED, sensed(1.0, 0.0, 0.00005, 0.0002, age=0.1))
    history.add(PUSHING, THETA_DESIRED, sensed(1.1, 0.0001, 0.00005, 0.0002))
    history.add(PUSHING, THETA_DESIRED, sensed(1.2, 0.0, 0.00005, 0.0002, age=0.25))
    history.add(PUSHING, THETA_DESIRED, sensed(1.3, 0.0, 0.00005, 0.0002))
    history.add(PUSHING, THETA_DESIRED, sensed(2.5, 0.0015))  # the simulator is silent
    figures = history.figures()
    assert figures.compared == 4
    # Off by 0.1, 0, 0.05 and 0.3 mm.
    assert figures.inside == pytest.approx(0.5)
    assert figures.inside_guaranteed == pytest.approx(0.75)


def test_truth_may_come_later_than_what_is_compared(history):
    history.add(PUSHING, THETA_DESIRED, sensed(1.0, 0.002, 0.0001))
    for time in (1.5, 0.5):
        history.truth(stamp(time), {'d': 0.002, 'theta': 0.1})
    history.truth(stamp(0.7), {'theta': 0.1})
    figures = history.figures()
    assert (figures.compared, figures.inside, figures.inside_guaranteed) == (1, 1.0, 1.0)


@pytest.mark.parametrize(
    ('pushed', 'theta_desired', 'paper'),
    [(BLOCK, THETA_DESIRED, FIGURE_9), (BLOCK, 0.1, None), (OTHER, THETA_DESIRED, None)],
)
def test_paper_stands_beside_its_own_experiment_alone(pushed, theta_desired, paper):
    history = ObjectHistory('', START, True, pushed)
    history.add(PUSHING, theta_desired, sensed(0.1, 0.001, 0.002))
    assert history.figures().paper is paper
