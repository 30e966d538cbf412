# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Contacts from readings and joint angles as they come, and what is refused (Section V.A)."""

import ast
import contextlib
import math
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import tactile_push
from tactile_push.control import PushLaw, finger_velocity
from tactile_push.pipeline.geometry import NEGATIVE_STAMP, UNREADABLE
from tactile_push.simulation import Rig, paper_block
from tactile_push.tactile import (
    NO_CONTACT,
    REFUSALS,
    ContactFinder,
    Reading,
    ReadingRejectedError,
    reading_of_contact,
)

PROPERTY = settings(derandomize=True, deadline=None, max_examples=300)
RADIUS = 0.0135
AHEAD = math.pi / 2.0
AT_POLE = Reading(0.0, AHEAD)
REASONS = {
    'not newer',
    'no joint state',
    'stale joint state',
    'direction of the finger unknown',
    'no contact',
    'off the hemisphere',
    'beyond the detectable range',
    'out of plane',
    'isolated jump',
}


def refusal(finder, reading, stamp):
    """Return the reason for which a reading is refused."""
    with pytest.raises(ReadingRejectedError) as refused:
        finder.contact(reading, stamp)
    return str(refused.value)


def outcomes(finder, readings):
    """Return theta in degrees or the reason for each of (stamp, reading)."""
    said = []
    for stamp, reading in readings:
        try:
            said.append(round(math.degrees(finder.contact(reading, stamp).theta), 6))
        except ReadingRejectedError as refused:
            said.append(str(refused))
    return said


def at(degrees):
    """Return what a finger that points straight ahead reads at an edge."""
    return reading_of_contact(math.radians(degrees), AHEAD)


def test_one_reading_gives_one_contact():
    contact = ContactFinder(RADIUS).contact(at(20.0), 123.0)
    assert math.degrees(contact.theta) == pytest.approx(20.0)
    # r n with n = (-sin 20, cos 20)
    assert (contact.x, contact.y) == pytest.approx((-0.00461727, 0.01268585), abs=1e-8)


def test_direction_of_the_finger_is_that_of_the_same_moment():
    # A finger whose two joints turn at 0.3 and 0.2 rad/s while the edge stands at 2 rad; its
    # readings come between the joint states and after the newest.
    finder = ContactFinder(RADIUS, joint_state_timeout=0.1, mount_angle=1.0)
    theta = 2.0
    for k in range(20):
        stamp = 5.0 + 0.02 * k
        assert finder.joints(stamp, (0.3 * stamp, 0.2 * stamp))
        for read in (stamp - 0.013, stamp + 0.005):
            if k > 1:
                reading = reading_of_contact(theta, 1.0 + 0.5 * read)
                assert finder.contact(reading, read).theta == pytest.approx(theta, abs=1e-9)


def test_finger_without_joint_states_refuses_until_they_come_and_when_they_stop():
    finder = ContactFinder(RADIUS, joint_state_timeout=0.1)
    assert refusal(finder, AT_POLE, 0.99) == 'no joint state'
    assert finder.joints(1.0, (0.1, 0.2))
    assert finder.contact(AT_POLE, 1.05).theta == pytest.approx(0.3)
    assert refusal(finder, AT_POLE, 1.11) == 'stale joint state'
    assert finder.joints(1.12, (0.1, 0.2))
    assert finder.contact(AT_POLE, 1.12).theta == pytest.approx(0.3)


@pytest.mark.parametrize('angles', [(math.nan, 0.0), (0.0, math.inf), (1.7e308, 1.7e308)])
def test_joint_angles_that_are_not_finite_are_of_no_use(angles):
    finder = ContactFinder(RADIUS, joint_state_timeout=0.1)
    assert not finder.joints(1.0, angles)
    assert refusal(finder, AT_POLE, 1.0) == 'no joint state'


def test_finger_that_does_not_turn_needs_no_joint_states():
    finder = ContactFinder(RADIUS, mount_angle=1.0)
    assert not finder.joints(1.0, (0.5, 0.5))
    assert finder.contact(AT_POLE, 1.0).theta == pytest.approx(1.0 - AHEAD)


