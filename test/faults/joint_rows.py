# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Faults of the joint states, from which the finger's direction and place follow."""

import itertools
import math
import time
from collections.abc import Callable

from sensor_msgs.msg import JointState

from tactile_push.interface import JOINT_STATES
from tactile_push.nodes.ros.diagnostics import ERROR, WARN

from .bench import Bench, expect
from .promise import SILENT, Setup, fault

RELAYED = Setup(relay=JOINT_STATES)
SPOILED = 2.0  # for so long a fault that need not stop the finger lasts [s]
LATE = 0.5  # [s]


def _stops_and_goes_on(bench: Bench) -> None:
    """Wait for the stop, mend the joint states, and wait for the finger to move again."""
    finger = bench.finger
    bench.stopped(time.monotonic())
    finger.expect_reason('finger position unknown', 'contact silent')
    finger.relay.mend()
    finger.wait_until_moving(10.0)


def _goes_on(bench: Bench, alter: Callable[[JointState], JointState]) -> None:
    """Spoil the joint states for a while, mend them, and wait for the finger to move again."""
    finger = bench.finger
    finger.relay.alter = alter
    bench.observer.spin(SPOILED)
    finger.rest_or_push()
    finger.relay.mend()
    finger.wait_until_moving()


@fault('joint states silent', SILENT, setup=RELAYED)
def joint_states_silent(bench: Bench) -> None:
    """Finger position unknown, or contact silent; pushes on."""
    bench.finger.relay.alter = lambda message: None
    _stops_and_goes_on(bench)


@fault('joint states missing', SILENT, setup=RELAYED)
def joint_states_missing(bench: Bench) -> None:
    """A geometry that has never heard any gives no contact; pushes on when they come."""
    finger = bench.finger
    finger.relay.alter = lambda message: None
    at = finger.kill('contact_geometry')
    bench.stopped(at)
    finger.begin('contact_geometry')
    finger.expect_level('contact_geometry', WARN, 5.0)
    expect(not finger.contacts.since(at + LATE), 'there are contacts')
    finger.relay.mend()
    finger.wait_until_moving(10.0)


@fault('joint states not finite', SILENT, setup=RELAYED)
def joint_states_not_finite(bench: Bench) -> None:
    """Finger position unknown, or contact silent; pushes on."""
    values = itertools.cycle((math.nan, math.inf, -math.inf))

    def spoil(message: JointState) -> JointState:
        message.position = [next(values)] * len(message.position)
        return message

    bench.finger.relay.alter = spoil
    _stops_and_goes_on(bench)


@fault('joint states of other joints', SILENT, setup=RELAYED)
def joint_states_of_others(bench: Bench) -> None:
    """Finger position unknown, or contact silent; pushes on."""

    def rename(message: JointState) -> JointState:
        message.name = ['wheel', 'distal_joint']
        return message

    bench.finger.relay.alter = rename
    _stops_and_goes_on(bench)


@fault('joint states of one joint each', SILENT, setup=RELAYED)
def joint_states_of_one_joint_each(bench: Bench) -> None:
    """Finger position unknown, or contact silent; pushes on."""
    joints = itertools.cycle((0, 1))

    def split(message: JointState) -> JointState:
        joint = next(joints)
        message.name, message.position = [message.name[joint]], [message.position[joint]]
        return message

    bench.finger.relay.alter = split
    _stops_and_goes_on(bench)


@fault('joint names misspelt', SILENT)
def joint_names_misspelt(bench: Bench) -> None:
    """Finger position unknown, and says which names; pushes with the right ones."""
    finger = bench.finger
    finger.kill('push_controller')
    finger.begin('push_controller', joint_names=['proximal_joint', 'distal_jiont'])
    finger.activate()
    bench.stopped(time.monotonic())
    finger.expect_reason('finger position unknown')
    finger.expect_level('push_controller', ERROR)
    words = finger.status('push_controller').message
    expect('got no distal_jiont, but proximal_joint, distal_joint' in words, words)
    finger.kill('push_controller')
    finger.begin('push_controller')
    finger.activate()
    finger.push(10.0)


@fault('joint states without positions', SILENT, setup=RELAYED)
def joint_states_without_positions(bench: Bench) -> None:
    """Finger position unknown, or contact silent; pushes on."""

    def empty(message: JointState) -> JointState:
        message.position = []
        return message

    bench.finger.relay.alter = empty
    _stops_and_goes_on(bench)


@fault('joint states late', SILENT, setup=RELAYED)
def joint_states_late(bench: Bench) -> None:
    """Finger position unknown, or contact silent; pushes on."""
    bench.finger.relay.delay = LATE
    _stops_and_goes_on(bench)


@fault('joint states jump', setup=RELAYED)
def joint_states_jump(bench: Bench) -> None:
    """Goes on or stops and says why; no kick; pushes again."""
    sides = itertools.cycle((-0.5, 0.5))

    def jump(message: JointState) -> JointState:
        message.position = [message.position[0] + next(sides), message.position[1]]
        return message

    _goes_on(bench, jump)


@fault('joint states jump once', setup=RELAYED)
def joint_states_jump_once(bench: Bench) -> None:
    """Goes on or stops and says why; no kick; pushes again."""

    def shift(message: JointState) -> JointState:
        message.position = [message.position[0] + 0.2, message.position[1]]
        return message

    _goes_on(bench, shift)
