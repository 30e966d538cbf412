# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Looks at real nodes in a namespace, on simulated time: all well, and then with faults."""

import signal
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress

import pytest
from geometry_msgs.msg import TwistStamped
from lifecycle_msgs.msg import Transition
from rclpy.node import NodeNameNonExistentError

from tactile_push.doctor import MISSING, RIGHT, WRONG, findings
from tactile_push.doctor.looking import hearing_readings, look
from tactile_push.interface import (
    CLOCK,
    COMMAND,
    CONTACT,
    CONTACT_GEOMETRY,
    CONTROLLER_STATE,
    FINGER_BASE,
    FINGER_SERVO,
    JOINT_STATES,
    PUSH_CONTROLLER,
    SENSOR_DRIVER,
    SERVO_COMMANDS,
    SIM_PLANT,
    TACTILE,
    TOPICS,
)
from tactile_push.testing import NodeProcesses, Observer, Rig, field

LEFT = 'left'
LOOP = {SENSOR_DRIVER, CONTACT_GEOMETRY, PUSH_CONTROLLER, FINGER_SERVO, SIM_PLANT}


@pytest.fixture(scope='module')
def rig(tmp_path_factory):
    """Return a finger that pushes by its joints in a namespace."""
    folder = tmp_path_factory.mktemp('doctor')
    with NodeProcesses(folder) as nodes, Observer(nodes.domain) as observer:
        rig = Rig(nodes, observer, str(folder / 'sensor'), LEFT)
        rig.start(servo=True)
        rig.wait_until_moving()
        yield rig


@pytest.fixture
def looked(rig, monkeypatch):
    """Return a function that looks while the observer waits: the snapshot, and what it offered."""
    monkeypatch.setenv('ROS_DOMAIN_ID', str(rig.nodes.domain))
    node = rig.observer.node

    def run():
        offered = set()

        def done():
            for name, namespace in node.get_node_names_and_namespaces():
                if name.startswith('doctor_'):
                    assert namespace == f'/{LEFT}'
                    offered.add('')
                    with suppress(NodeNameNonExistentError):  # it may just have gone
                        kinds = node.get_publisher_names_and_types_by_node(name, namespace)
                        offered.update(topic for topic, _ in kinds)
            return future.done()

        with ThreadPoolExecutor(1) as pool:
            future = pool.submit(look, f'/{LEFT}')
            rig.observer.wait_for(done, 'the doctor to have looked')
        return future.result(), offered

    return run


def by_verdict(seen, verdict):
    return {f.subject: f.words for f in findings(seen) if f.verdict == verdict}


def test_finger_that_pushes_is_seen_whole(rig, looked):
    seen, offered = looked()
    assert set(seen.nodes) == LOOP
    assert len(seen.nodes) == len(LOOP)
    managed = {SENSOR_DRIVER, PUSH_CONTROLLER, FINGER_SERVO}
    assert seen.states == dict.fromkeys(managed, 'active')
    assert set(seen.parameters) == LOOP
    assert seen.parameters[SIM_PLANT]['belt_speed'] == 0.005
    assert seen.parameters[CONTACT_GEOMETRY]['use_sim_time'] is True
    assert seen.parameters[FINGER_SERVO]['joint_names'] == ['proximal_joint', 'distal_joint']
    assert set(seen.health) == LOOP
    assert {one.node for one in seen.publishers[COMMAND]} == {PUSH_CONTROLLER}
    assert {one.node for one in seen.publishers[CLOCK]} == {SIM_PLANT}
    assert {one.node for one in seen.subscriptions[SERVO_COMMANDS]} == {FINGER_SERVO, SIM_PLANT}
    (given,) = seen.publishers[TACTILE]
    (taken,) = seen.subscriptions[TACTILE][:1]
    assert given.type_name == taken.type_name == TOPICS[TACTILE].type_name
    assert {one.reliable for one in seen.publishers[TACTILE]} == {True}
    assert {one.reliable for one in seen.subscriptions[JOINT_STATES]} == {False}
    assert seen.heard[COMMAND].frames == {FINGER_BASE}
    assert {'azimuth', 'elevation'} <= seen.heard[TACTILE].names
    for topic in (TACTILE, JOINT_STATES, CONTROLLER_STATE):
        heard = seen.heard[topic]
        assert heard.count > 5
        assert len(heard.ages) == heard.count
        assert heard.seconds > 0.0
        assert max(map(abs, heard.ages)) < 100.0  # while the system's clock is years ahead
    right = by_verdict(seen, RIGHT)
    assert right[CLOCK] == 'all nodes use simulated time'
    assert right['belt_speed'] == f'is the same for {", ".join(_who(seen, "belt_speed"))}'
    assert offered <= {'', '/parameter_events'}  # which every node publishes
    assert offered


def _who(seen, name):
    return [node for node, values in seen.parameters.items() if name in values]


def test_readings_of_a_touch_are_those_that_the_sensor_publishes(rig, monkeypatch):
    monkeypatch.setenv('ROS_DOMAIN_ID', str(rig.nodes.domain))

    def touched():
        with hearing_readings(f'/{LEFT}') as hear:
            return [[str(reading) for reading in hear()] for _ in range(2)]

    rig.tactile.clear()
    with ThreadPoolExecutor(1) as pool:
        future = pool.submit(touched)
        rig.observer.wait_for(future.done, 'the doctor to have heard two touches')
    first, second = future.result()

    def published():
        return {str((field(m, 'azimuth'), field(m, 'elevation'))) for m in rig.tactile}

    # Either may lose messages on a busy machine, or hear them later, but not all of them.
    for touch in (first, second):
        rig.observer.wait_for(lambda touch=touch: published() & {*touch}, 'what the doctor heard')
    assert first[0] not in second  # it was before the second touch


def test_faults_of_real_nodes_are_named(rig, looked):
    rig.nodes.running[f'{LEFT}.{CONTACT_GEOMETRY}'].send_signal(signal.SIGSTOP)
    controller = f'/{LEFT}/{PUSH_CONTROLLER}'
    assert rig.observer.change_state(controller, Transition.TRANSITION_DEACTIVATE)
    rig.observer.node.create_publisher(TwistStamped, f'/{LEFT}/{COMMAND}', 10)
    try:
        seen, _ = looked()
    finally:
        rig.nodes.running[f'{LEFT}.{CONTACT_GEOMETRY}'].send_signal(signal.SIGCONT)
    wrong = by_verdict(seen, WRONG)
    assert by_verdict(seen, MISSING) == {
        CONTACT_GEOMETRY: 'does not run, or hangs',
        CONTACT: 'nobody publishes what push_controller needs',
    }
    assert wrong[PUSH_CONTROLLER] == 'is inactive'
    assert '/observer' in wrong[COMMAND]