@pytest.mark.parametrize(
    ('reading', 'reason'),
    [
        (NO_CONTACT, 'no contact'),
        (Reading(math.nan, 1.0), 'off the hemisphere'),
        (Reading(0.0, math.nan), 'off the hemisphere'),
        (Reading(math.inf, 1.0), 'off the hemisphere'),
        (Reading(0.0, -math.inf), 'off the hemisphere'),
        (Reading(0.0, 1.6), 'off the hemisphere'),
        (Reading(0.0, math.radians(29.0)), 'beyond the detectable range'),
        (Reading(AHEAD, math.radians(45.0)), 'out of plane'),
        (at(40.0), 'isolated jump'),
    ],
)
def test_reading_that_tells_of_no_contact_is_refused_and_the_next_is_not(reading, reason):
    finder = ContactFinder(RADIUS, detectable_range=math.radians(60.0))
    finder.contact(AT_POLE, 1.0)
    assert refusal(finder, reading, 1.02) == reason
    assert finder.contact(AT_POLE, 1.04).theta == pytest.approx(0.0, abs=1e-12)


def test_bounds_and_geometry_may_change_between_readings():
    finder = ContactFinder(RADIUS)
    finder.contact(at(70.0), 1.0)
    finder.detectable_range = math.radians(60.0)
    assert refusal(finder, at(70.0), 2.0) == 'beyond the detectable range'
    finder.detectable_range = AHEAD
    finder.radius, finder.mount_angle = 0.02, AHEAD + math.radians(10.0)
    contact = finder.contact(at(70.0), 3.0)
    assert math.degrees(contact.theta) == pytest.approx(80.0)
    assert math.hypot(contact.x, contact.y) == pytest.approx(0.02)
    finder.max_out_of_plane = 0.01
    assert refusal(finder, Reading(0.1, 0.5), 4.0) == 'out of plane'
    finder.jumps.max_rate = finder.jumps.tolerance = 0.01
    assert refusal(finder, at(60.0), 5.0) == 'isolated jump'


def test_reading_that_comes_again_is_never_a_contact():
    finder = ContactFinder(RADIUS)
    finder.contact(at(1.0), 1.0)
    finder.contact(at(2.0), 2.0)
    for stamp in (2.0, 1.0):
        assert {refusal(finder, at(1.0), stamp) for _ in range(20)} == {'not newer'}
    assert finder.contact(at(3.0), 2.02).theta == pytest.approx(math.radians(3.0))


def test_reading_without_contact_that_came_later_makes_the_one_before_old():
    finder = ContactFinder(RADIUS)
    assert outcomes(finder, [(1.0, AT_POLE), (1.1, NO_CONTACT), (1.05, AT_POLE)])[1:] == [
        'no contact',
        'not newer',
    ]


def test_old_readings_among_new_ones_are_never_contacts():
    # Somebody plays back the readings of a minute ago at twice the rate while the sensor reads.
    finder = ContactFinder(RADIUS)
    for k in range(200):
        new, old = 100.0 + 0.02 * k, 40.0 + 0.02 * k
        assert outcomes(finder, [(new, AT_POLE), (old, at(1.0)), (old + 0.01, at(1.0))]) == [
            0.0,
            'not newer',
            'not newer',
        ]


def test_clock_that_was_set_back_is_believed_at_the_third_reading():
    finder = ContactFinder(RADIUS)
    finder.contact(AT_POLE, 1000.0)
    # What was felt before is no measure for what is felt now: 40 degrees are no jump.
    readings = [(5.0 + 0.02 * k, at(40.0)) for k in range(4)]
    assert outcomes(finder, readings) == ['not newer', 'not newer', 40.0, 40.0]
    assert refusal(finder, at(40.0), 5.04) == 'not newer'


def test_clock_that_was_set_back_with_the_joint_states():
    finder = ContactFinder(RADIUS, joint_state_timeout=0.1)
    said = []
    for start in (1000.0, 5.0):
        for k in range(5):
            finder.joints(start + 0.02 * k, (0.0,))
            said += outcomes(finder, [(start + 0.02 * k + 0.001, AT_POLE)])
    assert said == 5 * [0.0] + 2 * ['not newer'] + 3 * [0.0]


def test_single_stamp_in_the_future_does_not_silence_the_sensor():
    finder = ContactFinder(RADIUS, joint_state_timeout=0.1)
    finder.joints(1.0, (0.0,))
    assert outcomes(finder, [(1.0, AT_POLE), (1e9, AT_POLE), (1.02, AT_POLE)]) == [
        0.0,
        'stale joint state',
        0.0,
    ]
    fixed = ContactFinder(RADIUS)
    readings = [(1.0, AT_POLE), (1e9, AT_POLE), (1.02, AT_POLE), (1.04, AT_POLE), (1.06, AT_POLE)]
    assert outcomes(fixed, readings) == [0.0, 0.0, 'not newer', 'not newer', 0.0]


