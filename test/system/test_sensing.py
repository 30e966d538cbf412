# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Active sensing as a node, beside the truth that the simulated plant tells."""

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from geometry_msgs.msg import PoseStamped, PoseWithCovarianceStamped
from rclpy.duration import Duration
from rclpy.time import Time
from sensor_msgs.msg import JointState
from visualization_msgs.msg import MarkerArray

from tactile_push.control import PUSHING, STATES
from tactile_push.estimation import CONTRADICTIONS
from tactile_push.parameters.config_file import config_file
from tactile_push.pipeline.orientation import yaw_of_quaternion
from tactile_push.testing import NodeProcesses, Observer, Rig, field, seconds

NOISE = 0.0035  # of the sensor [rad]
PERIOD = 0.1


class Sensing:
    """The node, and what it says."""

    def __init__(self, nodes: NodeProcesses, observer: Observer) -> None:
        self._nodes = nodes
        self._observer = observer
        self.states = observer.hear(JointState, 'active_sensing/state')
        self.poses = observer.hear(PoseWithCovarianceStamped, 'object_pose')
        self.true_poses = observer.hear(PoseStamped, 'ground_truth/object_pose')
        self._diagnostics = observer.hear(DiagnosticArray, '/diagnostics')

    def start(self, config: str = 'block', **parameters: Any) -> None:
        """Start the node and wait until it can hear the controller."""
        settings = {'use_sim_time': True, 'noise': NOISE, **parameters}
        self._nodes.start('active_sensing', settings, config=config_file(f'{config}.yaml'))
        self._observer.wait_for(self._listens, 'active_sensing to listen')

    def _listens(self) -> bool:
        """Return whether the node itself is seen to subscribe, which others do too."""
        there = self._observer.node.get_subscriptions_info_by_topic('push_controller/state')
        return any(subscription.node_name == 'active_sensing' for subscription in there)

    def reports(self) -> list[DiagnosticStatus]:
        """Give what its diagnostics have said so far."""
        found = [status for array in self._diagnostics for status in array.status]
        return [status for status in found if status.name == 'active_sensing']

    def said(self, words: str, level: bytes) -> bool:
        """Tell whether its diagnostics said something."""
        return any(r.level == level and words in r.message for r in self.reports())

    def true(self, truth: list[JointState], name: str) -> Callable[[JointState], float]:
        """Give a function from its states to the truth at the reading that they are about."""
        times = np.array([seconds(m) for m in truth])
        values = np.array([field(m, name) for m in truth])

        def at(state: JointState) -> float:
            return float(np.interp(seconds(state) - field(state, 'age'), times, values))

        return at


@pytest.fixture
def sensing(nodes: NodeProcesses, observer: Observer) -> Sensing:
    return Sensing(nodes, observer)


def test_block_is_located_while_it_is_turned(sensing: Sensing, rig: Rig, observer: Observer):
    markers = observer.hear(MarkerArray, 'active_sensing/markers')
    sensing.start()
    rig.start(sensor_noise=NOISE)
    observer.wait_for(lambda: len(sensing.states) > 250, '250 control periods')
    observer.wait_for(
        lambda: seconds(rig.truth[-1]) > seconds(sensing.states[250]), 'the truth of that time'
    )
    states = [s for s in sensing.states[:250] if field(s, 'readings') > 0]
    assert len(states) > 240
    true_d = sensing.true(rig.truth, 'd')
    for state in states:
        assert field(state, 'd_least') <= true_d(state) <= field(state, 'd_most')
    inside = [field(s, 'd_lower') <= true_d(s) <= field(s, 'd_upper') for s in states]
    # Errors of one run hang together: a run in twenty may be outside for long.
    assert np.mean(inside) > 0.5
    widths = [field(s, 'd_upper') - field(s, 'd_lower') for s in states]
    assert widths[0] > 0.045  # the edge
    assert widths[-1] < 0.003
    assert abs(field(states[-1], 'd') - true_d(states[-1])) < 0.0015
    assert {field(s, 'edge') for s in states} == {0.0}
    assert {field(s, 'contradiction') for s in states} == {0.0}
    assert sensing.said('estimating', DiagnosticStatus.OK)

    times = np.array([seconds(m) for m in sensing.true_poses])
    true = np.array(
        [
            (
                m.pose.position.x,
                m.pose.position.y,
                yaw_of_quaternion(0.0, 0.0, m.pose.orientation.z, m.pose.orientation.w),
            )
            for m in sensing.true_poses
        ]
    )
    poses = [m for m in sensing.poses if seconds(m) <= times[-1]]
    assert len(poses) > 240
    distances = []
    for message in poses:
        pose, covariance = message.pose.pose, np.reshape(message.pose.covariance, (6, 6))
        assert message.header.frame_id == 'finger_disk'
        yaw = yaw_of_quaternion(0.0, 0.0, pose.orientation.z, pose.orientation.w)
        estimate = np.array([pose.position.x, pose.position.y, yaw])
        at = [np.interp(seconds(message), times, column) for column in true.T]
        plane = covariance[np.ix_((0, 1, 5), (0, 1, 5))]
        assert np.linalg.eigvalsh(plane).min() > 0.0
        error = estimate - at
        distances.append(error @ np.linalg.solve(plane, error))
    # The sum of three squares, of which 99.9 % are below 16; they hang together.
    assert np.mean(np.array(distances) < 16.3) > 0.9
    kinds = {marker.ns for array in markers for marker in array.markers}
    assert kinds == {'outline', 'likely', 'possible'}


