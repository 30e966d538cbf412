# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Faults of a finger that `finger_servo` moves by its joints."""

import math
import signal
import time

from lifecycle_msgs.msg import Transition
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64MultiArray

from tactile_push.interface import FINGER_SERVO as SERVO
from tactile_push.interface import JOINT_STATES
from tactile_push.testing import field

from .bench import Bench, expect
from .finger import MOVING, Finger
from .promise import COMMAND_LOST, JOINTS_LOST, ONE_PERIOD, SIGNAL, Setup, fault

SERVOED = Setup(servo=True, relay=JOINT_STATES)
WITHOUT_SERVO = 0.6  # for so long a drive is watched that has lost its servo [s]
FOREIGN = [0.02, 0.0]  # velocities of somebody else, so slow that the finger follows [rad/s]
NEAR = 0.01  # as far are the joint limits from where the second joint is [rad]
BEYOND = 0.7  # from the angle of the edge to one that turns phi round in three seconds [rad]
PERIODS = 0.1  # of the plant, in which it tells where it stands [s]
# Commanded way after which a drive that stands is noticed, 2.2 mm, and what it goes meanwhile [m].
NOTICED = 3e-3


def _change(bench: Bench, transition: int) -> None:
    done = bench.observer.change_state(bench.finger.name(SERVO), transition)
    expect(done, f'transition {transition} was refused')


def _activate_anew(bench: Bench) -> None:
    _change(bench, Transition.TRANSITION_DEACTIVATE)
    _change(bench, Transition.TRANSITION_ACTIVATE)


def _goes_on(finger: Finger) -> None:
    """Let the law ask for the other angle, and wait for the finger to move."""
    finger.turn()
    finger.wait_until_moving(10.0)


def _spoil(bench: Bench, reason: str, alter: object) -> None:
    """Spoil the joint states until the servo stops, and mend them."""
    finger = bench.finger
    finger.relay.alter = alter  # type: ignore[assignment]
    bench.stopped(time.monotonic())
    finger.expect_servo(reason)
    finger.relay.mend()


@fault('servo deactivated', SIGNAL, setup=SERVOED)
def servo_deactivated(bench: Bench) -> None:
    """Sends last zeros and falls silent; follows when it is active again."""
    finger = bench.finger
    at = time.monotonic()
    _change(bench, Transition.TRANSITION_DEACTIVATE)
    bench.stopped(at)
    said = len(finger.velocities)
    bench.observer.spin(0.3)
    expect(len(finger.velocities) == said, 'an inactive servo commands')
    _change(bench, Transition.TRANSITION_ACTIVATE)
    _goes_on(finger)


@fault('servo gets SIGTERM', SIGNAL, setup=SERVOED)
def servo_terminated(bench: Bench) -> None:
    """Sends last zeros; exit status 0; a new one follows."""
    finger = bench.finger
    bench.stopped(finger.signal(SERVO, signal.SIGTERM))
    status = finger.ended(SERVO)
    expect(status == 0, f'exit status {status}')
    finger.begin(SERVO)
    _goes_on(finger)


@fault('servo killed', setup=SERVOED)
def servo_killed(bench: Bench) -> None:
    """The drive keeps its last velocities, as ros2_control does; a new servo ends them."""
    finger = bench.finger
    at = finger.kill(SERVO)
    bench.observer.spin(WITHOUT_SERVO)
    moved = [field(message, 'v_x') for message in finger.truth.since(at)]
    expect(abs(moved[-1]) > MOVING, 'the drive stopped, so this row shows nothing')
    controller = finger.name('push_controller')
    bench.observer.change_state(controller, Transition.TRANSITION_DEACTIVATE)
    begun = time.monotonic()
    finger.begin(SERVO)
    finger.stopped(begun, 10.0)
    bench.observer.change_state(controller, Transition.TRANSITION_ACTIVATE)
    _goes_on(finger)


@fault('servo stopped, continued', setup=SERVOED)
def servo_stopped(bench: Bench) -> None:
    """The drive keeps its last velocities; the servo goes on or says why not; no kick."""
    finger = bench.finger
    finger.signal(SERVO, signal.SIGSTOP)
    bench.observer.spin(WITHOUT_SERVO)
    finger.signal(SERVO, signal.SIGCONT)
    _goes_on(finger)


