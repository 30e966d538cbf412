# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Faults of the joint states, from which the finger's direction and place follow."""

import itertools
import math
import time
from collections.abc import Callable

from sensor_msgs.msg import JointState

from tactile_push.nodes.ros.diagnostics import WARN

from .finger import Finger
from .promise import SILENT, Setup, fault
from .relay import JointRelay
from .rig import Rig, expect

RELAYED = Setup(relay_joints=True)
SPOILED = 2.0  # for so long a fault that need not stop the finger lasts [s]
LATE = 0.5  # [s]


def _stops_and_goes_on(rig: Rig) -> None:
    """Wait for the stop, mend the joint states, and wait for the finger to move again."""
    finger = rig.finger
    rig.stopped(time.monotonic())
    finger.expect_reason('finger position unknown', 'contact silent')
    _relay(finger).mend()
    finger.wait_until_moving(10.0)


def _goes_on(rig: Rig, alter: Callable[[JointState], JointState]) -> None:
    """Spoil the joint states for a while, mend them, and wait for the finger to move again."""
    finger = rig.finger
    _relay(finger).alter = alter
    rig.observer.spin(SPOILED)
    finger.rest_or_push()
    _relay(finger).mend()
    finger.wait_until_moving()


def _relay(finger: Finger) -> JointRelay:
    assert finger.relay is not None
    return finger.relay


@fault('joint states silent', SILENT, setup=RELAYED)
def joint_states_silent(rig: Rig) -> None:
    """Finger position unknown, or contact silent; pushes on."""
    _relay(rig.finger).alter = lambda message: None
    _stops_and_goes_on(rig)


@fault('joint states missing', SILENT, setup=RELAYED)
def joint_states_missing(rig: Rig) -> None:
    """A geometry that has never heard any gives no contact; pushes on when they come."""
    finger = rig.finger
    _relay(finger).alter = lambda message: None
    at = finger.kill('contact_geometry')
    rig.stopped(at)
    finger.start('contact_geometry')
    finger.expect_level('contact_geometry', WARN, 5.0)
    expect(not finger.after(finger.contacts, at + LATE), 'there are contacts')
    _relay(finger).mend()
    finger.wait_until_moving(10.0)


@fault('joint states not finite', SILENT, setup=RELAYED)
def joint_states_not_finite(rig: Rig) -> None:
    """Finger position unknown, or contact silent; pushes on."""
    values = itertools.cycle((math.nan, math.inf, -math.inf))

    def spoil(message: JointState) -> JointState:
        message.position = [next(values)] * len(message.position)
        return message

    _relay(rig.finger).alter = spoil
    _stops_and_goes_on(rig)


@fault('joint states of other joints', SILENT, setup=RELAYED)
def joint_states_of_others(rig: Rig) -> None:
    """Finger position unknown, or contact silent; pushes on."""

    def rename(message: JointState) -> JointState:
        message.name = ['wheel', 'distal_joint']
        return message

    _relay(rig.finger).alter = rename
    _stops_and_goes_on(rig)


@fault('joint states without positions', SILENT, setup=RELAYED)
def joint_states_without_positions(rig: Rig) -> None:
    """Finger position unknown, or contact silent; pushes on."""

    def empty(message: JointState) -> JointState:
        message.position = []
        return message

    _relay(rig.finger).alter = empty
    _stops_and_goes_on(rig)


@fault('joint states late', SILENT, setup=RELAYED)
def joint_states_late(rig: Rig) -> None:
    """Finger position unknown, or contact silent; pushes on."""
    _relay(rig.finger).delay = LATE
    _stops_and_goes_on(rig)


@fault('joint states jump', setup=RELAYED)
def joint_states_jump(rig: Rig) -> None:
    """Goes on or stops and says why; no kick; pushes again."""
    sides = itertools.cycle((-0.5, 0.5))

    def jump(message: JointState) -> JointState:
        message.position = [message.position[0] + next(sides), message.position[1]]
        return message

    _goes_on(rig, jump)


@fault('joint states jump once', setup=RELAYED)
def joint_states_jump_once(rig: Rig) -> None:
    """Goes on or stops and says why; no kick; pushes again."""

    def shift(message: JointState) -> JointState:
        message.position = [message.position[0] + 0.2, message.position[1]]
        return message

    _goes_on(rig, shift)