@pytest.mark.parametrize('stamp', [math.nan, math.inf, -math.inf])
def test_stamp_that_is_not_finite_is_refused(stamp):
    finder = ContactFinder(RADIUS)
    assert {refusal(finder, AT_POLE, stamp) for _ in range(9)} == {'not newer'}
    finder.contact(AT_POLE, 0.0)


def test_readings_that_agree_on_another_place_are_believed_unless_contact_is_lost_between():
    finder = ContactFinder(RADIUS)
    felt = [0.0, 40.0, 40.0, None, 40.0, 40.0, 40.0]
    readings = [(0.02 * k, NO_CONTACT if d is None else at(d)) for k, d in enumerate(felt)]
    jump = 'isolated jump'
    assert outcomes(finder, readings) == [0.0, jump, jump, 'no contact', jump, jump, 40.0]


@pytest.mark.slow
@pytest.mark.parametrize('rate', [20.0, 50.0, 500.0])
def test_outliers_anywhere_on_the_hemisphere_do_not_get_through(rate):
    # Directions spread evenly over the hemisphere, 1 % of 50,000 readings; the others have a
    # noise of 0.5 degrees. Four of five outliers stick out of the plane of motion by more than
    # 0.2, and of the rest only those within reach of the edge's theta can pass.
    generator = np.random.default_rng(int(rate))
    finder = ContactFinder(RADIUS)
    reach = finder.jumps.tolerance + 2.0 * finder.jumps.max_rate / rate
    passed = refused = 0
    for k in range(50_000):
        theta = 0.3 * math.sin(k / rate)
        outlier = generator.random() < 0.01
        if outlier:
            elevation = math.asin(generator.random())
            reading = Reading(generator.uniform(-math.pi, math.pi), elevation)
        else:
            reading = reading_of_contact(theta + generator.normal(0.0, math.radians(0.5)), AHEAD)
        try:
            error = abs(finder.contact(reading, k / rate).theta - theta)
            passed += outlier
            assert error < reach + 0.1
        except ReadingRejectedError as reason:
            refused += outlier
            assert str(reason) in ('out of plane', 'isolated jump')
    assert 400 < passed + refused < 600
    assert passed < 0.1 * refused


def furthest_from_desired(finder):
    """Return how far theta strays from -10 degrees in the last third of a minute of pushing.

    The paper's block and gains, a finger that follows with a lag of 0.1 s, 50 readings a second
    with a noise of 0.5 degrees, 1 % outliers and 1 % dropouts.
    """
    generator = np.random.default_rng(5)
    rig = Rig(paper_block(mu_c=0.3))
    law = PushLaw(kp=0.05, kd=5.0, theta_desired=math.radians(-10.0))
    theta = commanded = v_x = furthest = 0.0
    for k in range(3000):
        stamp, psi = 0.02 * k, rig.finger_pose.psi
        finder.joints(stamp, rig.joints)
        felt = rig.theta + generator.normal(0.0, math.radians(0.5))
        chance = generator.random()
        if chance < 0.01:
            felt = psi - AHEAD + generator.uniform(-AHEAD, AHEAD)
        reading = NO_CONTACT if chance > 0.99 else reading_of_contact(felt, psi)
        with contextlib.suppress(ReadingRejectedError):
            theta = finder.contact(reading, stamp + 0.001).theta
        if k % 5 == 0:
            commanded = finger_velocity(law.update(theta), 0.005)
        v_x += (commanded - v_x) * (1.0 - math.exp(-0.02 / 0.1))
        rig.step(v_x, 0.02)
        if k >= 2000:
            furthest = max(furthest, abs(math.degrees(rig.theta) + 10.0))
    return furthest


def test_block_settles_in_spite_of_outliers_and_would_not_if_jumps_were_contacts():
    assert furthest_from_desired(ContactFinder(RADIUS, joint_state_timeout=0.1)) < 1.0
    gullible = ContactFinder(RADIUS, joint_state_timeout=0.1, jump_tolerance=math.pi)
    assert furthest_from_desired(gullible) > 4.0


