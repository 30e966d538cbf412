# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The demonstration on a machine with ROS 2: the five nodes, in simulated time, and RViz."""

import os

from ament_index_python.packages import get_package_share_directory
from launch import LaunchContext, LaunchDescription
from launch.actions import (
    DeclareLaunchArgument,
    OpaqueFunction,
    SetEnvironmentVariable,
)
from launch.conditions import IfCondition
from launch.events.process import ProcessExited
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue

from tactile_push.interface import MUJOCO_PLANT, SIM_PLANT
from tactile_push.parameters import PushControllerParameters, SimPlantParameters
from tactile_push.testing.processes import loopback

SHARE = get_package_share_directory('tactile_push')
LAW, PLANT = PushControllerParameters(), SimPlantParameters()
NUMBERS = ('kp', 'kd', 'real_time_factor')


def generate_launch_description() -> LaunchDescription:
    arguments = [
        DeclareLaunchArgument(
            'object', default_value='block', choices=['block', 'disk'], description='what is pushed'
        ),
        DeclareLaunchArgument(
            'plant',
            default_value=SIM_PLANT,
            choices=[SIM_PLANT, MUJOCO_PLANT],
            description='which node simulates',
        ),
        DeclareLaunchArgument(
            'kp', default_value=str(LAW.kp), description='proportional gain [rad/rad]'
        ),
        DeclareLaunchArgument(
            'kd', default_value=str(LAW.kd), description='derivative gain [rad/rad]'
        ),
        DeclareLaunchArgument(
            'real_time_factor',
            default_value=str(PLANT.real_time_factor),
            description='simulated seconds a second, at the most',
        ),
        DeclareLaunchArgument(
            'device',
            default_value=PLANT.device,
            description='where plant and driver meet',
        ),
        DeclareLaunchArgument(
            'rviz', default_value='true', choices=['true', 'false'], description='start RViz'
        ),
    ]
    config = [os.path.join(SHARE, 'config', ''), LaunchConfiguration('object'), '.yaml']
    simulated = {'use_sim_time': True}
    device = {'device': LaunchConfiguration('device')}
    nodes = [
        # First: if it is not installed, nothing else has been started yet.
        Node(
            package='rviz2',
            executable='rviz2',
            arguments=['-d', os.path.join(SHARE, 'config', 'demo.rviz')],
            parameters=[simulated],
            condition=IfCondition(LaunchConfiguration('rviz')),
        ),
        _node(
            LaunchConfiguration('plant'),
            config,
            device,
            {'publish_clock': True, 'real_time_factor': _number('real_time_factor')},
        ),
        _node('sensor_driver', device, simulated),
        _node('contact_geometry', config, simulated),
        _node('push_controller', config, {'kp': _number('kp'), 'kd': _number('kd')}, simulated),
        _node('active_sensing', config, simulated),
    ]
    # A demonstration is nobody's business on other machines.
    on_this_machine = [SetEnvironmentVariable(*variable) for variable in loopback().items()]
    check = OpaqueFunction(function=_check_numbers)
    return LaunchDescription([*arguments, check, *on_this_machine, *nodes])


def _check_numbers(context: LaunchContext) -> None:
    """Refuse what is no number before anything is started."""
    for name in NUMBERS:
        value = context.launch_configurations[name]
        try:
            float(value)
        except ValueError:
            raise ValueError(f'argument {name}: expected a number, got {value!r}') from None


def _end_with(event: ProcessExited, context: LaunchContext) -> None:
    """End the others when a node fails, and let `ros2 launch` fail as well."""
    if event.returncode and not context.is_shutdown:
        raise RuntimeError(f'{event.process_name} failed')


def _number(argument: str) -> ParameterValue:
    return ParameterValue(LaunchConfiguration(argument), value_type=float)


def _node(executable: str | LaunchConfiguration, *parameters: object) -> Node:
    return Node(
        package='tactile_push',
        executable=executable,
        name=executable,
        parameters=list(parameters),
        output='screen',
        on_exit=_end_with,
    )