def test_disk_is_located_but_not_how_it_is_turned(sensing: Sensing, rig: Rig, observer: Observer):
    sensing.start('disk')
    rig.start('disk', sensor_noise=NOISE)
    observer.wait_for(lambda: len(sensing.poses) > 50, '50 poses')
    last = sensing.poses[-1]
    observer.wait_for(
        lambda: seconds(sensing.true_poses[-1]) > seconds(last), 'the truth of that time'
    )
    nearest = min(sensing.true_poses, key=lambda m: abs(seconds(m) - seconds(last)))
    found, true = last.pose.pose.position, nearest.pose.position
    # Its centre is 42 mm from the disk's, in the direction of the normal, which readings tell; how
    # far it is they hardly do, and the two radii are known to 8.5 % only.
    outwards = np.array([true.x, true.y]) / math.hypot(true.x, true.y)
    error = np.array([found.x - true.x, found.y - true.y])
    assert abs(outwards @ (-error[1], error[0])) < 0.042 * 4.0 * NOISE
    covariance = np.array(last.pose.covariance).reshape(6, 6)[:2, :2]
    radial = math.sqrt(outwards @ covariance @ outwards)
    assert abs(outwards @ error) < 3.0 * radial
    assert radial < 0.085 * 0.042
    assert math.sqrt(last.pose.covariance[35]) > 1.5
    assert field(sensing.states[-1], 'd') == 0.0


def test_another_object_is_said_and_no_pose_is_told(sensing: Sensing, rig: Rig, observer: Observer):
    deep = [-0.025, -0.1, 0.025, -0.1, 0.025, 0.1, -0.025, 0.1]  # turns a third as fast
    sensing.start(vertices=deep)
    rig.start(sensor_noise=NOISE)
    observer.wait_for(
        lambda: sensing.said('nothing known', DiagnosticStatus.ERROR), 'the contradiction'
    )
    why = next(r.message for r in sensing.reports() if r.level == DiagnosticStatus.ERROR)

    def contradicted() -> list[JointState]:
        return [s for s in sensing.states if field(s, 'contradiction') > 0]

    observer.wait_for(contradicted, 'a state that tells the contradiction')
    states = contradicted()
    assert CONTRADICTIONS[int(field(states[0], 'contradiction'))] in why
    for state in states:
        assert math.isnan(field(state, 'd'))
        assert field(state, 'd_upper') - field(state, 'd_lower') > 0.045
    told = [seconds(m) for m in sensing.poses]
    assert told
    readings = [seconds(s) - field(s, 'age') for s in states]
    assert not any(abs(read - pose) < 1e-4 for read in readings for pose in told)


def test_lost_contact_is_forgotten_and_found_again(
    nodes: NodeProcesses, sensing: Sensing, rig: Rig, observer: Observer
):
    sensing.start()
    rig.start(sensor_noise=NOISE)
    observer.wait_for(lambda: len(sensing.poses) > 30, '30 poses')
    nodes.running['sensor_driver'].kill()
    observer.wait_for(
        lambda: sensing.said('no contact', DiagnosticStatus.WARN), 'the loss of the contact'
    )
    observer.wait_for(
        lambda: field(sensing.states[-1], 'readings') == 0.0, 'an estimate without readings'
    )
    lost = sensing.states[-1]
    assert math.isnan(field(lost, 'd'))
    assert field(lost, 'd_upper') - field(lost, 'd_lower') > 0.045
    seen = len(sensing.states)
    nodes.running['sensor_driver'].wait()
    rig.start_node('sensor_driver', {'use_sim_time': True})
    observer.wait_for(
        lambda: any(field(s, 'readings') > 5 for s in sensing.states[seen:]), 'new readings'
    )
    counts = {v.key: v.value for v in sensing.reports()[-1].values}
    assert int(counts['forgot everything: contact lost']) >= 1


