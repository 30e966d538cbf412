# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The launch files, where there is `ros2 launch`."""

import runpy

import pytest
from ament_index_python.packages import PackageNotFoundError

from support.package import TREE
from tactile_push.launching import DemoArguments, FingerArguments

NEEDED = 'the launch files need ros2 launch: source a ROS 2 workspace'
DeclareLaunchArgument = pytest.importorskip('launch.actions', reason=NEEDED).DeclareLaunchArgument
LaunchContext = pytest.importorskip('launch', reason=NEEDED).LaunchContext
Node = pytest.importorskip('launch_ros.actions', reason=NEEDED).Node
actions = pytest.importorskip('tactile_push.launching.actions')

FILES = {'demo.launch.py': DemoArguments, 'finger.launch.py': FingerArguments}


@pytest.fixture(autouse=True)
def installed(monkeypatch):
    """Return the packages that are not installed, to be added to; all others are."""
    missing = set()

    def prefix(package):
        if package in missing:
            raise PackageNotFoundError(package)
        return '/opt/ros'

    monkeypatch.setattr(actions, 'get_package_prefix', prefix)
    return missing


def started(file, **given):
    """Return the actions that a launch file carries out with some arguments."""
    description = runpy.run_path(str(TREE / 'launch' / file))['generate_launch_description']()
    context = LaunchContext()
    context.launch_configurations.update(given)
    return [action for entity in description.entities for action in entity.visit(context) or ()]


@pytest.mark.parametrize('file', FILES)
def test_arguments_are_declared_with_their_words(file):
    description = runpy.run_path(str(TREE / 'launch' / file))['generate_launch_description']()
    declared = [one for one in description.entities if isinstance(one, DeclareLaunchArgument)]
    assert [one.name for one in declared] == [one.name for one in FILES[file].declared()]
    assert all(len(one.description) > 10 for one in declared)


@pytest.mark.parametrize('file', FILES)
def test_launch_file_starts_the_planned_nodes(file):
    nodes = [action for action in started(file, rviz='true') if isinstance(action, Node)]
    executables = [node.node_executable for node in nodes]
    assert executables[:2] == ['rviz2', 'robot_state_publisher']
    assert {'sensor_driver', 'contact_geometry', 'push_controller'} <= set(executables)


def test_only_a_simulation_keeps_its_messages_on_this_machine():
    machine = started('finger.launch.py')
    simulated = started('finger.launch.py', sim='true')
    assert all(isinstance(action, Node) for action in machine)
    assert not all(isinstance(action, Node) for action in simulated)


@pytest.mark.parametrize(
    ('file', 'given', 'expected'),
    [
        ('demo.launch.py', {'kp': 'much'}, 'argument kp: expected a number'),
        ('demo.launch.py', {'object': 'cone'}, 'argument object: expected one of block, disk'),
        ('finger.launch.py', {'sim': 'perhaps'}, 'argument sim: expected true or false'),
        ('finger.launch.py', {'config': '/no/file.yaml'}, '/no/file.yaml: No such file'),
    ],
)
def test_bad_argument_is_refused_before_anything_starts(file, given, expected):
    with pytest.raises(ValueError, match=expected):
        started(file, **given)


@pytest.mark.parametrize(
    ('package', 'words'),
    [
        ('rviz2', r'ros-\w+-rviz2, or start without it: rviz:=false$'),
        ('robot_state_publisher', r'ros-\w+-robot-state-publisher$'),
    ],
)
def test_missing_package_is_named_with_how_to_get_it(installed, package, words):
    installed.add(package)
    expected = f'^{package} is not installed: sudo apt install {words}'
    with pytest.raises(ValueError, match=expected):
        started('finger.launch.py', rviz='true')
