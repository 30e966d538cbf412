# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import replace
from itertools import islice

import numpy as np
import pytest
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64MultiArray

from tactile_push.control import STATES, PushControl, PushLaw, settle_step
from tactile_push.interface import SERVO_COMMANDS
from tactile_push.parameters import FingerServoParameters, MujocoPlantParameters
from tactile_push.parameters.finger_servo import make_servo
from tactile_push.parameters.mujoco_plant import mujoco_config
from tactile_push.simulation import (
    JointRig,
    control_periods,
    experiment,
    paper_block,
    paper_disk,
    servoed,
)
from tactile_push.testing import Rig, field, seconds

STEPS, FEW_STEPS = 260, 60
SETTLED_BY = 230  # steps, by which the block is within 3 degrees of theta_d for good


def pushed(rig: Rig, steps: int) -> list[JointState]:
    """Return the states of the first control periods in which the controller pushes."""
    pushing = float(STATES.index('pushing'))
    rig.observer.wait_for(
        lambda: sum(field(m, 'state') == pushing for m in rig.states) > steps,
        f'{steps} control periods',
        patience=120.0,
    )
    return [m for m in rig.states if field(m, 'state') == pushing][: steps + 1]


@pytest.mark.parametrize(
    ('config', 'ideal', 'theta_desired', 'band'),
    [
        ('block', paper_block(), math.radians(-10.0), math.radians(3.0)),
        ('disk', paper_disk(), 0.0, math.radians(1.0)),
    ],
)
def test_loop_settles_along_the_trajectory_of_the_experiment_without_clocks_and_processes(
    rig: Rig, config, ideal, theta_desired, band
):
    rig.start(config)
    states = pushed(rig, STEPS)
    theta = np.array([field(m, 'theta') for m in states])
    phi = np.array([field(m, 'phi') for m in states])
    expected = experiment(replace(ideal, tip_turns=True), PushLaw(0.05, 5.0, theta_desired), STEPS)
    assert np.degrees(np.abs(theta - expected.theta)).max() < 0.5
    assert np.degrees(np.abs(phi - expected.phi)).max() < 3.0
    assert settle_step(theta, theta_desired, band) is not None
    assert field(states[-1], 'ticks_lost') == 0.0
    # The finger pushes straight ahead first: no kick.
    assert field(states[0], 'phi') == pytest.approx(math.pi / 2.0)
    assert field(states[0], 'v_x') == 0.0


def test_block_settles_by_what_a_force_torque_sensor_feels_in_spite_of_its_noise(rig: Rig):
    # Its time waits for a contact a hundred times a second, so it has to be patient.
    rig.start('block', sensor='wrench', command_timeout=10.0)
    states = pushed(rig, STEPS)
    # The true angle at each step: noise makes an edge that has settled seem to turn to and fro.
    moments = [seconds(m) for m in rig.truth]
    true = np.array([field(m, 'theta') for m in rig.truth])
    steps = np.searchsorted(moments, [seconds(m) for m in states], side='right') - 1
    settled = settle_step(true[steps], math.radians(-10.0), math.radians(3.0))
    assert settled is not None
    assert settled <= 230
    felt = np.array([field(m, 'theta') for m in states])
    assert 0.2 < np.degrees(np.std(felt - true[steps])) < 2.0
    assert {'normal_force', 'tangential_force'} <= set(rig.tactile[-1].name)


def test_block_settles_by_what_a_camera_in_the_tip_sees_in_spite_of_its_noise(rig: Rig):
    pytest.importorskip('cv2', reason="pip install 'tactile_push[camera]'")
    rig.start('block', sensor='camera', command_timeout=10.0)
    states = pushed(rig, SETTLED_BY + 20)
    settled = settle_step(
        np.array([field(m, 'theta') for m in states]), math.radians(-10.0), math.radians(3.0)
    )
    assert settled is not None
    assert settled <= SETTLED_BY
    truth = np.array([field(m, 'theta') for m in rig.truth[-20:]])
    assert np.degrees(np.abs(truth - math.radians(-10.0))).max() < 3.0


def test_loop_through_the_servo_goes_along_the_trajectory_without_clocks_and_processes(rig: Rig):
    velocities = rig.observer.hear(Float64MultiArray, SERVO_COMMANDS)
    rig.start('block', servo=True)
    states = pushed(rig, FEW_STEPS)
    theta = np.array([field(m, 'theta') for m in states])
    same = JointRig(replace(paper_block(), tip_turns=True))
    move = servoed(same, make_servo(FingerServoParameters()))
    control = PushControl(PushLaw(0.05, 5.0, math.radians(-10.0)), 0.005, 0.1)
    periods = islice(control_periods(same, control, 2, 0, move), len(states))
    expected = np.array([tick.theta for tick in periods])
    assert theta[0] - theta[-1] > math.radians(5.0)
    assert np.degrees(np.abs(theta - expected)).max() < 0.5
    assert field(states[-1], 'ticks_lost') == 0.0
    assert np.isfinite([message.data for message in velocities]).all()


def test_loop_on_mujoco_goes_along_the_trajectory_without_clocks_and_processes(rig: Rig):
    pytest.importorskip('mujoco', reason="pip install 'tactile_push[mujoco]'")
    from tactile_push.simulation.mujoco_rig import MujocoRig

    rig.start('block', simulator='mujoco_plant')
    states = pushed(rig, FEW_STEPS)
    theta = np.array([field(m, 'theta') for m in states])
    same = MujocoRig(*mujoco_config(MujocoPlantParameters(mu_c=0.5)))
    control = PushControl(PushLaw(0.05, 5.0, math.radians(-10.0)), 0.005, 0.1)
    periods = islice(control_periods(same, control, 2, 0), len(states))
    expected = np.array([tick.theta for tick in periods])
    assert theta[0] - theta[-1] > math.radians(5.0)
    assert np.degrees(np.abs(theta - expected)).max() < 0.5
    assert field(states[-1], 'ticks_lost') == 0.0
