# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""A plant: commands in; joints, readings and the truth out. The rig is `sim_plant`'s."""

import math

import pytest
from geometry_msgs.msg import PoseStamped, TwistStamped
from rclpy.parameter import Parameter as RosParameter
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import JointState
from std_msgs.msg import Bool, Float64MultiArray

from tactile_push.interface import (
    CLOCK,
    COMMAND,
    JOINT_STATES,
    PLACE_RELEASE,
    PLACE_STATE,
    SERVO_COMMANDS,
    TOPICS,
    TRUE_POSE,
    TRUE_STATE,
)
from tactile_push.nodes.ros.diagnostics import ERROR, OK, WARN
from tactile_push.nodes.ros.plant import LONGEST_STEP
from tactile_push.nodes.sim_plant import SimPlant
from tactile_push.paper import BELT_SPEED, C_UNIFORM, FINGER_RADIUS
from tactile_push.pipeline.stamps import stamp_of


@pytest.fixture
def plant(bench, tmp_path):
    """Return what starts the plant with a device of its own."""
    return lambda **parameters: bench.start(
        SimPlant, **{'device': tmp_path / 'sensor', 'sensor_rate': 100.0, **parameters}
    )


def command(v_x):
    message = TwistStamped()
    message.twist.linear.x = v_x
    return message


def test_before_the_first_command_the_belt_stands(bench, plant):
    plant(theta_initial=0.25, d_initial=0.004)
    bench.hear(JointState, TRUE_STATE, JOINT_STATES)
    bench.until(lambda: len(bench.heard[TRUE_STATE]) > 3 and bench.heard[JOINT_STATES])
    state = bench.values(TRUE_STATE)
    assert tuple(state) == TOPICS[TRUE_STATE].field_names
    assert tuple(bench.values(JOINT_STATES)) == TOPICS[JOINT_STATES].field_names
    assert (state['theta'], state['d']) == pytest.approx((0.25, 0.004))
    assert state['finger_x'] == state['belt_travel'] == state['v_x'] == 0.0
    assert bench.health == (OK, 'belt stands, waiting for the first command')


def test_a_command_moves_the_finger_and_starts_the_belt(bench, plant):
    plant(command_timeout=10.0)
    bench.hear(JointState, TRUE_STATE)
    bench.publisher(TwistStamped, COMMAND).publish(command(0.01))
    bench.until(lambda: bench.heard[TRUE_STATE] and bench.values(TRUE_STATE)['belt_travel'] > 5e-4)
    state = bench.values(TRUE_STATE)
    assert (state['v_x'], state['v_x_commanded']) == (0.01, 0.01)
    # The finger goes at 10 mm/s across a belt at 5 mm/s.
    assert state['belt_speed'] == 0.005
    assert state['finger_x'] == pytest.approx(2.0 * state['belt_travel'])
    assert state['phi'] == pytest.approx(math.atan2(0.005, 0.01))
    assert bench.health == (OK, 'pushing')


def test_the_truth_about_the_block_is_where_geometry_has_it(bench, plant):
    plant(theta_initial=0.25, d_initial=0.004)
    bench.hear(PoseStamped, TRUE_POSE)
    bench.until(lambda: bench.heard[TRUE_POSE])
    pose = bench.heard[TRUE_POSE][-1]
    assert pose.header.frame_id == 'finger_disk'
    # From the finger's centre straight through the edge, across r and l, and back along d.
    ahead, back = 0.0135 + 0.02375, 0.004
    place, turn = pose.pose.position, pose.pose.orientation
    assert place.x == pytest.approx(-ahead * math.sin(0.25) - back * math.cos(0.25))
    assert place.y == pytest.approx(ahead * math.cos(0.25) - back * math.sin(0.25))
    assert 2.0 * math.atan2(turn.z, turn.w) == pytest.approx(0.25)


