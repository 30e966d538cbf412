# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The paper's block, pushed on contacts that are stamped by another clock than the ticks."""

import math
from collections.abc import Iterator
from dataclasses import replace
from functools import partial
from typing import NamedTuple

import numpy as np

from tactile_push.control import Tick
from tactile_push.parameters.push_controller import (
    PushControllerParameters,
    make_control,
    make_finger,
)
from tactile_push.pipeline import Control, Fields, Stamp, edge_angle
from tactile_push.pipeline.messages import pose_fields
from tactile_push.pipeline.stamps import epoch_of, seconds_since
from tactile_push.simulation import paper_block
from tactile_push.simulation.rig import Rig

NOISE = math.radians(0.2)  # of the readings [rad]
START = 1_700_000_000  # of the first period [s]
PERIOD, READINGS = 100_000_000, 5  # of the control [ns], and readings in it
seconds = partial(seconds_since, epoch_of(START))


class Period(NamedTuple):
    """A control period: the contacts that came before it, and what became of it."""

    stamp: Stamp
    contacts: list[Fields]
    tick: Tick
    control: Control
    true_d: float


def periods(ahead: int, count: int) -> Iterator[Period]:
    """Yield control periods while the sensor's clock is ahead by so many nanoseconds."""
    p = PushControllerParameters()
    rig = Rig(replace(paper_block(), tip_turns=True))
    random = np.random.default_rng(0)
    control = Control(make_control(p), make_finger(p), p.joint_names, seconds)
    control.push.activate(0.0)
    contacts: list[Fields] = []
    for now in range(START * 10**9, START * 10**9 + count * PERIOD, PERIOD):
        stamp = divmod(now, 10**9)
        tick = control.tick(stamp)
        yield Period(stamp, contacts, tick, control, rig.d)
        contacts = []
        for k in range(READINGS):
            share = PERIOD // READINGS
            rig.step(tick.v_x or 0.0, share * 1e-9, belt_running=tick.v_x is not None)
            joints_at = divmod(now + (k + 1) * share, 10**9)
            control.joint_states(joints_at, p.joint_names, rig.joints)
            theta = rig.theta + NOISE * random.standard_normal()
            at = divmod(now + (k + 1) * share + ahead, 10**9)
            contacts.append(pose_fields(at, 0.0, 0.0, theta))
            turn = contacts[-1]['pose']['orientation']
            control.contact(at, edge_angle('', 0.0, 0.0, turn['z'], turn['w']))
