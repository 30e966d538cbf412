# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Asking nodes of this process for their parameters."""

import time
from types import SimpleNamespace

import pytest

rclpy = pytest.importorskip('rclpy')

from rclpy.context import Context  # noqa: E402
from rclpy.executors import SingleThreadedExecutor  # noqa: E402
from rclpy.task import Future  # noqa: E402

from tactile_push.recording import parameter_notes  # noqa: E402
from tactile_push.recording.parameter_notes import ASK_AGAIN, ParameterNotes  # noqa: E402
from tactile_push.testing.processes import claim_domain  # noqa: E402


class Graph:
    """A node that asks, and others; all run only while the test spins them."""

    def __init__(self):
        self.context = Context()
        domain, self.lock = claim_domain()
        rclpy.init(context=self.context, domain_id=domain)
        self.executor = SingleThreadedExecutor(context=self.context)
        self.nodes = []
        self.asker = self.add('bag_recorder')

    def add(self, name, *, namespace='', answers=True, **parameters):
        node = rclpy.create_node(name, context=self.context, namespace=namespace)
        for key, value in parameters.items():
            node.declare_parameter(key, value)
        self.nodes.append(node)
        if answers:
            self.executor.add_node(node)
        return node

    def spin_until(self, condition, patience=60.0):
        deadline = time.monotonic() + patience
        while not condition():
            if time.monotonic() > deadline:
                return False
            self.executor.spin_once(timeout_sec=0.02)
        return True


@pytest.fixture
def graph():
    graph = Graph()
    yield graph
    graph.executor.shutdown()
    for node in graph.nodes:
        node.destroy_node()
    rclpy.shutdown(context=graph.context)
    graph.lock.close()


def mine(parameters):
    """Return the parameters that rclpy has not declared by itself."""
    return {
        key: value
        for key, value in parameters.items()
        if key not in ('use_sim_time', 'start_type_description_service')
    }


def test_each_of_the_packages_nodes_is_asked_once_and_others_are_not(graph):
    notes = []
    ParameterNotes(graph.asker, notes.append)
    graph.add('push_controller', kp=0.05, joint_names=['a', 'b'], autostart=True)
    graph.add('sim_plant', namespace='/left', object='block', seed=3)
    graph.add('camera', exposure=1)
    assert graph.spin_until(lambda: notes and len(notes[-1]) == 2)
    assert {name: mine(values) for name, values in notes[-1].items()} == {
        'push_controller': {'kp': 0.05, 'joint_names': ['a', 'b'], 'autostart': True},
        'left/sim_plant': {'object': 'block', 'seed': 3},
    }
    graph.add('sensor_driver', baud_rate=9600)
    assert graph.spin_until(lambda: len(notes[-1]) == 3)
    assert mine(notes[-1]['sensor_driver']) == {'baud_rate': 9600}
    assert len(notes) == 3
    # What asked has been put away.
    assert list(graph.asker.clients) == []


def test_node_that_does_not_answer_is_left_out_and_nobody_waits(graph):
    notes = []
    ParameterNotes(graph.asker, notes.append)
    silent = graph.add('push_controller', answers=False, kp=0.05)
    graph.add('sim_plant', seed=3)
    assert graph.spin_until(lambda: notes)
    assert not graph.spin_until(lambda: len(notes[-1]) > 1, patience=1.0)
    assert list(notes[-1]) == ['sim_plant']
    graph.nodes.remove(silent)
    silent.destroy_node()
    assert graph.spin_until(lambda: not list(graph.asker.clients))


class Client:
    """A client whose first answers are lost."""

    def __init__(self, answer, lost):
        self.answer, self.lost, self.calls = answer, lost, 0
        self.pending = []

    def service_is_ready(self):
        return True

    def call_async(self, request):
        future = Future()
        self.calls += 1
        if self.calls > self.lost:
            future.set_result(self.answer)
        self.pending.append(future)
        return future

    def remove_pending_request(self, future):
        self.pending.remove(future)


class AskingNode:
    """Sees one other node, and has its looks made by hand."""

    there = (('sim_plant', '/'),)

    def __init__(self, lost_names, lost_values):
        names = SimpleNamespace(result=SimpleNamespace(names=['period']))
        self.lister = Client(names, lost_names)
        self.getter = Client(SimpleNamespace(values=['a value']), lost_values)

    def create_timer(self, period, look, clock):
        self.look = look

    def create_client(self, kind, name):
        return self.lister if name.endswith('list_parameters') else self.getter

    def destroy_client(self, client):
        pass

    def get_fully_qualified_name(self):
        return '/bag_recorder'

    def get_node_names_and_namespaces(self):
        return self.there


@pytest.mark.parametrize(('lost_names', 'lost_values'), [(0, 0), (1, 0), (0, 1), (2, 1)])
def test_answer_that_is_lost_is_asked_for_again(monkeypatch, lost_names, lost_values):
    monkeypatch.setattr(parameter_notes, 'parameter_value_to_python', lambda value: value)
    noted = []
    node = AskingNode(lost_names, lost_values)
    ParameterNotes(node, noted.append)

    for _ in range((lost_names + lost_values) * ASK_AGAIN + 2):
        node.look()

    assert noted == [{'sim_plant': {'period': 'a value'}}]
    assert node.lister.calls == lost_names + lost_values + 1
    assert len(node.lister.pending) == len(node.getter.pending) == 1  # nothing adds up


@pytest.mark.parametrize(('again', 'expected'), [(False, [0.1]), (True, [0.1, 0.2])])
def test_a_node_that_comes_back_is_asked_again_if_that_is_wanted(monkeypatch, again, expected):
    monkeypatch.setattr(parameter_notes, 'parameter_value_to_python', lambda value: value)
    noted = []
    node = AskingNode(0, 0)
    ParameterNotes(node, noted.append, again=again)
    for value, there in ((0.1, AskingNode.there), (0.1, ()), (0.2, AskingNode.there)):
        node.getter.answer = SimpleNamespace(values=[value])
        node.there = there
        for _ in range(3):
            node.look()
    assert [notes['sim_plant']['period'] for notes in noted] == expected
