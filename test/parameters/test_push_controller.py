# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The control that the parameters of `push_controller` make."""

import math
from dataclasses import replace

import pytest

from tactile_push.control import Steadying, Steering
from tactile_push.interface import PLACE, PUSH, STEER
from tactile_push.parameters import PushControllerParameters
from tactile_push.parameters.push_controller import (
    check_fit,
    choose_law,
    make_control,
    make_finger,
    take_values,
)
from tactile_push.pipeline import Control

# Each number that may change while the node runs, and where it has to arrive.
VALUES = {
    'kp': (0.1, lambda control: control.law.kp),
    'kd': (2.0, lambda control: control.law.kd),
    'theta_desired': (0.3, lambda control: control.law.theta_desired),
    'steadying_max': (0.2, lambda control: control.steadying.bound),
    'contact_timeout': (0.7, lambda control: control.limits.contact_timeout),
    'max_ticks_lost': (5, lambda control: control.limits.max_ticks_lost),
    'max_speed': (0.03, lambda control: control.limits.max_speed),
    'max_acceleration': (0.2, lambda control: control.limits.max_acceleration),
    'joint_state_timeout': (0.9, lambda control: control.limits.joint_state_timeout),
}
# And those that are fixed.
FIXED = {
    'phi_min': (0.7, lambda control: control.law.phi_min),
    'phi_max': (2.0, lambda control: control.law.phi_max),
    'edge_distance': (0.04, lambda control: control.steadying.l),
    'finger_radius': (0.01, lambda control: control.steadying.r),
    'belt_speed': (0.008, lambda control: control.belt_speed),
    'workspace_min': (-0.2, lambda control: control.limits.workspace_min),
    'workspace_max': (0.3, lambda control: control.limits.workspace_max),
}


def test_every_number_that_may_change_is_tested_here():
    changeable = {p.name for p in PushControllerParameters.declared() if not p.read_only}
    assert changeable == {*VALUES, 'law'}  # which counts from the next activation on


@pytest.mark.parametrize('name', VALUES | FIXED)
def test_each_number_arrives_at_the_start(name):
    value, place = (VALUES | FIXED)[name]
    assert place(make_control(PushControllerParameters())) != value
    assert place(make_control(PushControllerParameters(**{name: value}))) == value


@pytest.mark.parametrize('name', VALUES)
def test_a_number_may_change_while_the_control_runs(name):
    value, place = VALUES[name]
    control = make_control(PushControllerParameters())
    take_values(control, PushControllerParameters(**{name: value}))
    assert place(control) == value


def test_the_period_is_that_of_the_rate():
    assert make_control(PushControllerParameters(control_rate=20.0)).period == 0.05


def test_the_finger_has_the_links_of_the_parameters():
    straight = make_finger(PushControllerParameters(proximal_length=0.05, distal_length=0.1))
    # Mounted straight ahead: the first joint at a right angle brings the disk to the left.
    assert straight.forward(0.0, 0.0).x == pytest.approx(0.0, abs=1e-15)
    assert straight.forward(math.pi / 2.0, 0.0).x == pytest.approx(-0.15)
    assert straight.forward(0.0, -math.pi / 2.0).x == pytest.approx(0.1)


@pytest.mark.parametrize('names', [[], ['one'], ['one', 'one'], ['one', 'two', 'one']])
def test_a_finger_without_two_joints_is_refused(names):
    with pytest.raises(ValueError, match='joint_names: expected two or three different names'):
        make_control(PushControllerParameters(joint_names=names))


@pytest.mark.parametrize(('desired', 'trim'), [(1.2, 0.4), (-1.2, 0.4), (1.01, 0.5)])
def test_an_angle_that_could_be_trimmed_to_that_of_an_edge_that_faces_away_is_refused(
    desired, trim
):
    p = PushControllerParameters(theta_desired=desired, steadying_max=trim)
    with pytest.raises(ValueError, match=r'theta_desired: expected -1\.?\d* to 1\.?\d* rad'):
        make_control(p)


@pytest.mark.parametrize(('desired', 'trim'), [(1.5, 0.0), (-1.0, 0.5), (1.1, 0.375)])
def test_an_angle_that_stays_within_reach_is_taken(desired, trim):
    check_fit(PushControllerParameters(theta_desired=desired, steadying_max=trim))


def test_an_empty_workspace_is_refused():
    with pytest.raises(ValueError, match='workspace_min: expected less than workspace_max'):
        make_control(PushControllerParameters(workspace_min=0.1, workspace_max=0.1))


@pytest.mark.parametrize(('law', 'trims'), [(PLACE, Steadying), (STEER, Steering)])
def test_the_law_is_chosen_anew(law, trims):
    p = PushControllerParameters(law=law, edge_distance=0.03, finger_radius=0.01)
    steps = Control(make_control(p), make_finger(p), p.joint_names, lambda sec, nanosec: sec)
    choose_law(steps, p, lambda sec, nanosec: sec)
    push = steps.push
    assert steps.placing is not None
    assert isinstance(push.steadying, trims)
    assert (push.steadying.l, push.steadying.r) == (0.03, 0.01)
    choose_law(steps, PushControllerParameters(law=PUSH, kp=0.3), lambda sec, nanosec: sec)
    assert steps.placing is None
    assert isinstance(push.steadying, Steadying)
    assert push.law.kp == 0.3


def test_only_a_finger_of_two_axes_goes_back():
    one = PushControllerParameters(law=PLACE, retreat_max=0.03)
    two = replace(one, axes=2)
    assert [make_control(p).limits.retreat_max for p in (one, two)] == [0.0, 0.03]


def test_a_finger_of_two_axes_has_to_be_faster_than_the_belt():
    make_control(PushControllerParameters(belt_speed=0.03))
    with pytest.raises(ValueError, match='max_speed: expected more than belt_speed, 0.03 m/s'):
        make_control(PushControllerParameters(belt_speed=0.03, axes=2))


@pytest.mark.parametrize(
    ('given', 'refusal'),
    [
        ({'use_joint_states': False}, 'use_joint_states: expected true with law place, got false'),
        ({'steadying_max': 0.1}, 'steadying_max: expected 0 with law place, got 0.1'),
    ],
)
def test_what_cannot_place_is_refused(given, refusal):
    make_control(PushControllerParameters(**given))
    with pytest.raises(ValueError, match=refusal):
        make_control(PushControllerParameters(law=PLACE, **given))


@pytest.mark.parametrize(
    ('given', 'refusal'),
    [
        ({'use_joint_states': False}, 'use_joint_states: expected true with law steer'),
        ({'steadying_max': 0.1}, 'steadying_max: expected 0 with law steer, got 0.1'),
    ],
)
def test_what_does_not_fit_the_law_that_steers_is_refused(given, refusal):
    with pytest.raises(ValueError, match=refusal):
        check_fit(PushControllerParameters(law=STEER, **given))
