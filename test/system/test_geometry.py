# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Contact geometry as a process: pairing, refusals, old readings, joint states that misbehave."""

import itertools
import math
from collections.abc import Callable
from typing import Any

import pytest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from geometry_msgs.msg import PoseStamped
from rcl_interfaces.msg import Parameter, ParameterType, ParameterValue
from rcl_interfaces.srv import SetParameters
from rclpy.time import Time
from sensor_msgs.msg import JointState

from tactile_push.testing import NodeProcesses, Observer

AHEAD = math.pi / 2.0
JOINTS = ['proximal_joint', 'distal_joint']
PERIOD = 20_000_000  # between two readings [ns]
OK, WARN, ERROR = DiagnosticStatus.OK, DiagnosticStatus.WARN, DiagnosticStatus.ERROR


class Geometry:
    """The node, a sensor and joints that say what the test wants, and what comes of it."""

    def __init__(self, nodes: NodeProcesses, observer: Observer, **parameters: Any) -> None:
        self.observer = observer
        self.contacts = observer.hear(PoseStamped, 'contact')
        self.reports = observer.hear(DiagnosticArray, '/diagnostics')
        self.sensor = observer.node.create_publisher(JointState, 'tactile', 100)
        self.joints = observer.node.create_publisher(JointState, 'joint_states', 100)
        self.now = 10**9 * 1000  # [ns]
        self.counts_before: dict[str, int] = {}
        nodes.start('contact_geometry', parameters)

    def warm_up(self) -> None:
        """Read until the node hears and is heard, and take note of what it has counted by then."""

        def heard() -> bool:
            self.read_and_turn(0.0, 0.0)
            return bool(self.contacts)

        self.observer.wait_for(heard, 'the first contact')
        self.theta(self.now)
        now = self.observer.node.get_clock().now().nanoseconds
        self.observer.wait_for(
            lambda: (
                self.reports and Time.from_msg(self.reports[-1].header.stamp).nanoseconds >= now
            ),
            'a report',
        )
        self.counts_before = self.counts()
        self.contacts.clear()
        self.now += 10**9

    def read(self, azimuth: float = 0.0, elevation: float = AHEAD, at: int | None = None) -> int:
        """Send a reading, by default one period after the last, and give its stamp."""
        if at is None:
            self.now += PERIOD
            at = self.now
        names = ['azimuth', 'elevation', 'normal_force']
        _send(self.sensor, names, [azimuth, elevation, math.nan], at)
        return at

    def turn(self, *angles: float, at: int) -> None:
        _send(self.joints, JOINTS, list(angles), at)

    def read_and_turn(self, *angles: float, late: int = 0) -> None:
        """Send a reading and joint angles of the same time or older."""
        stamp = self.read()
        self.turn(*angles, at=stamp - late)

    def theta(self, at: int) -> float:
        """Wait for the contact with a stamp and give its theta."""
        stamp = Time(nanoseconds=at).to_msg()
        found = self.observer.wait_for(
            lambda: [c for c in self.contacts if c.header.stamp == stamp], f'contact of {at}'
        )
        orientation = found[-1].pose.orientation
        return 2.0 * math.atan2(orientation.z, orientation.w)

    def wait_for_counts(self, refused: dict[str, int], **counts: int) -> None:
        """Wait until a report counts so much since the warm-up, and no other refusals."""
        expected = {key.replace('_', ' '): n for key, n in counts.items()}
        expected |= {f'rejected: {reason}': n for reason, n in refused.items()}

        def counted() -> dict[str, int]:
            before = self.counts_before
            return {k: n - before.get(k, 0) for k, n in self.counts().items()}

        self.observer.wait_for(lambda: expected.items() <= counted().items(), f'{expected}')
        others = {k for k, n in counted().items() if n and k.startswith('rejected: ')}
        assert others <= expected.keys()

    def counts(self) -> dict[str, int]:
        return {k: int(v) for k, v in self.values.items() if v.isdigit()}

    @property
    def values(self) -> dict[str, str]:
        if not self.reports:
            return {}
        return {value.key: value.value for value in self.reports[-1].status[0].values}

    def wait_for_level(
        self, level: bytes, words: str, act: Callable[[], Any] = lambda: None
    ) -> None:
        """Do something over and over until a new report has a level and a message."""
        seen = len(self.reports)

        def reported() -> bool:
            act()
            return any(
                (report.status[0].level, report.status[0].message) == (level, words)
                for report in self.reports[seen:]
            )

        self.observer.wait_for(reported, words)


