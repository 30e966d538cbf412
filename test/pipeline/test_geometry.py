# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What becomes of each reading and joint state, and what is said of a reading."""

import math

import pytest

from tactile_push.interface import CONTACT, FINGER_DISK, GEOMETRY_STATE
from tactile_push.pipeline import Geometry
from tactile_push.pipeline.geometry import (
    NEGATIVE_STAMP,
    OTHER_JOINTS,
    REFUSED,
    TAKEN,
    UNREADABLE,
)
from tactile_push.tactile import REFUSALS, ContactFinder

JOINTS = ['proximal_joint', 'distal_joint']
ANGLES = ['azimuth', 'elevation']
R = 0.0135  # [m]
POLE = [0.0, math.pi / 2.0]  # a reading of a contact where the finger tip points


def seconds(sec, nanosec):
    return sec + nanosec * 1e-9


@pytest.fixture
def geometry():
    """Return the step for a finger whose tip turns with its joints."""
    return Geometry(ContactFinder(R, joint_state_timeout=0.1), JOINTS, seconds)


@pytest.mark.parametrize(
    ('names', 'positions', 'outcome'),
    [
        (JOINTS, [0.1, 0.2], TAKEN),
        (['other', *JOINTS], [7.0, 0.1, 0.2], TAKEN),
        (JOINTS, [0.1, math.nan], REFUSED),
        (JOINTS, [0.1], OTHER_JOINTS),
        (['other', JOINTS[0]], [0.1, 0.2], OTHER_JOINTS),
        ([*JOINTS, JOINTS[0]], [0.1, 0.2, 0.1], OTHER_JOINTS),
    ],
)
def test_joint_state_says_what_it_was(geometry, names, positions, outcome):
    assert geometry.joint_states((1, 0), names, positions) == outcome


def test_contact_turns_with_the_joints(geometry):
    geometry.joint_states((1, 0), JOINTS, [0.25, -0.05])
    felt = geometry.tactile((1, 0), ['other', *ANGLES], [7.0, *POLE])
    assert (felt.stamp, felt.refusal) == ((1, 0), '')
    assert felt.joint_angle == pytest.approx(0.2)
    # At rest the tip points along +y, at an edge of angle 0.
    assert felt.contact.theta == pytest.approx(0.2)
    assert (felt.contact.x, felt.contact.y) == pytest.approx(
        (-R * math.sin(0.2), R * math.cos(0.2))
    )


def test_joint_angle_that_is_known_otherwise_comes_first(geometry):
    geometry.joint_states((1, 0), JOINTS, [0.25, -0.05])
    assert geometry.tactile((1, 0), ANGLES, POLE, 0.3).contact.theta == pytest.approx(0.3)
    assert geometry.tactile((2, 0), ANGLES, POLE, math.nan).refusal == 'no joint state'


@pytest.mark.parametrize(
    ('stamp', 'names', 'positions', 'refusal'),
    [
        ((1, 0), ['azimuth', 'force'], POLE, UNREADABLE),
        ((1, 0), ANGLES, POLE[:1], UNREADABLE),
        ((-1, 0), ANGLES, POLE, NEGATIVE_STAMP),
        ((1, 0), ANGLES, [math.nan, math.nan], 'no contact'),
        ((2, 0), ANGLES, POLE, 'stale joint state'),
    ],
)
def test_reading_that_tells_of_no_contact_is_refused_with_its_reason(
    geometry, stamp, names, positions, refusal
):
    geometry.joint_states((1, 0), JOINTS, [0.0, 0.0])
    felt = geometry.tactile(stamp, names, positions)
    assert (felt.stamp, felt.contact, felt.refusal) == (stamp, None, refusal)
    ((topic, state),) = felt.outputs()
    assert topic == GEOMETRY_STATE
    values = dict(zip(state['name'], state['position'], strict=True))
    assert values['refusal'] == REFUSALS.index(refusal)
    assert math.isnan(values['theta'])


def test_contact_comes_after_what_became_of_the_reading(geometry):
    """A recording that has what followed from a contact then has the reading, wherever it ends."""
    geometry.joint_states((1, 5), JOINTS, [0.0, 0.0])
    (state_topic, state), (contact_topic, contact) = geometry.tactile(
        (1, 5), ANGLES, POLE
    ).outputs()
    assert (state_topic, contact_topic) == (GEOMETRY_STATE, CONTACT)
    stamp = {'sec': 1, 'nanosec': 5}
    assert contact['header'] == {'stamp': stamp, 'frame_id': FINGER_DISK}
    assert contact['pose']['position'] == pytest.approx({'x': 0.0, 'y': R})
    assert contact['pose']['orientation'] == pytest.approx({'z': 0.0, 'w': 1.0})
    assert state['header']['stamp'] == stamp
    values = dict(zip(state['name'], state['position'], strict=True))
    assert values == pytest.approx(
        {'azimuth': 0.0, 'elevation': POLE[1], 'joint_angle': 0.0, 'theta': 0.0, 'refusal': 0.0}
    )
