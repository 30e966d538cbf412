# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The rig in MuJoCo as a node; what it shares with the other plant is tested there."""

import math
import sys

import pytest
from geometry_msgs.msg import TwistStamped, WrenchStamped
from sensor_msgs.msg import JointState
from visualization_msgs.msg import MarkerArray

from support.node_bench import declared_topics
from tactile_push.interface import (
    COMMAND,
    JOINT_STATES,
    MARKERS,
    MUJOCO_PLANT,
    TOPICS,
    TRUE_STATE,
    WRENCH,
)
from tactile_push.nodes.mujoco_plant import MujocoPlant, main
from tactile_push.nodes.ros.diagnostics import OK
from tactile_push.nodes.ros.parameters import ConfigurationError
from tactile_push.nodes.ros.plant import LONGEST_STEP
from tactile_push.paper import BELT_SPEED
from tactile_push.parameters import WrenchSensorParameters


@pytest.fixture
def plant(bench, tmp_path):
    """Return what starts the plant with a device of its own."""
    pytest.importorskip('mujoco', reason="pip install 'tactile_push[mujoco]'")
    return lambda **parameters: bench.start(
        MujocoPlant, **{'device': tmp_path / 'sensor', 'sensor_rate': 100.0, **parameters}
    )


def test_topics_are_those_of_the_interface(bench, plant):
    pytest.importorskip('cv2', reason="pip install 'tactile_push[camera]'")
    all_that_it_can = {'publish_wrench': True, 'publish_image': True}
    plant(publish_clock=True, commands='joint_velocities', **all_that_it_can)
    assert bench.topics() == declared_topics(MUJOCO_PLANT)


def test_before_the_first_command_the_belt_stands(bench, plant):
    plant(theta_initial=0.25, d_initial=0.004)
    bench.hear(JointState, TRUE_STATE, JOINT_STATES)
    bench.until(lambda: len(bench.heard[TRUE_STATE]) > 3 and bench.heard[JOINT_STATES])
    state = bench.values(TRUE_STATE)
    assert tuple(state) == TOPICS[TRUE_STATE].field_names
    assert (state['theta'], state['d']) == pytest.approx((0.25, 0.004), abs=1e-4)
    assert state['belt_travel'] == pytest.approx(0.0, abs=1e-5)
    assert bench.health == (OK, 'belt stands, waiting for the first command')


def test_before_the_first_command_a_sensor_of_force_feels_the_object(bench, plant):
    node = plant(publish_wrench=True)
    bench.hear(JointState, TRUE_STATE)
    bench.hear(WrenchStamped, WRENCH)
    bench.until(lambda: len(bench.heard[WRENCH]) > 5 and bench.heard[TRUE_STATE])
    force = bench.heard[WRENCH][-1].wrench.force
    # A fifth of the friction on the belt, and more than the sensor's node takes for a contact.
    least = 0.2 * 0.3 * 0.93 * 9.81
    assert (
        math.hypot(force.x, force.y, force.z) > least - 0.05 > WrenchSensorParameters.contact_force
    )
    # It may have been pressed on for one step too long, of 0.1 s at the most where a timer is late.
    assert bench.values(TRUE_STATE)['belt_travel'] < 2e-4 + BELT_SPEED * LONGEST_STEP
    assert not node._commanded.started


def test_a_command_moves_the_finger_and_starts_the_belt(bench, plant):
    plant(command_timeout=10.0)
    bench.hear(JointState, TRUE_STATE)
    bench.hear(MarkerArray, MARKERS)
    message = TwistStamped()
    message.twist.linear.x = 0.01
    bench.publisher(TwistStamped, COMMAND).publish(message)
    bench.until(lambda: bench.heard[TRUE_STATE] and bench.values(TRUE_STATE)['belt_travel'] > 1e-3)
    state = bench.values(TRUE_STATE)
    # The finger goes at 10 mm/s across a belt at 5 mm/s.
    assert state['v_x'] == pytest.approx(0.01, rel=0.01)
    assert state['belt_speed'] == 0.005
    assert state['finger_x'] == pytest.approx(2.0 * state['belt_travel'], rel=0.05)
    bench.until(lambda: bench.heard[MARKERS])
    assert bench.health == (OK, 'pushing')


def test_a_rig_that_is_none_is_refused(plant):
    with pytest.raises(ConfigurationError, match='parameter c: expected 0.0'):
        plant(c=0.02)


def test_without_mujoco_it_says_what_to_install(capsys, monkeypatch):
    monkeypatch.setitem(sys.modules, 'mujoco', None)
    assert main() == 2
    assert capsys.readouterr() == (
        '',
        "mujoco_plant: needs MuJoCo: pip install 'tactile_push[mujoco]'\n",
    )
