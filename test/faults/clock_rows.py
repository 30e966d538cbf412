# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Clocks that jump: simulated time, given by the tool, and the system's, as logic alone."""

import math

from tactile_push.control import CLOCK_JUMPED, Limits, PushControl, PushLaw

from .bench import Bench, expect
from .promise import NO_BENCH, ONE_PERIOD, Setup, fault

OWN_CLOCK = Setup(own_clock=True)
PERIOD = 0.1  # of the control [s]


def _jumps(bench: Bench, seconds: float, *reasons: str) -> None:
    finger = bench.finger
    assert bench.clock is not None
    bench.stopped(bench.clock.jump(seconds))
    finger.expect_reason(*reasons)
    finger.expect_rest(finger.reason)
    finger.resume()


@fault('clock jumps 10 s ahead', ONE_PERIOD, setup=OWN_CLOCK)
def clock_ahead(bench: Bench) -> None:
    """Clock jumped, or ticks lost; resumes by service."""
    _jumps(bench, 10.0, 'clock jumped', 'ticks lost')


@fault('clock jumps 10 s back', ONE_PERIOD, setup=OWN_CLOCK)
def clock_back(bench: Bench) -> None:
    """Clock jumped; resumes by service."""
    _jumps(bench, -10.0, 'clock jumped')


@fault('clock jumps 0.5 s back', ONE_PERIOD, setup=OWN_CLOCK)
def clock_back_a_little(bench: Bench) -> None:
    """Clock jumped; resumes by service."""
    _jumps(bench, -0.5, 'clock jumped')


@fault('clock jumps 864 s back', ONE_PERIOD, setup=OWN_CLOCK)
def clock_back_a_lot(bench: Bench) -> None:
    """Clock jumped; resumes by service."""
    _jumps(bench, -864.0, 'clock jumped')


@fault('system clock set (logic alone)', setup=NO_BENCH)
def system_clock_set(bench: Bench) -> None:
    """Clock jumped at the next tick, both ways; resumes when told to."""
    for jump in (-3600.0, -1.0, 1.0, 3600.0):
        control = PushControl(PushLaw(0.05, 5.0, 0.0), 0.005, PERIOD, Limits())
        control.activate(0.0)
        for k in range(1, 40):
            now = k * PERIOD + (jump if k >= 20 else 0.0)
            control.feel(math.radians(20.0), now)
            tick = control.tick(now, PERIOD)
            if k == 20:
                expect(
                    (tick.v_x, tick.stop_reason) == (0.0, CLOCK_JUMPED),
                    f'{jump:g} s: {tick.state} {tick.stop_reason}',
                )
            elif k < 30:
                expect((tick.v_x == 0.0) == (k == 1 or k >= 20), f'{jump:g} s: v_x = {tick.v_x}')
            if k == 30:
                expect(control.resume(), f'{jump:g} s: does not resume')
        expect(tick.v_x != 0.0, f'{jump:g} s: does not move after resuming')
