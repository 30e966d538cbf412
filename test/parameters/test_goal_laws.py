# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Laws with goals that the parameters of `push_controller` make."""

import math
from dataclasses import replace

import pytest

from tactile_push.interface import PLACE, SETTLE, STEER
from tactile_push.parameters import PushControllerParameters
from tactile_push.parameters.goal_laws import give_law
from tactile_push.parameters.push_controller import make_control, take_values
from tactile_push.pipeline.placing import Placing
from tactile_push.pipeline.settling import Settling
from tactile_push.pipeline.steering import Carrying

LASTING = pytest.mark.parametrize(('law', 'serving'), [(STEER, Carrying), (SETTLE, Settling)])


def given(p):
    """Return a control with the law that the parameters name, and who serves its goals."""
    push = make_control(p)
    return push, give_law(push, p, lambda sec, nanosec: sec)


@pytest.mark.parametrize(
    ('law', 'serving'), [(PLACE, Placing), (STEER, Carrying), (SETTLE, Settling)]
)
def test_a_law_goes_no_faster_than_the_finger(law, serving):
    push, placing = given(PushControllerParameters(law=law, belt_speed=0.02, max_speed=0.01))
    assert isinstance(placing, serving)
    # The finger gets as far aside as half the belt's way at the most.
    assert 1.0 / math.tan(push.law.phi_min) == pytest.approx(0.5)
    assert 1.0 / math.tan(push.law.phi_max) == pytest.approx(-0.5)


def test_the_law_that_places_gets_its_belt():
    push, _ = given(PushControllerParameters(law=PLACE, belt_length=0.2))
    assert push.law.belt == 0.2


@LASTING
def test_a_law_whose_goals_last_gets_the_numbers_of_law_18(law, serving):
    values = PushControllerParameters(law=law, kp=0.1, kd=2.0, theta_desired=0.3)
    push, placing = given(values)
    assert isinstance(placing, serving)
    assert (push.law.kp, push.law.kd, push.law.aim) == (0.1, 2.0, 0.3)
    take_values(push, replace(values, theta_desired=0.2))
    assert push.law.aim == 0.2
