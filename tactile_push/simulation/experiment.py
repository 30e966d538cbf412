# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""One run of the rig through sensor, finger and the steps that the nodes run, without nodes."""

import math
from collections.abc import Iterator
from itertools import count
from typing import TYPE_CHECKING

from tactile_push.control import (
    PUSHING,
    WAITING,
    Limits,
    PushControl,
    PushLaw,
    Steadying,
    Tick,
)
from tactile_push.interface import JOINT_STATES, TOPICS, WRIST_JOINT
from tactile_push.pipeline import Control, Geometry, Stamp
from tactile_push.simulation.faults import NO_FAULTS, Faults
from tactile_push.simulation.joint_rig import Mover
from tactile_push.simulation.rig import Rig, RigConfig
from tactile_push.simulation.rollout import Rollout, check_time
from tactile_push.simulation.sensor import Readout
from tactile_push.simulation.trace import Trace
from tactile_push.tactile import ContactFinder
from tactile_push.tactile.pole_history import JOINT_STATE_TIMEOUT

if TYPE_CHECKING:
    from tactile_push.simulation.mujoco_rig import MujocoRig

JOINTS = (*TOPICS[JOINT_STATES].field_names, WRIST_JOINT)
ANGLES = ('azimuth', 'elevation')


def experiment(
    config: RigConfig,
    law: PushLaw,
    steps: int,
    period: float = 0.1,
    *,
    faults: Faults = NO_FAULTS,
    sensor_rate: float | None = None,
    limits: Limits | None = None,
    steadying: Steadying | None = None,
    seed: int = 0,
) -> Rollout:
    """Run the control law on the rig, through its sensor and its finger.

    The belt stands until the first contact, with which step 0 begins.

    Parameters
    ----------
    config : RigConfig
        The rig and where it starts.
    law : PushLaw
        The control law. It starts over, and the run changes it.
    steps : int
        Number of control periods.
    period : float, optional
        Control period [s].
    faults : Faults, optional
        Faults of the rig; none by default.
    sensor_rate : float, optional
        Readings a second [Hz], a whole number in each control period; one by default.
    limits : Limits, optional
        When the controller stops, which ends the run, and how fast it may go.
    steadying : Steadying, optional
        What trims theta_d; nothing by default. The run changes it.
    seed : int, optional
        Seed of the random numbers: the same seed gives the same run to the bit.

    Returns
    -------
    Rollout
        The true trajectory, not the sensed one; shorter than `steps` if the controller stops, and
        empty if there never was a contact.

    Raises
    ------
    ValueError
        If a number is out of its range.
    """
    check_time(steps, period)
    share = 1.0 if sensor_rate is None else sensor_rate * period
    readings = round(share) if math.isfinite(share) else 0
    if not (readings >= 1 and math.isclose(readings, share)):
        raise ValueError(
            f'sensor_rate: expected a whole number of readings a control period, got {share}'
        )
    rig = Rig(config, faults)
    push = PushControl(law, config.belt_speed, period, limits, steadying)
    trace, end = Trace(), 'done'
    for tick in control_periods(rig, push, readings, seed):
        if tick.state == PUSHING:
            trace.add(rig, tick.phi)
            if len(trace) > steps:
                break
        elif not _waits(tick, push):
            trace.close(rig)
            end = tick.stop_reason or tick.state
            break
    return trace.run(end)


def control_periods(
    rig: 'Rig | MujocoRig',
    push: PushControl,
    readings: int,
    seed: int,
    move: Mover | None = None,
) -> Iterator[Tick]:
    """Run a control on a rig, through sensor and finger, for as long as somebody asks.

    Parameters
    ----------
    rig : Rig or MujocoRig
        The rig. Its belt stands until the control pushes.
    push : PushControl
        The control, which this activates.
    readings, seed : int
        Readings of the sensor in each control period, and seed of their errors.
    move : callable, optional
        Moves the rig by a command, as `servoed` does; `rig.step` by default.

    Yields
    ------
    Tick
        What the control used and gave in each control period, before the rig moves.
    """
    finger, period = rig.config.finger, push.period
    readout = Readout(rig.faults.sensor, seed)
    finder = ContactFinder(
        rig.config.radius,
        joint_state_timeout=JOINT_STATE_TIMEOUT,
        mount_angle=finger.mount_angle,
    )

    def seconds(k: int, i: int) -> float:
        """Return the time of a stamp, which counts control periods and readings in a period."""
        return (k + i / readings) * period

    push.activate(0.0)
    names = JOINTS[: len(rig.joints)]
    geometry = Geometry(finder, names, seconds)
    control = Control(push, finger, names, seconds)

    def feel(stamp: Stamp) -> None:
        """Read joints and sensor, and pass the contacts found to the controller."""
        joints = rig.joints
        geometry.joint_states(stamp, names, joints)
        control.joint_states(stamp, names, joints)
        for sample in readout.read(rig.reading(), seconds(*stamp)):
            if sample.reading is not None:
                angles = sample.reading.azimuth, sample.reading.elevation
                felt = geometry.tactile(stamp, ANGLES, angles)
                if felt.contact is not None:
                    control.contact(stamp, felt.contact.theta)

    feel((0, 0))
    for k in count():
        tick = control.tick((k, 0))
        yield tick
        waiting = _waits(tick, push)
        for i in range(readings):
            duration, v_x = period / readings, tick.v_x or 0.0
            if move is None:
                rig.step(v_x, duration, not waiting, tick.v_y)
            else:
                move(v_x, duration, not waiting)
            feel((k, i + 1))


def _waits(tick: Tick, push: PushControl) -> bool:
    """Return whether the control waits for the first contact, and has not done so for too long."""
    return tick.state == WAITING and tick.silence < push.limits.contact_timeout