@pytest.mark.parametrize(
    ('v_x', 'obeyed', 'counted'),
    [
        (5.0, 0.1, 'commands too fast'),
        (-5.0, -0.1, 'commands too fast'),
        (math.inf, 0.0, 'commands not finite'),
        (math.nan, 0.0, 'commands not finite'),
    ],
)
def test_a_command_that_no_finger_should_follow_is_bounded(bench, plant, v_x, obeyed, counted):
    node = plant(command_timeout=10.0)
    bench.hear(JointState, TRUE_STATE)
    commands = bench.publisher(TwistStamped, COMMAND)
    commands.publish(command(0.001))
    commands.publish(command(v_x))
    bench.until(lambda: node._counts[counted])
    now = node.get_clock().now().to_msg()
    heard = bench.heard[TRUE_STATE]
    bench.until(lambda: heard and stamp_of(heard[-1]) > (now.sec, now.nanosec))
    assert bench.values(TRUE_STATE)['v_x_commanded'] == obeyed


def test_without_further_commands_the_finger_stops(bench, plant):
    plant(command_timeout=0.05)
    bench.hear(JointState, TRUE_STATE)
    bench.publisher(TwistStamped, COMMAND).publish(command(0.01))
    bench.until(lambda: any(message.position[5] > 0.0 for message in bench.heard[TRUE_STATE]))
    bench.until(lambda: bench.values(TRUE_STATE)['v_x'] == 0.0)
    assert bench.health == (ERROR, 'no command, finger stopped')


def test_joint_velocities_move_the_finger_until_others_come(bench, plant):
    node = plant(commands='joint_velocities', command_timeout=0.05)
    bench.hear(JointState, TRUE_STATE, JOINT_STATES)
    velocities = bench.publisher(Float64MultiArray, SERVO_COMMANDS)
    velocities.publish(Float64MultiArray(data=[0.0, 0.0]))  # of a servo that waits
    bench.until(lambda: node._counts['commands'])
    assert bench.health == (OK, 'belt stands, waiting for the first command')
    velocities.publish(Float64MultiArray(data=[0.0, -0.1]))
    bench.until(lambda: bench.heard[TRUE_STATE] and bench.values(TRUE_STATE)['belt_travel'] > 1e-3)
    state = bench.values(TRUE_STATE)
    # 0.1 rad/s at 8 cm, for at least four times the timeout.
    assert state['v_x'] == pytest.approx(0.008, rel=0.01)
    assert state['v_x_commanded'] == pytest.approx(0.008, rel=0.01)
    assert state['finger_x'] > 1e-3
    joints = bench.values(JOINT_STATES)
    assert joints['proximal_joint'] == pytest.approx(math.pi / 2.0)
    assert joints['distal_joint'] < -math.pi / 2.0 - 0.01
    assert bench.health == (OK, 'pushing')
    velocities.publish(Float64MultiArray(data=[1.0]))
    bench.until(lambda: node._counts['commands of another size'])


def test_a_release_lifts_the_finger_and_puts_it_down_at_the_next_object(bench, plant):
    plant(command_timeout=10.0, theta_initial=0.25, d_initial=0.004)
    bench.hear(JointState, TRUE_STATE)
    heard = bench.heard[TRUE_STATE]
    release = bench.publisher(Bool, PLACE_RELEASE)
    release.publish(Bool(data=False))  # which it is
    bench.publisher(TwistStamped, COMMAND).publish(command(0.004))
    bench.until(lambda: heard and abs(bench.values(TRUE_STATE)['theta'] - 0.25) > 0.04)
    release.publish(Bool(data=True))
    bench.until(lambda: bench.values(TRUE_STATE)['lifted'])
    placed = bench.values(TRUE_STATE)
    assert math.isnan(placed['theta'])
    assert bench.health == (OK, 'finger lifted')
    bench.until(lambda: bench.values(TRUE_STATE)['finger_x'] > placed['finger_x'] + 2e-4)
    after = bench.values(TRUE_STATE)
    for name in ('object_x', 'edge_angle'):
        assert after[name] == pytest.approx(placed[name])
    seen = len(heard)
    release.publish(Bool(data=False))
    bench.until(lambda: not bench.values(TRUE_STATE)['lifted'])
    down = (dict(zip(m.name, m.position, strict=True)) for m in heard[seen:])
    touched = next(values for values in down if not values['lifted'])
    # As at the start, but for one step, of 0.1 s at the most, in which finger and belt move 0.64 mm
    # against each other. That turns the block by 1 / (2 c) of it at the most, whatever the force.
    way = LONGEST_STEP * math.hypot(0.004, BELT_SPEED)
    turn = way / (2.0 * C_UNIFORM)
    assert touched['theta'] == pytest.approx(0.25, abs=turn)
    assert touched['d'] == pytest.approx(0.004, abs=way + FINGER_RADIUS * turn)


