# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Whatever a contact geometry heard, and in whichever order, its contacts come out again."""

import math
from types import SimpleNamespace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tactile_push.parameters.contact_geometry import ContactGeometryParameters, make_finder
from tactile_push.pipeline.stamps import epoch_of, seconds_since
from tactile_push.replay.geometry import ReplayedGeometry
from tactile_push.tactile import REFUSALS, Reading, ReadingRejectedError

CHECKED = settings(derandomize=True, deadline=None, max_examples=150)
BEGIN = 1_795_000_000  # some day in 2026 [s]
EPOCH = epoch_of(BEGIN)
JOINTS = ('proximal_joint', 'distal_joint')
AHEAD = math.pi / 2.0


def message(names, position, nanoseconds):
    sec, nanosec = divmod(nanoseconds, 10**9)
    header = SimpleNamespace(stamp=SimpleNamespace(sec=sec, nanosec=nanosec))
    return SimpleNamespace(header=header, name=list(names), position=list(position))


def stamp(nanoseconds):
    return BEGIN * 10**9 + nanoseconds


class Live:
    """A contact geometry as its node runs it, and what a bag would hold of it."""

    def __init__(self, **given):
        self.finder = make_finder(ContactGeometryParameters.of(given))
        self.tactile, self.joints, self.states = [], [], []
        self.outcomes = []

    def turn(self, angles, nanoseconds):
        self.finder.joints(seconds_since(EPOCH, *divmod(stamp(nanoseconds), 10**9)), angles)
        self.joints.append(message(JOINTS, angles, stamp(nanoseconds)))

    def read(self, azimuth, elevation, nanoseconds):
        at = divmod(stamp(nanoseconds), 10**9)
        theta, refusal = math.nan, ''
        try:
            contact = self.finder.contact(Reading(azimuth, elevation), seconds_since(EPOCH, *at))
            theta = contact.theta
        except ReadingRejectedError as reason:
            refusal = str(reason)
        self.outcomes.append((at, repr(theta), refusal))
        self.tactile.append(
            message(('azimuth', 'elevation'), (azimuth, elevation), stamp(nanoseconds))
        )
        state = {
            'azimuth': azimuth,
            'elevation': elevation,
            'joint_angle': self.finder.joint_angle,
            'theta': theta,
            'refusal': float(REFUSALS.index(refusal)),
        }
        self.states.append(message(state, state.values(), stamp(nanoseconds)))


def geometry_of(**given):
    return ReplayedGeometry(ContactGeometryParameters.of(given), EPOCH)


def outcome(felt):
    theta = math.nan if felt.contact is None else felt.contact.theta
    return felt.stamp, repr(theta), felt.refusal


STEPS = st.lists(
    st.one_of(
        st.tuples(
            st.just('read'),
            st.floats(-0.4, 0.4),
            st.one_of(st.floats(0.3, 1.5), st.just(math.nan)),
            st.integers(-20, 60),
        ),
        st.tuples(st.just('turn'), st.floats(-0.3, 0.3), st.integers(-30, 60)),
    ),
    min_size=5,
    max_size=60,
)


@CHECKED
@given(steps=STEPS)
def test_what_the_node_took_comes_out_again_to_the_bit_in_its_own_order(steps):
    live = Live()
    live.turn([0.05, 0.0], 0)
    live.read(0.0, AHEAD, 1_000_000)
    now = 10_000_000
    for what, *how in steps:
        now += 10_000_000
        if what == 'read':
            live.read(*how[:2], now + how[2] * 1_000_000)
        else:
            live.turn([how[0], 0.01], now + how[1] * 1_000_000)
    geometry = geometry_of()
    assert [outcome(geometry.state(state)) for state in live.states] == live.outcomes


def test_a_bag_that_begins_with_refused_readings_begins_with_the_first_that_was_not():
    live = Live()
    live.read(0.0, AHEAD, 0)  # the joints are not known
    live.turn([0.05, 0.0], 5_000_000)
    live.read(0.0, AHEAD, 10_000_000)
    geometry = geometry_of()
    first, second = map(geometry.state, live.states)
    assert first is None
    assert outcome(second) == live.outcomes[1]


def test_without_a_record_readings_and_joints_are_taken_as_they_come():
    live = Live()
    geometry = geometry_of()
    felt = []
    for k in range(50):
        live.turn([0.01 * k, 0.0], 20_000_000 * k)
        turned = live.joints[-1]
        at = turned.header.stamp.sec, turned.header.stamp.nanosec
        geometry.step.joint_states(at, turned.name, turned.position)
        live.read(0.0, AHEAD, 20_000_000 * k + 7_000_000)
        felt.append(geometry.tactile(live.tactile[-1]))
    assert [outcome(one) for one in felt] == live.outcomes
    assert not any(one.refusal for one in felt)


def test_messages_of_something_else_are_refused_like_by_the_node():
    geometry = geometry_of(use_joint_states=False)
    felt = geometry.tactile(message(('force',), (1.0,), stamp(0)))
    assert felt.refusal == 'no azimuth and elevation'
    felt = geometry.tactile(message(('azimuth', 'elevation'), (0.0, AHEAD), -(10**9)))
    assert felt.refusal == 'negative stamp'


def test_parameters_that_change_take_effect():
    geometry = geometry_of(use_joint_states=False)
    before = geometry.tactile(message(('azimuth', 'elevation'), (0.0, AHEAD), stamp(0)))
    geometry.change({'finger_radius': 0.027})
    after = geometry.tactile(message(('azimuth', 'elevation'), (0.0, AHEAD), stamp(10**7)))
    assert after.contact.x == pytest.approx(2.0 * before.contact.x, rel=1e-14)
