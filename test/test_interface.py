# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The one place that knows topics, fields, frames and nodes."""

import ast
import math
import re
import subprocess
import sys
from importlib.metadata import entry_points
from pathlib import Path

import pytest

from support.interface_checks import topics_as_declared
from tactile_push import interface
from tactile_push.control import PushControl, PushLaw, tick_values
from tactile_push.estimation import ActiveSensing, DiskEstimator, FingerMotion, sensing_values
from tactile_push.interface import (
    CONTACT,
    CONTROLLER_STATE,
    GEOMETRY_STATE,
    JOINT_STATE_TYPE,
    NODES,
    POSE_TYPE,
    RECORDED,
    SENSING_STATE,
    TACTILE,
    TOPICS,
    fingers,
    is_frame,
    node_in,
)
from tactile_push.tactile import REFUSALS, Reading, reading_values

PACKAGE = Path(interface.__file__).parent


def test_it_needs_the_standard_library_alone():
    command = [sys.executable, '-I', '-S', str(PACKAGE / 'interface.py')]
    assert subprocess.run(command, check=False).returncode == 0


def test_every_node_has_a_module_and_a_command():
    modules = {file.stem for file in (PACKAGE / 'nodes').glob('*.py')} - {'__init__'}
    commands = {
        entry.name
        for entry in entry_points(group='console_scripts')
        if entry.value.startswith('tactile_push.nodes.')
    }
    assert set(NODES) == modules == commands


def test_givers_and_takers_are_nodes_of_the_package_or_the_finger_or_yours():
    others = {'the finger', 'the sensor', 'your node'}
    for topic in TOPICS.values():
        assert {*topic.givers, *topic.takers} <= {*NODES, *others}


def test_recorded_topics_are_all_but_what_follows_from_them_and_images():
    follow, large = {'markers', 'active_sensing/markers'}, {'image', 'image/compressed'}
    assert set(TOPICS) - set(RECORDED) == follow | large


def test_fields_of_a_control_period():
    law = PushLaw(0.05, 5.0, 0.0)
    values = tick_values(PushControl(law, 0.005, 0.1).tick(0.0), law)
    assert tuple(values) == TOPICS[CONTROLLER_STATE].field_names


def test_fields_of_a_reading():
    values = reading_values(Reading(0.0, 1.0), math.nan, 0.1, REFUSALS[0])
    assert tuple(values) == TOPICS[GEOMETRY_STATE].field_names


def test_fields_of_an_estimate():
    estimator = DiskEstimator(0.0285, 0.0035, radius=0.0135)
    sensing = ActiveSensing(estimator, FingerMotion(0.0, 0.0), 0.005, 0.3)
    values = sensing_values(sensing.tick(0.0, 0.0, 0.0, 0.0), sensing)
    assert tuple(values) == TOPICS[SENSING_STATE].field_names


@pytest.mark.parametrize(
    ('frame', 'expected', 'found'),
    [
        ('', 'finger_base', True),
        ('finger_base', 'finger_base', True),
        ('left/finger_base', 'finger_base', True),
        ('left_finger_disk', 'finger_disk', True),
        ('finger_disk', 'finger_base', False),
        ('map', 'finger_base', False),
    ],
)
def test_a_frame_may_have_a_prefix_or_be_left_out(frame, expected, found):
    assert is_frame(frame, expected) is found


@pytest.mark.parametrize('name', ['block', 'stops'])
def test_types_and_fields_of_recorded_topics(name):
    newer = {'psi', 'trim', 'v_y', 'apart', 'along', 'object_x', 'edge_angle', 'lifted'}
    seen = topics_as_declared(Path(__file__).parent / 'data' / name, lacking=newer)
    assert {TACTILE, CONTACT, GEOMETRY_STATE, CONTROLLER_STATE} <= seen


FRAMES = {interface.FINGER_BASE, interface.FINGER_DISK, interface.FINGERTIP}
NOTES = {interface.PARAMETERS_NOTE, interface.VERSION_NOTE}
NAMES = {name for name in TOPICS if '/' in name} | FRAMES | NOTES
TAKES_A_TOPIC = re.compile('create_.*(publisher|subscription)|resolve_topic_name|count_publishers')


def copies(source):
    """Return what a source repeats of the interface, docstrings aside."""
    tree = ast.parse(source)
    prose = {id(node.value) for node in ast.walk(tree) if isinstance(node, ast.Expr)}
    for node in ast.walk(tree):
        if isinstance(node, ast.Constant) and node.value in NAMES and id(node) not in prose:
            yield node.value
        elif isinstance(node, ast.List | ast.Tuple | ast.Set):
            values = {item.value for item in node.elts if isinstance(item, ast.Constant)}
            if len(values & set(NODES)) > 2:
                yield 'a list of nodes'
        elif isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute):
            texts = [n.value for n in node.args if isinstance(n, ast.Constant)]
            if TAKES_A_TOPIC.fullmatch(node.func.attr):
                yield from (text for text in texts if text in TOPICS)


FILES = sorted(file for file in PACKAGE.rglob('*.py') if file != PACKAGE / 'interface.py')


def test_no_other_module_repeats_the_interface():
    found = {file.relative_to(PACKAGE): list(copies(file.read_text())) for file in FILES}
    assert {file: names for file, names in found.items() if names} == {}


def test_copies_are_found_and_prose_is_none():
    assert list(copies("TOPIC = 'push_controller/state'")) == ['push_controller/state']
    assert list(copies("node.create_publisher(JointState, 'tactile', 10)")) == ['tactile']
    assert list(copies("NODES = ('sim_plant', 'sensor_driver', 'bag_player')")) == [
        'a list of nodes'
    ]
    assert list(copies("def f():\n    'finger_disk'\n    return 'contact'")) == []


@pytest.mark.parametrize(
    ('topics', 'having', 'found'),
    [
        ({'/contact': POSE_TYPE, '/tf': ''}, {CONTACT}, {'': {CONTACT}}),
        (
            {'/left/contact': POSE_TYPE, '/contact': POSE_TYPE, '/left/tactile': JOINT_STATE_TYPE},
            {CONTACT},
            {'/left': {CONTACT, TACTILE}, '': {CONTACT}},
        ),
        ({'/tactile': JOINT_STATE_TYPE}, {CONTACT}, {}),
        ({'/a/b/tactile': JOINT_STATE_TYPE}, TOPICS, {'/a/b': {TACTILE}}),
        ({'/tactile': JOINT_STATE_TYPE, '/contact': JOINT_STATE_TYPE}, TOPICS, {'': {TACTILE}}),
        ({'/hand/contact': 'std_msgs/msg/Bool', '/tactile': ''}, TOPICS, {}),
        (
            {'/ground_truth/object_pose': POSE_TYPE, '/contact_geometry/state': JOINT_STATE_TYPE},
            TOPICS,
            {'': {'ground_truth/object_pose', GEOMETRY_STATE}},
        ),
        (dict.fromkeys(['/my_contact', 'contact', '/clock', ''], POSE_TYPE), TOPICS, {}),
        ({}, TOPICS, {}),
    ],
)
def test_fingers_of_a_bag(topics, having, found):
    assert fingers(topics, having) == found
    assert list(fingers(topics, having)) == list(found)


def test_name_of_a_node_in_recorded_parameters():
    assert node_in('', 'sim_plant') == 'sim_plant'
    assert node_in('/left', 'sim_plant') == 'left/sim_plant'
