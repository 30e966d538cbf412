# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What moves the finger, and when it stands."""

import math

import pytest

from tactile_push.simulation import JointRig, Rig, paper_block
from tactile_push.simulation.commanded import CommandedJoints, CommandedVelocity


@pytest.fixture
def across():
    rig = Rig(paper_block())
    return rig, CommandedVelocity(rig, 0.5)


@pytest.fixture
def joints():
    rig = JointRig(paper_block())
    return rig, CommandedJoints(rig)


def test_the_belt_stands_until_the_first_command(across):
    rig, commanded = across
    commanded.move(0.1, 0.1)
    assert not commanded.started
    assert rig.belt_travel == 0.0
    assert commanded.take(0.0, 0.0, 0.1, 0.1) == 'commands'
    commanded.move(0.1, 0.2)
    assert rig.belt_travel == pytest.approx(0.0005)


def test_the_belt_may_press_the_object_before(across, joints):
    for rig, commanded in (across, joints):
        commanded.move(0.1, 0.1, presses=True)
        assert not commanded.started
        assert rig.belt_travel == pytest.approx(0.0005)


@pytest.mark.parametrize(
    ('v_x', 'obeyed', 'kind'),
    [
        (0.01, 0.01, 'commands'),
        (5.0, 0.1, 'commands too fast'),
        (-5.0, -0.1, 'commands too fast'),
        (math.nan, 0.0, 'commands not finite'),
        (-math.inf, 0.0, 'commands not finite'),
    ],
)
def test_a_velocity_is_bounded_both_ways(across, v_x, obeyed, kind):
    _, commanded = across
    stands = 0.0 if kind == 'commands not finite' else 0.02
    for axes in (0, 1):
        commanded.take(0.02, 0.02, 0.1, 0.0)
        wanted = (v_x, 0.02) if axes == 0 else (0.02, v_x)
        assert commanded.take(*wanted, 0.1, 0.0) == kind
        got = commanded.v_x, commanded.v_y
        assert got == ((obeyed, stands) if axes == 0 else (stands, obeyed))


def test_a_finger_moves_along_the_belt_too(across):
    rig, commanded = across
    commanded.take(0.0, -0.02, 0.1, 0.0)
    commanded.move(0.1, 0.1)
    assert rig.along == pytest.approx(-0.002)
    assert not rig.touching


def test_a_velocity_ends_exactly_with_its_timeout(across):
    rig, commanded = across
    commanded.take(0.01, -0.001, 0.1, 1.0)
    assert not commanded.overdue(1.499)
    commanded.move(0.1, 1.499)
    assert (rig.v_x, rig.v_along) == (0.01, -0.001)
    assert commanded.overdue(1.5)
    commanded.move(0.1, 1.5)
    assert (rig.v_x, rig.v_along) == (0.0, 0.0)
    commanded.take(0.01, -0.001, 0.1, 2.0)
    commanded.expire()
    commanded.move(0.1, 2.1)
    assert (rig.v_x, rig.v_along) == (0.0, 0.0)


def test_velocities_of_joints_stay_in_force(joints):
    rig, commanded = joints
    assert commanded.take((0.0, -0.1), 0.1) == 'commands'
    assert commanded.v_x == pytest.approx(0.008)
    commanded.move(0.1, 100.0)
    commanded.expire()
    commanded.move(0.1, 200.0)
    assert not commanded.overdue(200.0)
    assert rig.finger_x == pytest.approx(0.0016, rel=0.01)
    assert rig.belt_travel == pytest.approx(0.001)


def test_zeros_of_a_servo_that_waits_do_not_start_the_belt(joints):
    rig, commanded = joints
    commanded.take((0.0, 0.0), 0.1)
    commanded.move(0.1, 0.1)
    assert not commanded.started
    assert rig.belt_travel == 0.0


@pytest.mark.parametrize(
    ('rates', 'v_x', 'kind'),
    [
        ((0.0, -2.5), 0.1, 'commands too fast'),  # half of 20 cm/s
        ((0.0, math.nan), 0.0, 'commands not finite'),
        ((math.inf, 0.0), 0.0, 'commands not finite'),
        ((0.1,), 0.008, 'commands of another size'),
        ((0.1, 0.2, 0.3), 0.008, 'commands of another size'),
        ((), 0.008, 'commands of another size'),
    ],
)
def test_velocities_of_joints_are_bounded_and_those_of_others_ignored(joints, rates, v_x, kind):
    _, commanded = joints
    commanded.take((0.0, -0.1), 0.1)
    assert commanded.take(rates, 0.1) == kind
    assert commanded.v_x == pytest.approx(v_x)
