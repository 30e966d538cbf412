# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import sys

import pytest

from tactile_push.launching import demo_plan, finger_plan
from tactile_push.parameters import PARAMETERS, FingerServoParameters
from tactile_push.parameters.finger_servo import make_servo
from tactile_push.tactile import PlanarFinger

pytest.importorskip('xacro', reason='pip install xacro')

LOOP = ['contact_geometry', 'push_controller', 'active_sensing']
JOINTS = ['proximal_joint', 'distal_joint']


def names(plan):
    return [program.executable for program in plan.programs]


def values(plan, node):
    (program,) = (program for program in plan.programs if program.executable == node)
    return program.parameters


def test_machine_runs_no_simulation_and_nodes_that_others_hear():
    plan = finger_plan({})
    assert names(plan) == ['robot_state_publisher', 'sensor_driver', *LOOP, 'finger_servo']
    assert not plan.simulated
    for program in plan.programs:
        assert 'use_sim_time' not in program.parameters
    assert values(plan, 'sensor_driver')['device'] == '/dev/ttyUSB0'


def test_simulation_takes_the_place_of_the_machine_and_of_its_device():
    plan = finger_plan({'sim': 'true', 'rviz': 'true', 'record': 'true'})
    assert names(plan) == [
        'rviz2',
        'robot_state_publisher',
        'sim_plant',
        'sensor_driver',
        *LOOP,
        'finger_servo',
        'bag_recorder',
    ]
    assert plan.simulated
    plant = values(plan, 'sim_plant')
    assert plant['device'] == values(plan, 'sensor_driver')['device'] != '/dev/ttyUSB0'
    assert plant['publish_clock']
    assert plant['commands'] == 'joint_velocities'
    for program in plan.programs:
        follows = program.parameters.get('use_sim_time', False)
        assert follows == (program.executable != 'sim_plant'), program.executable


def test_each_fact_about_the_machine_reaches_every_node_that_has_such_a_parameter():
    texts = {
        'belt_speed': '0.012',
        'finger_radius': '0.02',
        'proximal_length': '0.1',
        'distal_length': '0.2',
        'mount_angle': '0.3',
    }
    plan = finger_plan({**texts, 'sim': 'true'})
    heard = {name: set() for name in texts}
    for program in plan.programs:
        if program.executable in PARAMETERS:
            for declared in PARAMETERS[program.executable].declared():
                if declared.name in texts:
                    heard[declared.name].add(program.parameters[declared.name])
    assert heard == {name: {float(text)} for name, text in texts.items()}


def test_joints_are_those_of_the_machine_or_of_the_plant():
    texts = {'joint_names': '[shoulder, elbow]'}
    for node in ('contact_geometry', 'push_controller', 'finger_servo'):
        assert values(finger_plan(texts), node)['joint_names'] == ['shoulder', 'elbow']
        simulated = values(finger_plan({**texts, 'sim': 'true'}), node)['joint_names']
        assert simulated == JOINTS
    described = values(finger_plan(texts), 'robot_state_publisher')['robot_description']
    assert '<joint name="elbow"' in described


def test_wrist_of_the_machine_is_one_of_the_simulated_finger_too():
    plan = finger_plan({'joint_names': '[a, b, c]', 'sim': 'true'})
    assert values(plan, 'sim_plant')['tip_turns'] is False
    assert values(plan, 'push_controller')['joint_names'] == [*JOINTS, 'wrist_joint']
    assert values(plan, 'finger_servo')['joint_names'] == JOINTS
    described = values(plan, 'robot_state_publisher')['robot_description']
    assert '<joint name="wrist_joint" type="continuous"' in described


def test_law_is_that_of_the_argument_or_else_of_a_file(own):
    assert values(finger_plan({}), 'push_controller')['law'] == 'push'
    assert values(finger_plan({'law': 'place'}), 'push_controller')['law'] == 'place'
    file = str(own(push_controller={'law': 'place'}))
    assert values(finger_plan({'config': file}), 'push_controller')['law'] == 'place'
    plan = finger_plan({'config': file, 'law': 'push'})
    assert values(plan, 'push_controller')['law'] == 'push'
    assert 'law' not in values(plan, 'active_sensing')
    demo = demo_plan({'law': 'place', 'watch': 'false'})
    assert values(demo, 'push_controller')['law'] == 'place'
    refusal = "argument law: expected one of push, place, steer, settle, got 'shove'"
    with pytest.raises(ValueError, match=refusal):
        finger_plan({'law': 'shove'})


def test_machine_that_takes_the_command_itself_needs_no_servo():
    plan = finger_plan({'servo': 'false', 'sim': 'true'})
    assert names(plan) == ['robot_state_publisher', 'sim_plant', 'sensor_driver', *LOOP]
    assert 'commands' not in values(plan, 'sim_plant')


