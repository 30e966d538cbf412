# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import replace

import numpy as np
import pytest
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64MultiArray

from support.servoed_loop import servoed_theta
from tactile_push.control import STATES, PushLaw, settle_step
from tactile_push.interface import CAMERA, FORCE_TORQUE, SERVO_COMMANDS
from tactile_push.parameters import MujocoPlantParameters
from tactile_push.parameters.mujoco_plant import mujoco_config
from tactile_push.simulation import experiment, paper_block, paper_disk
from tactile_push.testing import Rig, field, seconds

STEPS, FEW_STEPS = 260, 60


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


@pytest.mark.parametrize('sensor', [FORCE_TORQUE, CAMERA])
def test_loop_with_a_noisy_sensor_turns_the_block_along_the_trajectory(rig: Rig, sensor):
    if sensor == CAMERA:
        pytest.importorskip('cv2', reason="pip install 'tactile_push[camera]'")
    # Its time waits for a contact up to a hundred times a second, so it has to be patient.
    rig.start('block', sensor=sensor, command_timeout=10.0)
    states = pushed(rig, FEW_STEPS)
    # The true angle at each step, which a busy machine may hear of later, and what the sensor makes
    # of it.
    rig.observer.wait_for(
        lambda: seconds(rig.truth[-1]) >= seconds(states[-1]), 'the truth about the last step'
    )
    moments = [seconds(m) for m in rig.truth]
    steps = np.searchsorted(moments, [seconds(m) for m in states], side='right') - 1
    true = np.array([field(m, 'theta') for m in rig.truth])[steps]
    felt = np.array([field(m, 'theta') for m in states])
    law, ideal = PushLaw(0.05, 5.0, math.radians(-10.0)), replace(paper_block(), tip_turns=True)
    expected = experiment(ideal, law, FEW_STEPS).theta
    assert true[0] - true[-1] > math.radians(5.0)
    assert np.degrees(np.abs(true - expected)).max() < 3.0
    assert 0.0 < np.degrees(np.std(felt - true)) < 2.0
    assert 'normal_force' in rig.tactile[-1].name


def test_loop_on_mujoco_through_the_servo_goes_along_the_trajectory_without_clocks_and_processes(
    rig: Rig,
):
    pytest.importorskip('mujoco', reason="pip install 'tactile_push[mujoco]'")
    from tactile_push.simulation.mujoco_joint_rig import MujocoJointRig

    velocities = rig.observer.hear(Float64MultiArray, SERVO_COMMANDS)
    rig.start('block', servo=True, simulator='mujoco_plant')
    states = pushed(rig, FEW_STEPS)
    theta = np.array([field(m, 'theta') for m in states])
    same = MujocoJointRig(*mujoco_config(MujocoPlantParameters(mu_c=0.5)))
    assert theta[0] - theta[-1] > math.radians(5.0)
    assert np.degrees(np.abs(theta - servoed_theta(same, len(states)))).max() < 0.5
    assert field(states[-1], 'ticks_lost') == 0.0
    assert np.isfinite([message.data for message in velocities]).all()