numbers = st.one_of(st.floats(), st.sampled_from([0.0, -1.0, 1e9, 1.7e308, -1.7e308]))
stamps = st.one_of(numbers, st.integers(0, 40).map(lambda k: 0.02 * k))
readings = st.builds(
    Reading,
    st.one_of(numbers, st.floats(-math.pi, math.pi), st.sampled_from([0.0, math.pi])),
    st.one_of(numbers, st.floats(0.0, AHEAD), st.just(0.0)),
)
events = st.lists(
    st.one_of(
        st.tuples(stamps, st.lists(st.one_of(numbers, st.floats(-4.0, 4.0)), max_size=3)),
        st.tuples(stamps, readings),
    ),
    max_size=40,
)


@pytest.mark.slow
@given(
    events=events,
    radius=st.floats(1e-4, 1.0),
    max_out_of_plane=st.floats(0.001, 1.0),
    timeout=st.one_of(st.none(), st.floats(0.001, 10.0)),
    mount_angle=st.floats(-6.3, 6.3),
)
@PROPERTY
def test_whatever_comes_contacts_lie_on_the_disk_and_are_newer_than_those_before(
    events, radius, max_out_of_plane, timeout, mount_angle
):
    finder = ContactFinder(
        radius, max_out_of_plane, joint_state_timeout=timeout, mount_angle=mount_angle
    )
    newest, said = -math.inf, []  # since the last contact
    for stamp, what in events:
        if isinstance(what, list):
            finder.joints(stamp, what)
            continue
        try:
            contact = finder.contact(what, stamp)
        except ReadingRejectedError as reason:
            assert str(reason) in REASONS
            said.append((stamp, str(reason)))
            continue
        assert math.isfinite(contact.theta)
        assert math.hypot(contact.x, contact.y) == pytest.approx(radius, rel=1e-12)
        said.append((stamp, 'contact'))
        # The one exception: a clock that was set back, told by three readings in a row.
        set_back = any(
            a == b == 'not newer' != c and t0 < t1 < t2
            for (t0, a), (t1, b), (t2, c) in zip(said, said[1:], said[2:], strict=False)
        )
        assert stamp > newest or set_back
        newest, said = stamp, []


@pytest.mark.slow
@given(events=events)
@PROPERTY
def test_same_events_give_the_same_outcome(events):
    def run():
        finder = ContactFinder(RADIUS, joint_state_timeout=0.1)
        said = []
        for stamp, what in events:
            if isinstance(what, list):
                said.append(finder.joints(stamp, what))
            else:
                said += outcomes(finder, [(stamp, what)])
        return said

    assert run() == run()


def test_every_reason_by_which_a_reading_is_refused_has_a_number():
    said = {NEGATIVE_STAMP, UNREADABLE}  # before the finder
    for file in Path(tactile_push.__file__).parent.rglob('*.py'):
        for node in ast.walk(ast.parse(file.read_text())):
            raised = isinstance(node, ast.Call) and getattr(node.func, 'id', '')
            if raised == 'ReadingRejectedError' and isinstance(node.args[0], ast.Constant):
                said.add(node.args[0].value)
    assert said >= REASONS
    assert said == set(REFUSALS[1:])
    assert REFUSALS[0] == ''


def test_joint_angle_that_is_known_otherwise_counts_and_nothing_is_asked_of_the_past():
    turned = math.radians(12.0)
    by_history = ContactFinder(RADIUS, joint_state_timeout=0.1)
    by_history.joints(1.0, [turned])
    known = ContactFinder(RADIUS, joint_state_timeout=0.1)
    expected = by_history.contact(at(20.0), 1.0)
    assert known.contact(at(20.0), 1.0, turned) == expected
    assert known.joint_angle == by_history.joint_angle == turned


def test_joint_angle_that_nobody_knew_is_no_measure_for_the_next_reading():
    finder = ContactFinder(RADIUS, joint_state_timeout=0.1)
    with pytest.raises(ReadingRejectedError, match='no joint state'):
        finder.contact(at(20.0), 5.0, math.nan)
    assert math.isnan(finder.joint_angle)
    assert math.degrees(finder.contact(at(20.0), 1.0, 0.0).theta) == pytest.approx(20.0)


def test_finger_that_does_not_turn_has_turned_by_nothing():
    finder = ContactFinder(RADIUS)
    assert math.isnan(finder.joint_angle)
    finder.contact(at(20.0), 1.0)
    assert finder.joint_angle == 0.0
