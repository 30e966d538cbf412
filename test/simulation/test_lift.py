# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""When a finger is off its object; what that means for the object is tested with the rigs."""

import math

import pytest

from tactile_push.simulation import Faults, Servo
from tactile_push.simulation.lift import Lift


class Noted(Lift):
    """A lift that notes what it does."""

    def __init__(self, lift_delay: float) -> None:
        super().__init__()
        self.faults = Faults(servo=Servo(lift_delay=lift_delay))
        self.done: list[str] = []

    def _come_off(self) -> None:
        self.lifted = True
        self.done.append('off')

    def _touch_next(self) -> None:
        self.done.append('next')


def test_a_lift_without_a_delay_is_over_at_once_and_a_second_one_does_nothing():
    one = Noted(0.0)
    for _ in range(2):
        one.lift()
        assert (one.lifted, one.free_in, one.done) == (True, math.inf, ['off'])


def test_it_takes_the_moment_and_the_delay():
    one = Noted(0.25)
    one.lift(0.5)
    assert one.free_in == 0.75
    one._go_on_lifting(0.5)
    assert (one.lifted, one.free_in) == (False, 0.25)
    one._go_on_lifting(0.25)
    assert (one.lifted, one.done) == (True, ['off'])


@pytest.mark.parametrize('lifted', [False, True])
def test_put_down_ends_a_lift_and_only_a_lifted_finger_touches_the_next_object(lifted):
    one = Noted(0.25)
    one.lift()
    one._go_on_lifting(0.5 if lifted else 0.125)
    one.put_down()
    one._go_on_lifting(10.0)
    assert not one.lifted
    assert one.done == (['off', 'next'] if lifted else [])