def test_machine_without_joints_has_no_description_and_a_tip_that_does_not_turn():
    plan = finger_plan({'robot': 'none', 'rviz': 'true'})
    assert names(plan) == ['rviz2', 'sensor_driver', *LOOP]
    for node in ('contact_geometry', 'push_controller'):
        assert values(plan, node)['use_joint_states'] is False
    assert values(plan, 'active_sensing')['without_psi'] == 'straight'
    assert plan.programs[0].arguments[-2:] == ('--fixed-frame', 'finger_disk')
    assert values(finger_plan({'robot': 'none', 'sim': 'true'}), 'sim_plant')['tip_turns'] is False


AXIS = {
    'robot': 'axis',
    'joint_names': '[slide]',
    'joint_min': '[-0.1]',
    'joint_max': '[0.12]',
    'joint_speed': '[0.05]',
}


def test_axis_is_moved_by_the_servo_and_its_tip_does_not_turn():
    plan = finger_plan(AXIS)
    assert names(plan) == ['sensor_driver', *LOOP, 'finger_servo']
    servo = values(plan, 'finger_servo')
    assert (servo['kinematics'], servo['joint_names']) == ('linear', ['slide'])
    assert [servo[f'joint_{name}'] for name in ('min', 'max', 'speed')] == [[-0.1], [0.12], [0.05]]
    make_servo(FingerServoParameters.of(servo))  # which refuses limits that leave no workspace
    for node in ('contact_geometry', 'push_controller'):
        assert values(plan, node)['use_joint_states'] is False
        assert 'joint_names' not in values(plan, node)
    assert values(plan, 'active_sensing')['without_psi'] == 'straight'


def test_simulation_stands_in_for_an_axis_with_a_tip_that_does_not_turn():
    plan = finger_plan({**AXIS, 'sim': 'true'})
    assert names(plan) == ['sim_plant', 'sensor_driver', *LOOP]
    assert values(plan, 'sim_plant')['tip_turns'] is False
    assert 'commands' not in values(plan, 'sim_plant')


def test_page_shows_the_run_if_asked_for_and_nobody_needs_it():
    pytest.importorskip('aiohttp', reason="pip install 'tactile_push[watch]'")
    (page,) = (p for p in finger_plan({'watch': 'true'}).programs if p.executable == 'live_page')
    assert page.only_shows
    needed = [p.executable for p in finger_plan({'rviz': 'true'}).programs if not p.only_shows]
    assert needed == ['robot_state_publisher', 'sensor_driver', *LOOP, 'finger_servo']


def test_without_the_library_of_the_page_it_says_how_to_start(monkeypatch):
    monkeypatch.setitem(sys.modules, 'aiohttp', None)
    with pytest.raises(ValueError, match=r'^live_page needs aiohttp: pip .*: watch:=false$'):
        demo_plan({})
    assert 'live_page' not in names(demo_plan({'watch': 'false'}))


def test_later_file_counts_more_and_arguments_most(own):
    block = own('block.yaml', push_controller={'kp': 0.07, 'kd': 3.0, 'max_speed': 0.01})
    machine = own(
        push_controller={'kd': 4.0},
        finger_launch={'belt_speed': 0.01, 'object': block, 'namespace': 'left'},
    )
    plan = finger_plan({'config': machine, 'belt_speed': '0.02'})
    given = values(plan, 'push_controller')
    assert (given['kp'], given['kd'], given['max_speed']) == (0.07, 4.0, 0.01)
    assert given['belt_speed'] == 0.02
    assert plan.namespace == 'left'


def test_force_torque_sensor_has_the_tip_of_the_machine_and_a_simulated_one_the_same(own):
    machine = own(finger_launch={'sensor': 'wrench', 'finger_radius': 0.02})
    tip = own('tip.yaml', wrench_sensor={'tip_xyz': [0.0, 0.001, 0.03]})
    plan = finger_plan({'config': machine, 'calibration': tip})
    assert names(plan) == ['robot_state_publisher', 'wrench_sensor', *LOOP, 'finger_servo']
    reader = values(plan, 'wrench_sensor')
    assert (reader['tip_radius'], reader['tip_xyz']) == (0.02, [0.0, 0.001, 0.03])
    assert 'needs_tare' not in reader
    plan = finger_plan({'config': machine, 'calibration': tip, 'sim': 'true'})
    assert values(plan, 'wrench_sensor')['needs_tare'] is False  # the finger begins in contact
    assert values(plan, 'active_sensing')['noise'] > 0.0035  # of what the machine's file says
    plant = values(plan, 'sim_plant')
    assert (plant['finger_radius'], plant['tip_xyz']) == (0.02, [0.0, 0.001, 0.03])
    assert plant['publish_wrench']


def test_file_may_know_better_than_the_machine_what_radius_touches(own):
    tip = own('tip.yaml', wrench_sensor={'tip_radius': 0.019})
    plan = finger_plan({'sensor': 'wrench', 'calibration': tip})
    assert values(plan, 'wrench_sensor')['tip_radius'] == 0.019