def _send(publisher: Any, name: list[str], position: list[float], at: int) -> None:
    message = JointState(name=name, position=position)
    message.header.stamp = Time(nanoseconds=at).to_msg()
    publisher.publish(message)


def test_reading_is_paired_with_the_joint_angles_of_its_moment(
    nodes: NodeProcesses, observer: Observer
):
    geometry = Geometry(nodes, observer)
    geometry.warm_up()
    # A finger that turns at 2 rad/s, heard each 80 ms: the pole is 90 degrees plus both angles.
    start = geometry.now
    for k in range(3):
        geometry.turn(0.08 * k, 0.08 * k, at=start + 80_000_000 * k)
    geometry.wait_for_counts({}, joint_states=3)
    for milliseconds, theta in ((20, 0.04), (110, 0.22), (160, 0.32), (200, 0.40)):
        stamp = geometry.read(at=start + 1_000_000 * milliseconds)
        assert geometry.theta(stamp) == pytest.approx(theta, abs=1e-5)
    geometry.read(at=start + 261_000_000)
    geometry.wait_for_counts({'stale joint state': 1}, contacts=4)
    assert float(geometry.values['age of the joint state used [s]']) == pytest.approx(0.101)


def test_refusals_are_counted_by_reason(nodes: NodeProcesses, observer: Observer):
    geometry = Geometry(nodes, observer, use_joint_states=False, detectable_range=1.0)
    geometry.warm_up()
    good = [geometry.read()]
    geometry.read(math.nan, math.nan)
    for azimuth, elevation in ((math.nan, 1.0), (0.0, math.inf), (0.0, 1.6), (4.0, 1.0)):
        geometry.read(azimuth, elevation)
    geometry.read(0.0, AHEAD - 1.01)
    geometry.read(AHEAD, 1.0)
    geometry.read(0.0, 0.8)
    good.append(geometry.read())
    geometry.read(at=good[0])
    geometry.wait_for_counts(
        {
            'no contact': 1,
            'off the hemisphere': 4,
            'beyond the detectable range': 1,
            'out of plane': 1,
            'isolated jump': 1,
            'not newer': 1,
        },
        readings=11,
        contacts=2,
    )
    assert [geometry.theta(stamp) for stamp in good] == pytest.approx([0.0, 0.0])
    assert len(geometry.contacts) == 2


def test_old_reading_published_again_does_not_become_a_contact(
    nodes: NodeProcesses, observer: Observer
):
    geometry = Geometry(nodes, observer, use_joint_states=False)
    geometry.warm_up()
    first = geometry.read()
    second = geometry.read()
    for _ in range(5):
        geometry.read(at=first)
    for _ in range(5):
        geometry.read(at=second)
    third = geometry.read()
    geometry.theta(third)
    geometry.wait_for_counts({'not newer': 10}, readings=13, contacts=3)
    stamps = [Time.from_msg(c.header.stamp).nanoseconds for c in geometry.contacts]
    assert stamps == [first, second, third]


def test_clock_that_was_set_back_costs_two_readings(nodes: NodeProcesses, observer: Observer):
    geometry = Geometry(nodes, observer, use_joint_states=False)
    geometry.warm_up()
    geometry.theta(geometry.read())
    geometry.now -= 500 * 10**9
    stamps = [geometry.read() for _ in range(4)]
    geometry.theta(stamps[3])
    geometry.wait_for_counts({'not newer': 2}, contacts=3)


