# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The node between sensor and controller: messages as they should not be, and its health."""

import math
from types import SimpleNamespace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

rclpy = pytest.importorskip('rclpy')

from geometry_msgs.msg import PoseStamped  # noqa: E402
from rclpy.parameter import Parameter as RosParameter  # noqa: E402
from sensor_msgs.msg import JointState  # noqa: E402

from tactile_push.nodes import contact_geometry  # noqa: E402
from tactile_push.nodes.contact_geometry import ContactGeometry  # noqa: E402
from tactile_push.nodes.ros.diagnostics import ERROR, OK, WARN  # noqa: E402
from tactile_push.tactile import REFUSALS  # noqa: E402
from tactile_push.testing.processes import claim_domain  # noqa: E402

PROPERTY = settings(derandomize=True, deadline=None, max_examples=100)
AHEAD = math.pi / 2.0
JOINTS = ['proximal_joint', 'distal_joint']


class Bench:
    """A node, a steady clock that the test turns, and what the node publishes."""

    def __init__(self, monkeypatch):
        self.now = 1000.0
        monkeypatch.setattr(contact_geometry, 'time', SimpleNamespace(monotonic=lambda: self.now))
        self.node = ContactGeometry()
        self.sent = []
        self.node._contact = SimpleNamespace(msg_type=PoseStamped, publish=self._keep)
        self.listeners = 0
        self.told = []
        self.node._state = SimpleNamespace(
            msg_type=JointState,
            publish=self.told.append,
            get_subscription_count=lambda: self.listeners,
        )

    def _keep(self, pose):
        stamp, place, turn = pose.header.stamp, pose.pose.position, pose.pose.orientation
        self.sent.append((stamp.sec, stamp.nanosec, place.x, place.y, turn.z, turn.w))

    def read(self, names=('azimuth', 'elevation'), position=(0.0, AHEAD), sec=None, nanosec=0):
        self.node._on_tactile(message(names, position, self.sec if sec is None else sec, nanosec))

    def turn(self, names=JOINTS, position=(0.0, 0.0), sec=None, nanosec=0):
        sec = self.sec if sec is None else sec
        self.node._on_joint_states(message(names, position, sec, nanosec))

    @property
    def sec(self):
        return int(self.now)

    @property
    def health(self):
        health = self.node._health()
        return health.level, health.message


def message(names, position, sec, nanosec):
    result = JointState(name=list(names), position=list(position))
    result.header.stamp.sec, result.header.stamp.nanosec = sec, nanosec
    return result


@pytest.fixture(scope='module')
def ros():
    domain, lock = claim_domain()
    rclpy.init(domain_id=domain)
    yield
    rclpy.shutdown()
    lock.close()


@pytest.fixture
def bench(ros, monkeypatch):
    bench = Bench(monkeypatch)
    yield bench
    bench.node.destroy_node()


def rejected(bench):
    counted = bench.node._counted
    return {k.removeprefix('rejected: '): n for k, n in counted.items() if 'rejected' in k}


def test_contact_has_the_stamp_of_the_reading_to_the_nanosecond(bench):
    bench.turn(sec=7, nanosec=100)
    bench.read(sec=7, nanosec=123456789)
    assert rejected(bench) == {'stale joint state': 1}
    bench.read(sec=7, nanosec=101)
    assert bench.sent == [(7, 101, pytest.approx(0.0, abs=1e-12), 0.0135, 0.0, 1.0)]


def test_readings_a_microsecond_apart_are_two(bench):
    # In seconds since 1970 alone, a double would not tell 100 ns apart.
    later = bench.node.get_clock().now().nanoseconds // 10**9 + 3000
    bench.turn(sec=later)
    for nanosec in (1, 2, 3, 3):
        bench.read(sec=later, nanosec=nanosec)
    assert [nanosec for _, nanosec, *_ in bench.sent] == [1, 2, 3]
    assert rejected(bench) == {'not newer': 1}


@pytest.mark.parametrize(
    ('names', 'position'),
    [
        ([], []),
        (['azimuth'], [0.0]),
        (['azimuth', 'elevation'], []),
        (['azimuth', 'elevation'], [0.0]),
        (['azimut', 'elevation'], [0.0, 1.0]),
        ([''], [0.0, 1.0, 2.0]),
    ],
)
def test_message_without_both_angles_is_counted(bench, names, position):
    bench.turn()
    bench.read(names, position)
    assert rejected(bench) == {'no azimuth and elevation': 1}
    bench.read()
    assert len(bench.sent) == 1


