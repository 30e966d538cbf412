# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The layouts of RViz, Foxglove and PlotJuggler name topics, fields and frames that there are."""

import json
import re
import xml.etree.ElementTree as ElementTree

import yaml

from support.package import TREE
from tactile_push.interface import (
    FINGER_BASE,
    FINGER_DISK,
    FINGERTIP,
    JOINT_STATE_TYPE,
    MARKERS_TYPE,
    POSE_TYPE,
    TOPICS,
    UNCERTAIN_POSE_TYPE,
)

CONFIG = TREE / 'config'
OWN = {f'/{name.removeprefix("/")}': topic for name, topic in TOPICS.items()}  # of the root
DESCRIPTION = 'robot_description'  # of robot_state_publisher
FOXGLOVE = json.loads((CONFIG / 'foxglove.json').read_text())
PANELS = FOXGLOVE['configById']
RVIZ = yaml.safe_load((CONFIG / 'demo.rviz').read_text())['Visualization Manager']
PLOTJUGGLER = ElementTree.parse(CONFIG / 'plotjuggler.xml').getroot()


def field_names(topic):
    assert topic.type_name == JOINT_STATE_TYPE
    return topic.field_names


def leaves(node):
    """Return the panels below a node of Foxglove's tree of panels."""
    if isinstance(node, str):
        return [node]
    assert set(node) == {'direction', 'first', 'second', 'splitPercentage'}
    assert node['direction'] in ('row', 'column')
    return [*leaves(node['first']), *leaves(node['second'])]


def test_foxglove_shows_each_panel_once_and_of_a_type_that_it_has():
    assert sorted(leaves(FOXGLOVE['layout'])) == sorted(PANELS)
    types = {name.partition('!')[0] for name in PANELS}
    assert types == {'3D', 'Plot', 'StateTransitions', 'DiagnosticSummary'}
    assert {'configById', 'layout', 'globalVariables', 'userNodes', 'playbackConfig'} == set(
        FOXGLOVE
    )


def test_foxglove_plots_the_fields_that_its_labels_name():
    paths = [path for panel in PANELS.values() for path in panel.get('paths', ())]
    assert len(paths) > 10
    for path in paths:
        topic, array, number = re.fullmatch(r'(/\S+)\.(\w+)\[(\d+)\]', path['value']).groups()
        assert field_names(OWN[topic])[int(number)] == path['label'], path['value']
        assert OWN[topic].fields[int(number)].array == array


def test_foxglove_shows_topics_of_kinds_that_its_3d_panel_draws():
    topics = dict(PANELS['3D!rig']['topics'])
    assert topics.pop(f'/{DESCRIPTION}')['visible']
    for name in topics:
        assert OWN[name].type_name in (MARKERS_TYPE, POSE_TYPE, UNCERTAIN_POSE_TYPE), name
    assert PANELS['3D!rig']['followTf'] == FINGER_BASE
    assert PANELS['DiagnosticSummary!health']['topicToRender'] in OWN


def test_plotjuggler_plots_fields_of_topics_that_it_subscribes_to():
    plugin = PLOTJUGGLER.find('Plugins/plugin')
    assert plugin.get('ID') == PLOTJUGGLER.find('previouslyLoaded_Streamer').get('name')
    subscribed = plugin.find('selected_topics').get('value').split(';')
    curves = [curve.get('name') for curve in PLOTJUGGLER.iter('curve')]
    assert len(curves) > 10
    for curve in curves:
        topic, name, array = re.fullmatch(r'(/.+)/(\w+)/(\w+)', curve).groups()
        assert topic in subscribed
        (field,) = (field for field in OWN[topic].fields if field.name == name)
        assert field.array == array
    assert {curve.rsplit('/', 2)[0] for curve in curves} == set(subscribed) <= set(OWN)


def test_plotjuggler_finds_the_areas_that_each_splitter_counts():
    for tab in PLOTJUGGLER.iter('Tab'):
        assert int(tab.get('containers')) == len(tab.findall('Container'))
    splitters = list(PLOTJUGGLER.iter('DockSplitter'))
    assert splitters
    for splitter in splitters:
        sizes = [float(size) for size in splitter.get('sizes').split(';')]
        assert len(splitter) == int(splitter.get('count')) == len(sizes)
        assert abs(sum(sizes) - 1.0) < 1e-9
        assert splitter.get('orientation') in ('|', '-')


def test_rviz_shows_the_finger_and_topics_of_the_kinds_that_its_displays_take():
    displays = {display['Name']: display for display in RVIZ['Displays']}
    taken = {
        'rviz_default_plugins/MarkerArray': MARKERS_TYPE,
        'rviz_default_plugins/Pose': POSE_TYPE,
        'rviz_default_plugins/PoseWithCovariance': UNCERTAIN_POSE_TYPE,
    }
    shown = {
        display['Topic']['Value']: taken[display['Class']]
        for display in displays.values()
        if 'Topic' in display
    }
    assert len(shown) > 4
    assert shown == {name: TOPICS[name].type_name for name in shown}
    assert displays['Finger']['Description Topic']['Value'] == DESCRIPTION


def test_rviz_shows_everything_in_one_tree_of_frames():
    assert RVIZ['Global Options']['Fixed Frame'] == FINGER_BASE
    (frames,) = (one for one in RVIZ['Displays'] if one['Class'] == 'rviz_default_plugins/TF')
    assert set(frames['Frames']) - {'All Enabled'} == {FINGER_BASE, FINGERTIP, FINGER_DISK}