@fault('servo without commands', COMMAND_LOST, setup=SERVOED)
def commands_silent(bench: Bench) -> None:
    """Command silent; follows a new controller."""
    finger = bench.finger
    bench.stopped(finger.kill('push_controller'))
    finger.expect_servo('command silent')
    finger.begin('push_controller')
    finger.activate()
    finger.wait_until_moving(10.0)


@fault('servo without joint states', JOINTS_LOST, setup=SERVOED)
def joint_states_silent(bench: Bench) -> None:
    """Finger position unknown; follows when they come again."""
    _spoil(bench, 'finger position unknown', lambda message: None)
    bench.finger.wait_until_moving(10.0)


@fault('servo with joint states of other joints', JOINTS_LOST, setup=SERVOED)
def joint_states_of_others(bench: Bench) -> None:
    """Finger position unknown, and says which names; follows when they come again."""

    def rename(message: JointState) -> JointState:
        message.name = ['wheel', 'distal_joint']
        return message

    _spoil(bench, 'finger position unknown', rename)
    bench.finger.wait_until_moving(10.0)


@fault('servo with a drive that stands', setup=SERVOED)
def drive_that_stands(bench: Bench) -> None:
    """Finger does not follow, after 2.3 mm of commanded way, until activated anew."""
    finger = bench.finger
    held: list[float] = []

    def hold(message: JointState) -> JointState:
        held[:] = held or message.position
        message.position = held
        return message

    begun = finger.ground_truth('finger_x')  # which goes on; its joint states tell of none of it
    finger.relay.alter = hold
    finger.expect_servo('finger does not follow', patience=20.0)
    finger.stopped(time.monotonic())
    way = abs(finger.ground_truth('finger_x') - begun)
    expect(way < NOTICED, f'noticed after {1e3 * way:.1f} mm')
    finger.relay.mend()
    bench.observer.spin(0.3)
    finger.expect_servo('finger does not follow')
    _activate_anew(bench)
    _goes_on(finger)


@fault('servo with joint states that jump', ONE_PERIOD, setup=SERVOED)
def joint_states_jump(bench: Bench) -> None:
    """Finger does not follow, until activated anew; no kick."""

    def jump(message: JointState) -> JointState:
        message.position = [message.position[0] + 0.2, message.position[1]]
        return message

    _spoil(bench, 'finger does not follow', jump)
    _activate_anew(bench)
    _goes_on(bench.finger)


@fault('joint velocities of another', ONE_PERIOD, setup=SERVOED)
def another_commander(bench: Bench) -> None:
    """Another command, until activated anew."""
    finger = bench.finger
    topic = finger.name('finger_velocity_controller/commands')
    at = bench.observer.publish(topic, Float64MultiArray(data=FOREIGN))
    bench.stopped(at)
    finger.expect_servo('another command')
    _activate_anew(bench)
    _goes_on(finger)


@fault('joint limit', setup=SERVOED)
def joint_limit(bench: Bench) -> None:
    """The finger stands at it, and comes back from it by itself."""
    finger = bench.finger
    _change(bench, Transition.TRANSITION_DEACTIVATE)  # a drive without its servo would go on
    finger.kill(SERVO)
    bench.observer.spin(PERIODS)
    _, distal = finger.joints()
    finger.begin(SERVO, joint_min=[-3.0, distal - NEAR], joint_max=[3.0, distal + NEAR])
    finger.expect_servo('joint limit', patience=20.0)
    _, at_limit = finger.joints()
    expect(abs(at_limit - distal) <= NEAR, f'{abs(at_limit - distal) - NEAR:.4f} rad beyond it')
    # The object turns on against the standing finger. An angle beyond it is what asks for the way
    # back, whatever the rows before have made of the object.
    beyond = math.copysign(BEYOND, -field(finger.states[-1], 'v_x'))
    finger.ask_for(finger.ground_truth('theta') + beyond)
    finger.wait_until_moving(10.0)
    finger.kill(SERVO)
    finger.begin(SERVO)
    _goes_on(finger)
