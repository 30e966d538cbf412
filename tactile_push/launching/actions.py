# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""A plan as what `ros2 launch` carries out."""

import os
from collections.abc import Callable, Mapping
from typing import Any

from ament_index_python.packages import PackageNotFoundError, get_package_prefix
from launch import LaunchContext, LaunchDescription
from launch.action import Action
from launch.actions import DeclareLaunchArgument, OpaqueFunction, SetEnvironmentVariable
from launch.events.process import ProcessExited
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue

from tactile_push.launching.arguments import LaunchArguments
from tactile_push.launching.plan import Plan, Program
from tactile_push.testing.processes import loopback


def launch_description(
    kind: type[LaunchArguments], plan: Callable[[Mapping[str, str]], Plan]
) -> LaunchDescription:
    """Return a description with arguments of some kind, which starts what they are planned to."""
    declared = kind.declared()

    def start(context: LaunchContext) -> list[Action]:
        return actions(context.launch_configurations, plan)

    arguments = [
        DeclareLaunchArgument(
            known.name,
            default_value='' if kind.FROM_FILE else _text(known.default),
            description=f'{known.words}; {known.expected()}',
        )
        for known in declared
    ]
    return LaunchDescription([*arguments, OpaqueFunction(function=start)])


def actions(texts: Mapping[str, str], plan: Callable[[Mapping[str, str]], Plan]) -> list[Action]:
    """Return what starts the planned programs.

    Raises
    ------
    ValueError
        If an argument is refused or a package is not installed.
    """
    planned = plan(texts)
    for program in planned.programs:
        _check_installed(program)
    variables = loopback() if planned.simulated else {}
    return [
        *(SetEnvironmentVariable(*variable) for variable in variables.items()),
        *(_node(program, planned.namespace) for program in planned.programs),
    ]


def _check_installed(program: Program) -> None:
    """Refuse a program whose package is missing; ValueError says how to get it."""
    try:
        get_package_prefix(program.package)
    except PackageNotFoundError:
        distribution = os.environ.get('ROS_DISTRO', 'jazzy')
        debian = f'ros-{distribution}-{program.package.replace("_", "-")}'
        without = f', or start without it: {program.without}' if program.without else ''
        raise ValueError(
            f'{program.package} is not installed: sudo apt install {debian}{without}'
        ) from None


def _node(program: Program, namespace: str) -> Node:
    """Return the action that starts a program and, when one that is needed fails, ends all."""
    return Node(
        package=program.package,
        executable=program.executable,
        name=program.executable,
        namespace=namespace,
        parameters=[{name: _typed(value) for name, value in program.parameters.items()}],
        arguments=list(program.arguments),
        remappings=list(program.remappings),
        output='screen',
        on_exit=None if program.only_shows else _end_with,
    )


def _typed(value: Any) -> Any:
    """Return a value that launch_ros passes on as it is: texts would become what they look like."""
    if isinstance(value, str):
        return ParameterValue(value, value_type=str)
    if isinstance(value, list) and value and isinstance(value[0], str):
        return ParameterValue(value, value_type=list[str])
    return value


def _text(default: Any) -> str:
    """Return a default value as a command line gives it."""
    return str(default).lower() if isinstance(default, bool) else str(default)


def _end_with(event: ProcessExited, context: LaunchContext) -> None:
    """End the others when a program fails, and let `ros2 launch` fail as well."""
    if event.returncode and not context.is_shutdown:
        raise RuntimeError(f'{event.process_name} failed')