def test_order_of_names_and_other_fields_are_no_matter(bench):
    bench.turn(['x', *reversed(JOINTS)], [9.0, 0.1, 0.2])
    bench.read(['normal_force', 'elevation', 'azimuth'], [math.nan, AHEAD, 0.0])
    z, w = bench.sent[0][4:]
    assert 2.0 * math.atan2(z, w) == pytest.approx(0.3)


def test_negative_stamp_gives_no_contact(bench):
    bench.turn(sec=-5)
    bench.read(sec=-5)
    assert rejected(bench) == {'negative stamp': 1}


@pytest.mark.parametrize(
    ('names', 'position', 'name'),
    [
        (['wheel'], [0.0], 'joint states of other joints'),
        (JOINTS[:1], [0.0], 'joint states of other joints'),
        (JOINTS, [0.0], 'joint states of other joints'),
        (JOINTS, [0.0, math.nan], 'joint states refused'),
        (JOINTS, [-math.inf, 0.0], 'joint states refused'),
    ],
)
def test_joint_states_of_no_use_are_counted(bench, names, position, name):
    bench.turn(names, position)
    assert bench.node._counted[name] == 1
    bench.read()
    assert rejected(bench) == {'no joint state': 1}


names = st.lists(st.sampled_from(['azimuth', 'elevation', *JOINTS, '', 'ä']), max_size=5)
numbers = st.one_of(st.floats(), st.sampled_from([0.0, AHEAD, math.nan, math.inf]))
seconds = st.one_of(st.integers(-(2**31), 2**31 - 1), st.integers(998, 1002))
messages = st.tuples(
    st.booleans(),
    st.one_of(names, st.just(['azimuth', 'elevation']), st.just(JOINTS)),
    st.lists(numbers, max_size=5),
    seconds,
    st.integers(0, 2**32 - 1),
)


@given(messages=st.lists(messages, max_size=30))
@PROPERTY
def test_whatever_the_messages_nothing_is_raised_and_all_are_counted(ros, messages):
    with pytest.MonkeyPatch.context() as monkeypatch:
        bench = Bench(monkeypatch)
        for joints, *fields in messages:
            (bench.turn if joints else bench.read)(*fields)
            bench.health  # noqa: B018
        counted = bench.node._counted
        assert counted['readings'] == sum(not joints for joints, *_ in messages)
        assert counted['readings'] == counted['contacts'] + sum(rejected(bench).values())
        assert len(bench.sent) == counted['contacts']
        for sec, _, *place in bench.sent:
            assert sec >= 0
            assert all(map(math.isfinite, place))
            assert math.hypot(*place[:2]) == pytest.approx(0.0135)
        bench.node.destroy_node()


def test_silence_is_an_error_after_a_while(bench):
    bench.now += 0.6
    assert bench.health == (WARN, 'no readings yet')
    bench.turn()
    bench.read()
    assert bench.health == (OK, 'contact')
    bench.now += 0.6
    assert bench.health == (ERROR, 'no readings')


def test_finger_in_the_air_is_well(bench):
    bench.turn()
    bench.read(position=(math.nan, math.nan))
    assert bench.health == (OK, 'no contact')
    bench.node._diagnostics.report()
    assert bench.health == (OK, 'no contact')


def test_reading_that_comes_twice_is_no_warning_until_nothing_else_comes(bench):
    bench.turn()
    bench.read()
    bench.read()
    bench.node._diagnostics.report()
    assert bench.health == (OK, 'contact')
    for _ in range(6):
        bench.now += 0.1
        bench.read(sec=1000)
    assert bench.health == (ERROR, 'readings refused: not newer')


def read_on(bench, joints=True, **fields):
    """Read a tenth of a second later, joint angles and sensor."""
    bench.now += 0.1
    stamp = {'sec': bench.sec, 'nanosec': round((bench.now - bench.sec) * 1e9)}
    if joints:
        bench.turn(**stamp)
    bench.read(**stamp, **fields)


def test_readings_that_are_all_refused_are_an_error_that_says_why(bench):
    bench.turn()
    bench.read()
    report = bench.node._diagnostics.report
    report()
    for _ in range(4):
        read_on(bench, position=(0.0, -1.0))
    assert bench.health == (OK, 'contact')  # the next report will tell of it
    report()
    assert bench.health == (WARN, 'contact, some refused')
    for _ in range(2):
        read_on(bench, position=(0.0, -1.0))
    assert bench.health == (ERROR, 'readings refused: off the hemisphere')
    read_on(bench)
    assert bench.health == (WARN, 'contact, some refused')
    report()
    report()
    assert bench.health == (OK, 'contact')


def test_refused_joint_states_are_a_warning(bench):
    bench.turn()
    bench.read()
    bench.turn(position=(math.nan, 0.0))
    bench.node._diagnostics.report()
    assert bench.health == (WARN, 'contact, some refused')