@pytest.mark.parametrize(
    ('sensor', 'node', 'values', 'refusal'),
    [
        ('camera', 'wrench_sensor', {}, 'calibration of a camera, for camera_sensor, got one for '),
        ('wrench', 'camera_sensor', {}, 'got one for camera_sensor'),
        ('sentence', 'wrench_sensor', {}, 'calibration of a sentence, for sensor_driver'),
        ('wrench', 'wrench_sensor', {'tip_radius': 0.03}, 'tip_radius: .* got 0.03 m, which is'),
        ('wrench', 'wrench_sensor', {'tip_radius': 0.008}, 'got 0.008 m, which is that of anothe'),
    ],
)
def test_calibration_of_another_sensor_or_tip_is_refused(own, sensor, node, values, refusal):
    calibration = own('calibration.yaml', **{node: {'autostart': False, **values}})
    with pytest.raises(ValueError, match=refusal) as refused:
        finger_plan({'sensor': sensor, 'calibration': calibration})
    assert str(refused.value).startswith(f'{calibration}: ')


def test_calibration_is_found_below_a_namespace(own):
    calibration = own('calibration.yaml', wrench_sensor={'tip_radius': 0.015})
    plan = finger_plan({'sensor': 'wrench', 'calibration': calibration, 'namespace': 'left'})
    assert values(plan, 'wrench_sensor')['tip_radius'] == 0.015


@pytest.mark.parametrize(
    ('sensor', 'remappings'),
    [
        ('wrench', {'wrench': '/driver/out'}),
        ('camera', {'image': '/driver/out', 'image/compressed': '/driver/out/compressed'}),
    ],
)
def test_sensor_is_read_where_its_driver_publishes_and_a_simulated_one_is_not(sensor, remappings):
    texts = {'sensor': sensor, 'sensor_topic': '/driver/out'}
    for sim, expected in (('false', remappings), ('true', {})):
        plan = finger_plan({**texts, 'sim': sim})
        (reader,) = (one for one in plan.programs if one.executable == f'{sensor}_sensor')
        assert dict(reader.remappings) == expected


def test_sensor_that_sends_sentences_has_no_topic():
    with pytest.raises(ValueError, match='^argument sensor_topic: expected none for sentence'):
        finger_plan({'sensor_topic': 'wrench'})


def test_section_of_another_namespace_is_for_another_finger(tmp_path):
    file = tmp_path / 'two.yaml'
    file.write_text(
        '/left/push_controller: {ros__parameters: {kp: 0.1}}\n'
        '/right/push_controller: {ros__parameters: {kp: 0.2}}\n'
    )
    for namespace, kp in (('left', 0.1), ('right', 0.2)):
        plan = finger_plan({'config': str(file), 'namespace': namespace})
        assert values(plan, 'push_controller')['kp'] == kp


def test_what_publishes_frames_publishes_them_in_the_namespace_of_the_finger():
    plan = finger_plan({'rviz': 'true', 'namespace': 'left'})
    for program in plan.programs[:2]:
        assert dict(program.remappings) == {'/tf': 'tf', '/tf_static': 'tf_static'}


def test_object_that_the_plant_does_not_know_is_not_simulated(own):
    mine = own('mine.yaml', active_sensing={'disk_radius': 0.03})
    finger_plan({'object': mine})
    with pytest.raises(ValueError, match=r'mine\.yaml: expected a section of sim_plant'):
        finger_plan({'object': mine, 'sim': 'true'})


def test_demonstration_is_the_papers_rig():
    pytest.importorskip('aiohttp', reason="pip install 'tactile_push[watch]'")
    plan = demo_plan({'object': 'disk', 'kp': '0.06', 'real_time_factor': '5'})
    assert names(plan) == [
        'rviz2',
        'robot_state_publisher',
        'sim_plant',
        'sensor_driver',
        *LOOP,
        'live_page',
    ]
    assert plan.simulated
    assert values(plan, 'sim_plant')['object'] == 'disk'
    assert values(plan, 'sim_plant')['real_time_factor'] == 5.0
    given = values(plan, 'push_controller')
    assert (given['kp'], given['kd'], given['theta_desired']) == (0.06, 5.0, 0.0)


def test_demonstration_with_other_physics_and_without_a_display():
    given = {'plant': 'mujoco_plant', 'rviz': 'false', 'watch': 'false', 'device': '/tmp/sensor'}
    plan = demo_plan(given)
    assert names(plan) == ['robot_state_publisher', 'mujoco_plant', 'sensor_driver', *LOOP]
    for node in ('mujoco_plant', 'sensor_driver'):
        assert values(plan, node)['device'] == '/tmp/sensor'


def test_description_of_the_machine_is_that_of_its_links():
    finger = PlanarFinger(0.1, 0.2, 0.3)
    machine = {'proximal_length': '0.1', 'distal_length': '0.2', 'mount_angle': '0.3'}
    described = values(finger_plan(machine), 'robot_state_publisher')['robot_description']
    assert f'rpy="0 0 {finger.mount_angle}"' in described
    assert f'xyz="{finger.proximal_length} 0 0"' in described
