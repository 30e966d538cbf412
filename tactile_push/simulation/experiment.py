# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""One run through the rig's finger and sensor: what the nodes would do, without the nodes."""

import math
from contextlib import suppress
from itertools import count

import numpy as np

from tactile_push.control import PUSHING, WAITING, Limits, PushControl, PushLaw
from tactile_push.simulation.faults import NO_FAULTS, Faults
from tactile_push.simulation.rig import Rig, RigConfig
from tactile_push.simulation.rollout import MODE, QUANTITIES, Rollout, check_time
from tactile_push.simulation.sensor import Readout
from tactile_push.tactile import ContactFinder, ReadingRejectedError

JOINT_STATE_TIMEOUT = 0.1  # as the node contact_geometry has it [s]


def experiment(
    config: RigConfig,
    law: PushLaw,
    steps: int,
    period: float = 0.1,
    *,
    faults: Faults = NO_FAULTS,
    sensor_rate: float | None = None,
    limits: Limits | None = None,
    seed: int = 0,
) -> Rollout:
    """Run the control law on the rig, through its sensor and its finger.

    The belt stands until the first contact; step 0 begins with it.

    Parameters
    ----------
    config : RigConfig
        The rig and where it starts.
    law : PushLaw
        The control law, which starts over and is changed.
    steps : int
        Number of control periods.
    period : float, optional
        Control period [s].
    faults : Faults, optional
        How far the rig is from a perfect one.
    sensor_rate : float, optional
        Readings a second, a whole number of them a control period [Hz]; one each by default.
    limits : Limits, optional
        When the controller stops, which ends the run, and how fast it goes at the most.
    seed : int, optional
        Seed of what chance decides: the same one gives the same run, to the bit.

    Returns
    -------
    Rollout
        The trajectory as it was, not as it was sensed; shorter than `steps` if the controller
        stops, and empty if there never was a contact.

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
    rig, readout = Rig(config, faults), Readout(faults.sensor, seed)
    finder = ContactFinder(
        config.radius,
        joint_state_timeout=JOINT_STATE_TIMEOUT,
        mount_angle=config.finger.mount_angle,
    )
    control = PushControl(law, config.belt_speed, period, limits)
    control.activate(0.0)
    _feel(rig, readout, finder, control, 0.0)
    history = np.full((steps + 1, QUANTITIES), np.nan)
    done, end = 0, 'done'
    for k in count():
        tick = control.tick(k * period)
        waiting = tick.state == WAITING and tick.silence < control.limits.contact_timeout
        if not (waiting or tick.state == PUSHING):
            end = tick.stop_reason or tick.state
            break
        if not waiting:
            pose = rig.object_pose
            history[done] = rig.theta, tick.phi, rig.d, pose.x, pose.y, rig.mode
            if done == steps:
                done += 1
                break
        for i in range(readings):
            rig.step(tick.v_x or 0.0, period / readings, belt_running=not waiting)
            _feel(rig, readout, finder, control, (k + (i + 1) / readings) * period)
        if not waiting:
            history[done, MODE] = rig.mode
            done += 1
    theta, phi, d, x, y, mode = history[:done].T
    return Rollout(theta, phi, d, x, y, mode.astype(np.int64), end)


def _feel(
    rig: Rig, readout: Readout, finder: ContactFinder, control: PushControl, now: float
) -> None:
    """Read joints and sensor and give the controller the contacts that follow."""
    finder.joints(now, rig.joints)
    control.locate_finger(rig.finger_pose.x, now)
    for sample in readout.read(rig.reading(), now):
        if sample.reading is not None:
            with suppress(ReadingRejectedError):
                control.feel(finder.contact(sample.reading, now).theta, now)
