# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Which nodes a rig starts and how, and what it makes of what they say; the nodes are stand-ins."""

from pathlib import Path
from types import SimpleNamespace

import pytest

pytest.importorskip('rclpy')

from lifecycle_msgs.msg import Transition
from sensor_msgs.msg import JointState

from tactile_push.control import CONTACT_SILENT, PUSHING, STATES, STOP_REASONS
from tactile_push.parameters.config_file import config_file
from tactile_push.testing.observer import Heard
from tactile_push.testing.rig import Rig


class Nodes:
    """Takes notes of the processes that are started."""

    def __init__(self):
        self.started = {}
        self.folder = None

    def log(self, name):
        return self.folder / f'{name}.log'

    def start(self, node, parameters, *, config, name, arguments):
        self.started[name] = SimpleNamespace(
            node=node, parameters=parameters, config=config, arguments=arguments
        )


class Listener:
    """Hears what a test says, and takes notes of what it is asked for."""

    def __init__(self):
        self.topics = {}
        self.transitions = []
        self.refuses = False
        self.subscribers = 10
        self.says = iter(())
        self.node = SimpleNamespace(count_subscribers=lambda topic: self.subscribers)

    def hear(self, kind, topic):
        return self.topics.setdefault(topic, Heard())

    def wait_for(self, condition, what):
        while not (outcome := condition()):
            if not next(self.says, False):
                raise TimeoutError(what)
        return outcome

    def change_state(self, node, transition):
        self.transitions.append((node, transition))
        return not self.refuses


@pytest.fixture
def rig():
    return Rig(Nodes(), Listener(), '/dev/sensor')


def truth(**values):
    return JointState(name=list(values), position=list(values.values()))


def heard_all(rig):
    """Let plant and geometry have said something."""
    rig.truth.append(truth(theta=0.1, v_x=0.0))
    rig.contacts.append(object())


def test_names_are_those_of_the_namespace():
    root, left = (Rig(Nodes(), Listener(), 'socket://localhost:1', n) for n in ('', 'left'))
    assert (root.name('contact'), left.name('contact')) == ('/contact', '/left/contact')
    assert (root.process('sim_plant'), left.process('sim_plant')) == ('sim_plant', 'left.sim_plant')
    assert set(left.observer.topics) == {
        '/left/finger/cmd_vel',
        '/left/contact',
        '/left/push_controller/state',
        '/left/tactile',
        '/left/ground_truth/state',
    }


def test_nodes_start_with_the_plant_first_and_the_controller_last(rig):
    heard_all(rig)
    rig.start('disk', mu_c=0.1, sensor_rate=50.0)
    started = rig.nodes.started
    assert list(started) == ['sim_plant', 'sensor_driver', 'contact_geometry', 'push_controller']
    assert {process.config for process in started.values()} == {config_file('disk.yaml')}
    plant = started['sim_plant'].parameters
    assert plant.items() >= {'device': '/dev/sensor', 'mu_c': 0.1, 'sensor_rate': 50.0}.items()
    assert plant['publish_clock'] is True
    driver = started['sensor_driver'].parameters
    assert driver == {'device': '/dev/sensor', 'use_sim_time': True}
    assert started['contact_geometry'].parameters == {'use_sim_time': True}
    assert started['push_controller'].parameters == {'autostart': False, 'use_sim_time': True}
    assert rig.observer.transitions == [
        ('/push_controller', Transition.TRANSITION_CONFIGURE),
        ('/push_controller', Transition.TRANSITION_ACTIVATE),
    ]


def test_another_plant_may_simulate(rig):
    heard_all(rig)
    rig.start(simulator='mujoco_plant', push_height=0.01)
    started = rig.nodes.started
    assert list(started)[:2] == ['mujoco_plant', 'sensor_driver']
    plant = started['mujoco_plant'].parameters
    assert plant.items() >= {'device': '/dev/sensor', 'push_height': 0.01}.items()


def test_test_may_bring_its_own_controller_and_parameter_file(rig, tmp_path):
    heard_all(rig)
    rig.start(tmp_path / 'own.yaml', controller=False)
    assert list(rig.nodes.started) == ['sim_plant', 'sensor_driver', 'contact_geometry']
    assert rig.nodes.started['sim_plant'].config == Path(tmp_path / 'own.yaml')
    assert rig.observer.transitions == []


def test_controller_is_not_activated_before_the_nodes_hear_each_other(rig):
    heard_all(rig)
    rig.observer.subscribers = 1
    with pytest.raises(TimeoutError, match='all nodes to hear each other'):
        rig.start()
    assert [transition for _, transition in rig.observer.transitions] == [
        Transition.TRANSITION_CONFIGURE
    ]


def test_controller_that_refuses_fails_the_start_with_its_own_words(rig, tmp_path):
    heard_all(rig)
    rig.observer.refuses = True
    rig.nodes.folder = tmp_path
    (tmp_path / 'push_controller.log').write_text('why it did')
    with pytest.raises(RuntimeError, match='push_controller refused transition 1: why it did'):
        rig.start()


def test_node_of_a_namespace_gets_it_after_its_other_arguments():
    rig = Rig(Nodes(), Listener(), '/dev/sensor', 'left')
    rig.start_node('sensor_driver', {'device': '/dev/other'}, ('--log-level', 'debug'))
    started = rig.nodes.started['left.sensor_driver']
    assert started.node == 'sensor_driver'
    assert started.parameters == {'device': '/dev/other'}
    assert started.arguments == ('--log-level', 'debug', '-r', '__ns:=/left')


def test_controller_says_what_it_does_and_why(rig):
    assert rig.state == ''
    for state, reason in ((PUSHING, ''), ('stopped', CONTACT_SILENT)):
        numbers = STATES.index(state), STOP_REASONS.index(reason)
        rig.states.append(truth(state=numbers[0], stop_reason=numbers[1]))
        assert (rig.state, rig.reason) == (state, reason)


def test_ground_truth_is_the_newest_and_is_waited_for(rig):
    with pytest.raises(TimeoutError, match='the ground truth'):
        rig.ground_truth('theta')
    rig.truth.append(truth(theta=0.1))
    rig.truth.append(truth(theta=0.2))
    assert rig.ground_truth('theta') == 0.2


def velocities(rig, values):
    """Let the plant say one velocity of the finger after another [m/s]."""
    for value in values:
        rig.truth.append(truth(v_x=value))
        yield True


def test_finger_moves_when_it_has_had_a_velocity_eleven_times_from_now_on(rig):
    rig.truth.extend([truth(v_x=0.01)] * 20)  # before
    rig.observer.says = velocities(rig, [0.01, 0.0, -0.01, 5e-5] * 10)
    rig.wait_until_moving()
    assert len(rig.truth) - 20 == 21  # every other one moves


def test_finger_rests_when_it_has_no_velocity_from_now_on(rig):
    rig.truth.append(truth(v_x=0.0))  # before
    rig.observer.says = velocities(rig, [0.01, 1e-6, 0.0, 0.01])
    rig.wait_until_resting()
    assert len(rig.truth) == 4
