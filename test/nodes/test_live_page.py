# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The live page as a node: what it takes from the topics, and what it posts to its pages."""

import json
import math
import socket
import sys

import pytest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from geometry_msgs.msg import PoseStamped
from sensor_msgs.msg import JointState

pytest.importorskip('aiohttp', reason="pip install 'tactile_push[watch]'")

from fuzzing.messages import TEXTS, extremes
from support.node_bench import declared_topics
from tactile_push.interface import (
    CONTROLLER_STATE,
    DIAGNOSTICS,
    LIVE_PAGE,
    TRUE_POSE,
    TRUE_STATE,
)
from tactile_push.nodes.live_page import MOST_TAKEN, LivePage, main
from tactile_push.nodes.ros.diagnostics import OK, WARN
from tactile_push.nodes.ros.parameters import ConfigurationError


@pytest.fixture
def page(bench, monkeypatch):
    """Return what starts the node on any free port; what it posts is in `posted`, by kind."""

    def start(**parameters):
        node = bench.start(LivePage, **{'port': 0, **parameters})
        node.posted = {kind: [] for kind in ('frame', 'events', 'scene')}
        post = node._server.post

        def keep(kind, text):
            node.posted[kind].append(json.loads(text)[kind])
            post(kind, text)

        monkeypatch.setattr(node._server, 'post', keep)
        return node

    return start


def newest(node):
    """Return the values of the newest frame by name."""
    names = node._live.hello()['hello']['names']
    return dict(zip(names, node.posted['frame'][-1], strict=True)) if node.posted['frame'] else {}


def joints(**values):
    return JointState(name=list(values), position=[float(value) for value in values.values()])


def status_of(level, name, words):
    return DiagnosticArray(status=[DiagnosticStatus(level=level, name=name, message=words)])


def test_topics_are_those_of_the_interface(bench, page):
    page()
    assert bench.topics() == declared_topics(LIVE_PAGE)


def test_what_the_nodes_say_is_in_the_frames(bench, page):
    node = page()
    state = bench.publisher(JointState, CONTROLLER_STATE)
    truth = bench.publisher(PoseStamped, TRUE_POSE)
    message = PoseStamped()
    message.pose.position.x, message.pose.position.y = 0.001, 0.037
    message.pose.orientation.z, message.pose.orientation.w = math.sin(0.05), math.cos(0.05)

    def say():
        state.publish(joints(theta=0.1, state=2.0, stop_reason=0.0))
        truth.publish(message)

    bench.until(lambda: newest(node).get('object_x') and newest(node)['theta'], say)
    frame = newest(node)
    assert [frame[name] for name in ('object_x', 'object_y')] == pytest.approx([1.0, 37.0])
    angles = [frame['theta'], frame['object_angle']]
    assert angles == pytest.approx([math.degrees(0.1)] * 2, abs=1e-3)
    assert node._health().level == OK


def test_every_tick_counts_and_of_fast_topics_the_newest(bench, page):
    node = page()
    state = bench.publisher(JointState, CONTROLLER_STATE)
    truth = bench.publisher(JointState, TRUE_STATE)
    taken = []
    node._live.take = lambda now, topic, values: taken.append((topic, values))
    for k in range(MOST_TAKEN // 2):
        state.publish(joints(ticks=k))
        truth.publish(joints(v_x=k))
    bench.until(lambda: len(taken) > MOST_TAKEN // 2)
    assert [v['ticks'] for topic, v in taken if topic == CONTROLLER_STATE] == list(
        range(MOST_TAKEN // 2)
    )
    speeds = [v['v_x'] for topic, v in taken if topic == TRUE_STATE]
    assert len(speeds) < MOST_TAKEN // 2
    assert speeds[-1] == MOST_TAKEN // 2 - 1


def test_stops_and_what_nodes_say_of_themselves_are_events(bench, page):
    node = page()
    state = bench.publisher(JointState, CONTROLLER_STATE)
    diagnostics = bench.publisher(DiagnosticArray, DIAGNOSTICS)
    status = status_of(WARN, 'sensor_driver', 'readings late')

    def say():
        state.publish(joints(state=3.0, stop_reason=1.0))
        diagnostics.publish(status)

    bench.until(lambda: node.posted['events'] and len(node.posted['events'][-1]) == 2, say)
    found = [(e['lane'], e['level'], e['text']) for e in node.posted['events'][-1]]
    assert found == [  # and nothing of the page's own health
        ('controller', 'error', 'stopped: contact silent'),
        ('sensor_driver', 'warning', 'readings late'),
    ]
    said = len(node.posted['events'])
    bench.until(lambda: len(node.posted['frame']) > 30, say)
    assert len(node.posted['events']) == said  # nothing new is not repeated


def test_object_is_that_of_the_parameters_and_told_when_it_changes(page):
    node = page()
    node._on_parameters({'active_sensing': {'disk_radius': 0.03}})
    node._on_parameters({'active_sensing': {'disk_radius': 0.03}})
    (scene,) = node.posted['scene']
    assert scene['radius'] == 13.5
    assert max(x for x, _ in scene['outline']) == pytest.approx(30.0)


def test_messages_at_their_extremes_leave_it_as_it_is(page):
    node = page()
    spoiled = [
        *((CONTROLLER_STATE, message) for _, message in extremes(joints(theta=0.1, state=2.0))),
        *((TRUE_POSE, message) for _, message in extremes(PoseStamped())),
        *((DIAGNOSTICS, status_of(WARN, text, text)) for text in TEXTS),
        (DIAGNOSTICS, status_of(b'\xff', 'sensor_driver', 'readings late')),
    ]
    for topic, message in spoiled:
        if topic == DIAGNOSTICS:
            node._on_statuses(message)
        else:
            node._on_message(topic, message)
        node._on_frame()
    assert len(node.posted['frame']) == len(spoiled) > 100


def test_without_a_word_from_the_nodes_it_warns(page):
    node = page()
    assert node._health().level == WARN
    assert node._health().values['pages'] == 0


def test_a_port_that_is_taken_is_refused_with_its_address(page):
    with socket.create_server(('127.0.0.1', 0)) as taken:
        port = taken.getsockname()[1]
        with pytest.raises(ConfigurationError) as refused:
            page(port=port)
    assert str(refused.value) == (f'parameter host, port: 127.0.0.1:{port}: Address already in use')


def test_without_its_library_it_says_what_to_install(capsys, monkeypatch):
    monkeypatch.setitem(sys.modules, 'aiohttp', None)
    assert main() == 2
    assert capsys.readouterr() == (
        '',
        "live_page: needs aiohttp: pip install 'tactile_push[watch]'\n",
    )
