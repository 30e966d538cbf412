# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Two fingers side by side, each in its namespace: a fault of one is none of the other."""

import itertools
import signal

from .bench import Bench, expect
from .promise import COMMAND_LOST, SILENT, Setup, fault

PAIR = Setup(fingers=('left', 'right'))
LONGEST_PAUSE = 0.25  # between commands of a finger that has no fault [s]


def _right_is_unaffected(bench: Bench, since: float) -> None:
    right = bench.fingers[1]
    reasons = right.reasons_since(since) - {''}
    expect(not reasons, f'the right finger stopped: {", ".join(reasons)}')
    moments = [at for at in right.commands.times if at > since]
    pause = max(b - a for a, b in itertools.pairwise(moments))
    expect(pause < LONGEST_PAUSE, f'the right finger paused for {1000.0 * pause:.0f} ms')


@fault('pair: driver of the left killed', SILENT, setup=PAIR)
def pair_driver_killed(bench: Bench) -> None:
    """The left stops and pushes on with a new driver; the right goes on all the time."""
    left = bench.finger
    at = left.kill('sensor_driver')
    bench.stopped(at)
    left.begin('sensor_driver')
    left.wait_until_moving(10.0)
    _right_is_unaffected(bench, at)


@fault('pair: controller of the left killed', COMMAND_LOST, setup=PAIR)
def pair_controller_killed(bench: Bench) -> None:
    """The left stops; the right goes on all the time."""
    left = bench.finger
    at = left.kill('push_controller')
    bench.stopped(at)
    left.begin('push_controller')
    left.activate()
    left.wait_until_moving(10.0)
    _right_is_unaffected(bench, at)


@fault('pair: geometry of the left stopped', SILENT, setup=PAIR)
def pair_geometry_stopped(bench: Bench) -> None:
    """The left stops; the right goes on all the time."""
    left = bench.finger
    at = left.signal('contact_geometry', signal.SIGSTOP)
    bench.stopped(at)
    left.signal('contact_geometry', signal.SIGCONT)
    left.wait_until_moving()
    _right_is_unaffected(bench, at)