def test_joint_states_missing_not_finite_late_and_stopping(
    nodes: NodeProcesses, observer: Observer
):
    geometry = Geometry(nodes, observer)
    missing, stale = 'readings refused: no joint state', 'readings refused: stale joint state'
    geometry.wait_for_level(ERROR, missing, geometry.read)
    no_number = f'{missing}: joint_states: proximal_joint is nan'
    geometry.wait_for_level(ERROR, no_number, lambda: geometry.read_and_turn(math.nan, 0.0))
    assert not geometry.contacts
    geometry.wait_for_level(OK, 'contact', lambda: geometry.read_and_turn(0.1, 0.2))
    observer.wait_for(lambda: geometry.contacts, 'a contact')
    # A joint state from the past changes nothing: the next reading still has the newest angles.
    geometry.turn(3.0, 3.0, at=geometry.now - 10**9)
    stamp = geometry.read()
    assert geometry.theta(stamp) == pytest.approx(0.3)
    geometry.wait_for_level(ERROR, stale, geometry.read)
    count = len(geometry.contacts)
    geometry.wait_for_level(
        ERROR, stale, lambda: geometry.read_and_turn(0.1, 0.2, late=200_000_000)
    )
    assert len(geometry.contacts) == count
    geometry.wait_for_level(OK, 'contact', lambda: geometry.read_and_turn(0.1, 0.2))


def test_health_tells_silence_from_a_finger_in_the_air(nodes: NodeProcesses, observer: Observer):
    geometry = Geometry(nodes, observer, use_joint_states=False)
    geometry.wait_for_level(WARN, 'no readings yet')
    geometry.wait_for_level(OK, 'no contact', lambda: geometry.read(math.nan, math.nan))
    geometry.wait_for_level(OK, 'contact', geometry.read)

    def rate_is_told() -> bool:
        geometry.read()
        return float(geometry.values.get('readings [1/s]', 0.0)) > 0.0

    observer.wait_for(rate_is_told, 'the rate of readings')
    geometry.wait_for_level(ERROR, 'no readings')


def test_messages_that_nobody_should_send_are_survived(nodes: NodeProcesses, observer: Observer):
    geometry = Geometry(nodes, observer)
    geometry.warm_up()
    numbers = (0.0, math.nan, math.inf, -math.inf, 1.7e308, -1.7e308)
    arrays = [[], [0.0], [math.nan] * 50, *([a, b] for a in numbers for b in numbers)]
    names = [[], ['azimuth'] * 2, ['azimuth', 'elevation'], JOINTS, [*JOINTS, *JOINTS], ['x'] * 50]
    stamps = [(0, 0), (-(2**31), 0), (2**31 - 1, 2**32 - 1), (-1, 10**9)]
    for (sec, nanosec), name, position in itertools.product(stamps, names, arrays):
        message = JointState(name=name, position=position)
        message.header.stamp.sec, message.header.stamp.nanosec = sec, nanosec
        geometry.sensor.publish(message)
        geometry.joints.publish(message)
    seen = Time(nanoseconds=geometry.now).to_msg().sec

    def sound() -> list[PoseStamped]:
        geometry.read_and_turn(0.0, 0.0)
        return [c for c in geometry.contacts if seen <= c.header.stamp.sec < seen + 10**6]

    observer.wait_for(lambda: len(sound()) > 3, 'contacts again')
    for contact in geometry.contacts:
        place = contact.pose.position
        assert math.hypot(place.x, place.y) == pytest.approx(0.0135)
        assert contact.header.stamp.sec >= 0


def test_parameter_takes_effect_while_the_node_runs(nodes: NodeProcesses, observer: Observer):
    geometry = Geometry(nodes, observer, use_joint_states=False)
    geometry.warm_up()
    geometry.theta(geometry.read(0.0, AHEAD - 0.1))
    value = ParameterValue(type=ParameterType.PARAMETER_DOUBLE, double_value=0.05)
    request = SetParameters.Request(parameters=[Parameter(name='detectable_range', value=value)])
    answer = observer.call(SetParameters, 'contact_geometry/set_parameters', request)
    assert answer.results[0].successful
    geometry.read(0.0, AHEAD - 0.1)
    geometry.wait_for_counts({'beyond the detectable range': 1}, contacts=1)
