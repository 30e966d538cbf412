# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Faults of a force/torque sensor under the finger tip."""

import itertools
import math
from collections.abc import Callable

from geometry_msgs.msg import WrenchStamped

from tactile_push.interface import FORCE_TORQUE, WRENCH, WRENCH_SENSOR

from .bench import Bench, spoiled_until_stopped
from .promise import SILENT, Setup, fault

FELT = Setup(relay=WRENCH, sensor=FORCE_TORQUE)
TOO_MUCH = 0.05  # of torsion [N m]


def _stops(
    bench: Bench, words: str, alter: Callable[[WrenchStamped], WrenchStamped | None]
) -> None:
    spoiled_until_stopped(bench, WRENCH_SENSOR, words, alter)


@fault('wrench sensor killed', SILENT, setup=FELT)
def wrench_sensor_killed(bench: Bench) -> None:
    """Contact silent; a new one lets it push on."""
    finger = bench.finger
    at = finger.kill(WRENCH_SENSOR)
    bench.stopped(at)
    finger.expect_reason('contact silent')
    finger.begin(WRENCH_SENSOR)
    finger.wait_until_moving(10.0)


@fault('wrench silent', SILENT, setup=FELT)
def wrench_silent(bench: Bench) -> None:
    """Contact silent; ERROR; pushes on."""
    _stops(bench, 'no wrenches', lambda message: None)


@fault('wrench not finite', SILENT, setup=FELT)
def wrench_not_finite(bench: Bench) -> None:
    """Contact silent; ERROR says why; pushes on."""
    values = itertools.cycle((math.nan, math.inf, -math.inf))

    def spoil(message: WrenchStamped) -> WrenchStamped:
        message.wrench.torque.y = next(values)
        return message

    _stops(bench, 'not finite', spoil)


@fault('wrench ten times a second', SILENT, setup=FELT)
def wrench_slow(bench: Bench) -> None:
    """Contact silent; ERROR tells the time between two; pushes on."""
    numbers = itertools.count()
    _stops(bench, 'too long after', lambda message: None if next(numbers) % 10 else message)


@fault('wrench in another frame', SILENT, setup=FELT)
def wrench_in_another_frame(bench: Bench) -> None:
    """Contact silent; ERROR says why; pushes on."""

    def move(message: WrenchStamped) -> WrenchStamped:
        message.header.frame_id = 'wrist'
        return message

    _stops(bench, 'another frame', move)


@fault('wrench with the other sign', SILENT, setup=FELT)
def wrench_with_the_other_sign(bench: Bench) -> None:
    """Contact silent; ERROR names the parameter; pushes on."""

    def turn_over(message: WrenchStamped) -> WrenchStamped:
        for part in (message.wrench.force, message.wrench.torque):
            part.x, part.y, part.z = -part.x, -part.y, -part.z
        return message

    _stops(bench, 'contact behind the tip', turn_over)


@fault('wrench of no single contact', SILENT, setup=FELT)
def wrench_of_no_single_contact(bench: Bench) -> None:
    """Contact silent; ERROR says what may be wrong; pushes on."""

    def twist(message: WrenchStamped) -> WrenchStamped:
        message.wrench.torque.z += TOO_MUCH
        return message

    _stops(bench, 'torsion', twist)