def test_first_reading_after_a_silence_is_no_error_yet(bench):
    bench.now += 100.0
    bench.read()
    assert bench.health == (WARN, 'no contact yet')
    for _ in range(6):
        read_on(bench, joints=False)
    assert bench.health == (ERROR, 'readings refused: no joint state')


def test_ages_are_reported(bench):
    now = bench.node.get_clock().now().nanoseconds
    for callback, ago in ((bench.turn, 2.03), (bench.read, 2.0)):
        sec, nanosec = divmod(now - int(ago * 1e9), 10**9)
        callback(sec=sec, nanosec=nanosec)
    values = bench.node._health().values
    assert 2.0 <= float(values['age of the last reading [s]']) < 30.0
    assert float(values['age of the joint state used [s]']) == pytest.approx(0.03, abs=1e-3)


@pytest.mark.parametrize(
    ('name', 'value', 'position', 'reason'),
    [
        ('max_out_of_plane', 0.01, (AHEAD, AHEAD - 0.1), 'out of plane'),
        ('detectable_range', 0.1, (0.0, AHEAD - 0.15), 'beyond the detectable range'),
        ('joint_state_timeout', 0.001, (0.0, AHEAD), 'stale joint state'),
        # 0.08 + 3.5 * 0.04 = 0.22 rad in 40 ms are no jump
        ('max_theta_rate', 0.01, (0.0, AHEAD - 0.18), 'isolated jump'),
        ('jump_tolerance', 0.001, (0.0, AHEAD - 0.18), 'isolated jump'),
        ('mount_angle', 1.0, (0.0, AHEAD), 'isolated jump'),
    ],
)
@pytest.mark.parametrize('changed', [False, True])
def test_parameter_takes_effect_at_once(bench, name, value, position, reason, changed):
    bench.turn()
    bench.read()
    bench.turn(nanosec=30_000_000)
    if changed:
        (answer,) = bench.node.set_parameters([RosParameter(name, value=value)])
        assert answer.successful
    bench.read(position=position, nanosec=40_000_000)
    assert rejected(bench) == ({reason: 1} if changed else {})


def test_radius_takes_effect_at_once(bench):
    bench.turn()
    bench.node.set_parameters([RosParameter('finger_radius', value=0.02)])
    bench.read()
    assert bench.sent[0][3] == pytest.approx(0.02)


def told(bench):
    return [dict(zip(m.name, m.position, strict=True)) for m in bench.told]


def test_what_a_reading_gave_is_told_to_those_who_listen_only(bench):
    bench.turn(position=(0.2, 0.1))
    bench.read()
    assert not bench.told
    bench.listeners = 1
    bench.read(nanosec=1000)
    (state,) = told(bench)
    assert (state['azimuth'], state['elevation']) == (0.0, AHEAD)
    assert state['joint_angle'] == pytest.approx(0.3, rel=1e-14)
    assert state['theta'] == pytest.approx(0.3, rel=1e-12)
    assert REFUSALS[int(state['refusal'])] == ''
    assert (bench.told[0].header.stamp.sec, bench.told[0].header.stamp.nanosec) == (bench.sec, 1000)


def test_why_a_reading_was_refused_is_told(bench):
    bench.listeners = 1
    bench.read()
    bench.turn(nanosec=1000)
    bench.read(nanosec=1000, position=(math.nan, math.nan))
    bench.read(nanosec=2000, names=('azimuth',), position=(0.0,))
    assert [REFUSALS[int(state['refusal'])] for state in told(bench)] == [
        'no joint state',
        'no contact',
        'no azimuth and elevation',
    ]
    assert all(math.isnan(state['theta']) for state in told(bench))
    assert [math.isnan(state['joint_angle']) for state in told(bench)] == [True, False, True]


@pytest.mark.parametrize(
    ('names', 'words'),
    [
        (
            ['left_proximal_joint', 'left_distal_joint'],
            'got no proximal_joint, distal_joint, but left',
        ),
        (
            ['proximal_joint', 'distal_jiont'],
            'got no distal_joint, but proximal_joint, distal_jiont',
        ),
        (['proximal_joint'], 'got no distal_joint, but proximal_joint'),
        (
            ['proximal_joint', 'distal_joint', 'distal_joint'],
            'distal_joint is named more than once',
        ),
    ],
)
def test_error_names_the_joints_that_are_missing_and_those_that_came(bench, names, words):
    for _ in range(6):
        bench.turn(names, [0.1] * len(names))
        read_on(bench, joints=False)
    level, message = bench.health
    assert level == ERROR
    assert message.startswith('readings refused: no joint state: joint')
    assert words in message