def test_sensor_whose_clock_is_ahead_is_heard_as_the_controller_hears_it(
    nodes: NodeProcesses, sensing: Sensing, observer: Observer, tmp_path: Path
):
    ahead = observer.node.create_publisher(PoseStamped, 'contact', 10)

    def pass_on(message: PoseStamped) -> None:
        # By two and a half readings: one that comes a reading late is ahead as well.
        stamp = Time.from_msg(message.header.stamp) + Duration(nanoseconds=50_000_000)
        message.header.stamp = stamp.to_msg()
        ahead.publish(message)

    observer.node.create_subscription(PoseStamped, 'contact_in_time', pass_on, 10)
    sensing.start()
    block, simulated = {'config': config_file('block.yaml')}, {'use_sim_time': True}
    device = {'device': str(tmp_path / 'sensor')}
    # The plant's time waits for commands and for the contacts of its own readings, so that a loaded
    # machine loses none.
    plant = {**device, 'sensor_noise': NOISE, 'publish_clock': True}
    in_time = ('-r', 'contact:=contact_in_time')
    nodes.start('push_controller', simulated, **block)
    observer.wait_for(lambda: ahead.get_subscription_count(), 'who hears what is passed on')
    nodes.start('sim_plant', plant, **block, arguments=in_time)
    nodes.start('sensor_driver', device | simulated)
    nodes.start('contact_geometry', simulated, **block, arguments=in_time)
    pushing = float(STATES.index(PUSHING))

    # To look through all states after each message would hold up what is passed on.
    pushes: set[float] = set()
    early: set[float] = set()

    def note_push(message: JointState) -> None:
        if field(message, 'state') == pushing:
            pushes.add(seconds(message))

    def note_age(message: JointState) -> None:
        if field(message, 'age') < 0.0:
            early.add(seconds(message))

    observer.node.create_subscription(JointState, 'push_controller/state', note_push, 1000)
    observer.node.create_subscription(JointState, 'active_sensing/state', note_age, 1000)
    # This process passes the contacts on: where it is held up the controller waits for one.
    observer.wait_for(lambda: len(pushes) >= 63, '63 control periods in which the finger pushes')
    observer.wait_for(lambda: len(pushes & early) >= 20, '20 of them with a contact that is ahead')
    stamps = set(pushes)
    observer.wait_for(lambda: seconds(sensing.states[-1]) >= max(stamps), 'what they tell')
    known = {seconds(s) for s in sensing.states if math.isfinite(field(s, 'd'))}
    assert stamps <= known


def test_ticks_without_sense_do_no_harm(sensing: Sensing, observer: Observer):
    publisher = observer.node.create_publisher(JointState, 'push_controller/state', 10)
    sensing.start()
    observer.wait_for(publisher.get_subscription_count, 'the node')
    names = [
        'theta',
        'theta_desired',
        'phi',
        'v_x',
        'kp',
        'kd',
        'silence',
        'saturated',
        'limited',
        'finger_x',
        'state',
    ]
    names += ['stop_reason', 'ticks', 'ticks_lost']
    good = dict.fromkeys(names, 0.0) | {'state': 2.0}
    wrong = (
        JointState(),
        JointState(name=['theta'], position=[0.1]),
        JointState(name=names, position=[math.nan] * len(names)),
        JointState(name=names, position=[1e308] * len(names)),
        JointState(name=names, position=list((good | {'state': 99.0}).values())),
        JointState(name=names, position=list((good | {'theta': math.inf}).values())),
        JointState(name=names, position=list((good | {'v_x': math.inf}).values())),
        JointState(name=names, position=list((good | {'silence': -math.inf}).values())),
    )
    for k, message in enumerate([*wrong, *wrong]):
        message.header.stamp.nanosec = 100_000_000 * (k % 9)
        publisher.publish(message)
    for k in range(5):
        message = JointState(name=names, position=list((good | {'theta': 0.3}).values()))
        message.header.stamp.sec, message.header.stamp.nanosec = 5, 100_000_000 * k
        publisher.publish(message)
    observer.wait_for(
        lambda: any(field(s, 'readings') == 5.0 for s in sensing.states), 'the good ones'
    )
    counts = observer.wait_for(
        lambda: [v for r in sensing.reports() for v in r.values if v.key == 'ticks without sense'],
        'the count',
    )
    assert int(counts[-1].value) > 0