def test_published_time_stops_where_an_object_is_let_go(bench, plant):
    node = plant(
        **{'publish_clock': True, 'sensor_rate': 50.0, 'command_timeout': 10.0},
        **{'theta_initial': 0.0, 'd_initial': 0.0},
    )
    bench.hear(Clock, CLOCK)
    bench.hear(PoseStamped, TRUE_POSE)
    clocks, poses = bench.heard[CLOCK], bench.heard[TRUE_POSE]
    commands = bench.publisher(TwistStamped, COMMAND)
    decisions = bench.publisher(JointState, PLACE_STATE)
    release = bench.publisher(Bool, PLACE_RELEASE)

    def wait():
        """Wait until time is published again and again and stands, and return it [s]."""
        bench.until(lambda: len(clocks) > 5 and all(one == clocks[-1] for one in clocks[-6:]))
        return clocks[-1].clock.sec + clocks[-1].clock.nanosec * 1e-9

    ahead = command(0.0)
    bench.until(lambda: clocks)
    ahead.header.stamp = clocks[-1].clock
    commands.publish(ahead)
    due = wait()
    decision = JointState(name=['let_go_in'], position=[0.051])
    decision.header.stamp = ahead.header.stamp = clocks[-1].clock
    decisions.publish(decision)
    bench.until(lambda: node._pace.stop_before(due, due + 1.0) < due + 1.0)
    commands.publish(ahead)
    bench.until(lambda: clocks[-1].clock != decision.header.stamp)
    let_go = wait()
    assert let_go == pytest.approx(due + 0.051, abs=2e-6)
    release.publish(Bool(data=True))
    seen = len(poses)
    bench.until(lambda: len(poses) > seen)
    pose = poses[seen]
    sec, nanosec = stamp_of(pose)
    # The finger has carried the object straight ahead up to then; now the belt carries it back.
    gone = sec + nanosec * 1e-9 - let_go
    assert 0.0 < gone < 0.02
    assert pose.pose.position.y == pytest.approx(0.0135 + 0.02375 - 0.005 * gone, abs=1e-9)


def test_published_time_grows_by_the_sensors_period(bench, plant):
    plant(publish_clock=True)
    bench.hear(Clock, CLOCK)
    bench.until(lambda: len({message.clock.nanosec for message in bench.heard[CLOCK]}) > 3)
    times = [message.clock.sec * 10**9 + message.clock.nanosec for message in bench.heard[CLOCK]]
    assert times == sorted(times)
    assert all(time % 10_000_000 == 0 for time in times)


def test_a_fault_takes_effect_while_it_runs_and_is_a_warning(bench, plant):
    node = plant()
    (answer,) = node.set_parameters([RosParameter('belt_stopped', value=True)])
    assert answer.successful
    assert bench.health == (WARN, 'belt stands, waiting for the first command, with belt_stopped')
    bench.hear(JointState, TRUE_STATE)
    bench.publisher(TwistStamped, COMMAND).publish(command(0.01))
    bench.until(lambda: bench.heard[TRUE_STATE] and bench.values(TRUE_STATE)['finger_x'] > 1e-4)
    assert bench.values(TRUE_STATE)['belt_travel'] == 0.0


def test_faults_that_do_not_fit_together_are_refused_while_it_runs(bench, plant):
    node = plant(workspace_max=0.1)
    (answer,) = node.set_parameters([RosParameter('workspace_min', value=0.2)])
    assert not answer.successful
    assert 'workspace' in answer.reason
    assert node._rig.faults.workspace.lower == -math.inf
