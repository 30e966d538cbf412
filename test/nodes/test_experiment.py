# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The experiment's node: how it starts the controller, and what it does not begin with."""

from types import SimpleNamespace

import pytest
import rclpy
from geometry_msgs.msg import PoseStamped
from lifecycle_msgs.msg import Transition
from lifecycle_msgs.srv import ChangeState
from sensor_msgs.msg import JointState

from tactile_push.bags import BagReader
from tactile_push.interface import CONTACT, LIVE_PAGE, RECORDED, SERVO_STATE, TACTILE
from tactile_push.nodes import experiment
from tactile_push.nodes.experiment import AWAITED, MORE, SETTLED, Experiment
from tactile_push.nodes.ros.parameters import ConfigurationError


class Controller:
    """The controller's end of the service, which takes or refuses every transition."""

    def __init__(self, bench, success):
        self.asked = []
        self._success = success
        bench.peer.create_service(ChangeState, 'push_controller/change_state', self._answer)

    def _answer(self, request, response):
        self.asked.append(request.transition.id)
        response.success = self._success
        return response


def test_all_that_every_experiment_has_is_awaited_but_time_and_parameters():
    assert set(RECORDED) - set(AWAITED) == {'/clock', '/parameter_events', *MORE}


def test_a_servo_that_is_there_is_awaited_too(bench, tmp_path):
    node = bench.start(Experiment, bag=tmp_path / 'bag')
    assert node._more() == set()
    bench.publisher(JointState, SERVO_STATE)
    bench.until(lambda: node._more() == {'/finger_servo/state'})


def test_the_controller_is_configured_and_not_activated_before_all_is_recorded(bench, tmp_path):
    node = bench.start(Experiment, bag=tmp_path / 'bag')
    controller = Controller(bench, success=True)
    bench.until(lambda: node._transitions == [Transition.TRANSITION_ACTIVATE])
    tactile = bench.publisher(JointState, TACTILE)
    recorder = node._recording.recorder
    bench.until(lambda: recorder.counts['/tactile'] > 5, lambda: tactile.publish(JointState()))
    assert '/tactile' not in recorder.missing()
    assert '/contact' in recorder.missing()
    assert controller.asked == [Transition.TRANSITION_CONFIGURE]
    assert bench.node.context.ok()


def test_the_controller_is_activated_once_all_has_been_ready_for_a_while(
    bench, tmp_path, monkeypatch
):
    node = bench.start(Experiment, bag=tmp_path / 'bag')
    controller = Controller(bench, success=True)
    bench.until(lambda: node._transitions == [Transition.TRANSITION_ACTIVATE])
    ready, now = True, 100.0
    monkeypatch.setattr(node, '_ready', lambda: ready)
    monkeypatch.setattr(experiment, 'time', SimpleNamespace(monotonic=lambda: now))
    assert not node._settled()
    now, ready = 100.0 + SETTLED, False  # somebody has left again
    assert not node._settled()
    ready = True
    assert not node._settled()
    now += SETTLED - 0.01
    assert not node._settled()
    assert controller.asked == [Transition.TRANSITION_CONFIGURE]
    now += 0.02
    bench.until(lambda: node._transitions == [])
    assert controller.asked[1:] == [Transition.TRANSITION_ACTIVATE]


def test_who_only_watches_takes_no_contacts(bench, tmp_path):
    node = bench.start(Experiment, bag=tmp_path / 'bag')
    watcher = rclpy.create_node(LIVE_PAGE, use_global_arguments=False)
    watcher.create_subscription(PoseStamped, CONTACT, print, 1)
    bench.until(lambda: node.count_subscribers(CONTACT) == 1)
    assert not node._somebody_takes(CONTACT)
    bench.hear(PoseStamped, CONTACT)
    assert node._somebody_takes(CONTACT)
    watcher.destroy_node()


def test_a_controller_that_refuses_ends_the_experiment(bench, tmp_path):
    node = bench.start(Experiment, bag=tmp_path / 'bag')
    controller = Controller(bench, success=False)
    bench.until(lambda: not node.context.ok())
    assert controller.asked == [Transition.TRANSITION_CONFIGURE]


def test_what_was_published_is_in_the_bag_afterwards(bench, tmp_path):
    node = bench.start(Experiment, bag=tmp_path / 'bag')
    tactile = bench.publisher(JointState, TACTILE)
    tactile.publish(JointState(name=['azimuth'], position=[0.25]))
    counts = node._recording.recorder.counts
    bench.until(lambda: counts['/tactile'] == 1)
    bench.close()
    with BagReader(tmp_path / 'bag') as bag:
        (message,) = map(bag.decode, bag.messages(['/tactile']))
        assert (list(message.name), list(message.position)) == (['azimuth'], [0.25])


def test_steps_are_told_and_the_last_one_ends_the_experiment(bench, tmp_path, capsys):
    node = bench.start(Experiment, bag=tmp_path / 'bag', steps=3)
    node._transitions.clear()  # as once the controller is active
    counts = node._recording.recorder.counts
    # What is sensed comes last, so it counts.
    for commands, sensed in ((1, 1), (1, 1), (4, 3), (5, 3), (6, 4)):
        assert node.context.ok()
        counts['/finger/cmd_vel'], counts['/active_sensing/state'] = commands, sensed
        node._look()
    assert not node.context.ok()
    assert capsys.readouterr().out.split() == ['1', '3', '4']


def test_a_bag_without_a_name_is_refused(bench):
    with pytest.raises(ConfigurationError, match="parameter bag: expected a new folder, got ''"):
        bench.start(Experiment)


def test_a_folder_that_exists_is_refused(bench, tmp_path):
    with pytest.raises(ConfigurationError, match='parameter bag: .*: expected a new folder'):
        bench.start(Experiment, bag=tmp_path)


def test_no_steps_are_refused(bench, tmp_path):
    with pytest.raises(ConfigurationError, match='parameter steps: expected'):
        bench.start(Experiment, bag=tmp_path / 'bag', steps=0)
    assert not (tmp_path / 'bag').exists()
