# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The experiment's node: how it starts the controller, and what it does not begin with."""

import math
from types import SimpleNamespace

import pytest
import rclpy
from geometry_msgs.msg import PoseStamped
from lifecycle_msgs.msg import Transition
from lifecycle_msgs.srv import ChangeState
from sensor_msgs.msg import JointState
from std_msgs.msg import Bool

from tactile_push.bags import BagReader
from tactile_push.control.placing.stages import MISSED, NO_GOAL, RELEASED, STAGES
from tactile_push.interface import (
    CONTACT,
    LIVE_PAGE,
    PLACE_GOAL,
    PLACE_RELEASE,
    PLACE_STATE,
    RECORDED,
    SENSING_STATE,
    SERVO_STATE,
    TACTILE,
)
from tactile_push.nodes import experiment
from tactile_push.nodes.experiment import AFTERWARDS, AWAITED, MORE, SETTLED, Experiment
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
    assert not node._settled(node._ready())
    now, ready = 100.0 + SETTLED, False  # somebody has left again
    assert not node._settled(node._ready())
    ready = True
    assert not node._settled(node._ready())
    now += SETTLED - 0.01
    assert not node._settled(node._ready())
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


def test_goals_are_given_in_turn_and_the_run_ends_a_little_after_the_last(
    bench, tmp_path, monkeypatch
):
    monkeypatch.setattr(experiment, 'SETTLED', 0.0)
    node = bench.start(Experiment, bag=tmp_path / 'bag', goals=['-0.05 0.1', '-0.06 -0.2'])
    states = bench.publisher(JointState, PLACE_STATE)
    bench.hear(PoseStamped, PLACE_GOAL)
    bench.hear(Bool, PLACE_RELEASE)
    bench.hear(JointState, SENSING_STATE)
    given = bench.heard[PLACE_GOAL]

    def until(condition, stage, goals):
        message = JointState(name=['stage', 'goals', 'refused'])
        message.position = [float(STAGES.index(stage)), float(goals), 0.0]
        bench.until(condition, lambda: states.publish(message))

    until(lambda: node._recording.recorder.counts['/place/state'], NO_GOAL, 0)
    assert given == []  # the controller does not run yet
    node._transitions.clear()  # as once it does
    until(lambda: given, NO_GOAL, 0)
    until(lambda: len(given) == 2, RELEASED, 1)
    places = [(goal.pose.position.x, goal.pose.orientation.z) for goal in given]
    assert places == [(-0.05, math.sin(0.05)), (-0.06, pytest.approx(math.sin(-0.1)))]
    assert {goal.header.frame_id for goal in given} == {'finger_base'}
    until(lambda: node._goals.done, MISSED, 2)
    counts = node._recording.recorder.counts
    for steps in range(AFTERWARDS + 2):
        assert node.context.ok()
        counts['/finger/cmd_vel'] = counts['/active_sensing/state'] = steps
        node._look()
    assert not node.context.ok()


def test_a_goal_that_is_no_two_numbers_is_refused(bench, tmp_path):
    with pytest.raises(ConfigurationError, match="goals: expected texts of two numbers.*'here'"):
        bench.start(Experiment, bag=tmp_path / 'bag', goals=['here'])
    assert not (tmp_path / 'bag').exists()


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
