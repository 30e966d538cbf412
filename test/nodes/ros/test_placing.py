# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Goals and estimates on their way to the law that places, and the word to let go."""

import math

import pytest
from geometry_msgs.msg import PoseStamped
from lifecycle_msgs.msg import State
from rclpy.parameter import Parameter as RosParameter
from sensor_msgs.msg import JointState
from std_msgs.msg import Bool
from std_srvs.srv import Trigger

from support.node_bench import NodeBench
from tactile_push.control.placing import STAGES
from tactile_push.control.placing.stages import (
    CANCELLED,
    NO_GOAL,
    NOTHING_KNOWN,
    SETTLING_BLINDLY,
    STEERING_BLINDLY,
)
from tactile_push.interface import (
    CANCEL,
    CONTACT,
    CONTROLLER_STATE,
    JOINT_STATES,
    PLACE,
    PLACE_GOAL,
    PLACE_RELEASE,
    PLACE_STATE,
    PUSH,
    SETTLE,
    STEER,
    TOPICS,
)
from tactile_push.nodes.push_controller import PushController
from tactile_push.nodes.ros.diagnostics import ERROR, OK, WARN
from tactile_push.nodes.ros.messages import filled
from tactile_push.nodes.ros.placing import PlaceTopics
from tactile_push.pipeline.messages import joint_state_fields, pose_fields
from tactile_push.pipeline.stamps import stamp_of
from tactile_push.tactile.planar_finger import USUAL_FINGER

# However late a loaded machine lets it run, the node shall not stop for it here.
PATIENT = {'max_ticks_lost': 100, 'contact_timeout': 10.0, 'joint_state_timeout': 10.0}
RATE = {'law': PLACE, 'control_rate': 50.0, **PATIENT}


def goal(x=0.0, theta=0.0, frame='finger_base'):
    message = PoseStamped()
    message.header.frame_id = frame
    message.pose.position.x = x
    message.pose.orientation.z, message.pose.orientation.w = (
        math.sin(theta / 2.0),
        math.cos(theta / 2.0),
    )
    return message


class Finger:
    """Publishes what the controller hears of a finger that touches an object."""

    def __init__(self, bench: NodeBench) -> None:
        self._bench = bench
        self.contacts = bench.publisher(PoseStamped, CONTACT)
        self.joints = bench.publisher(JointState, JOINT_STATES)
        self.goals = bench.publisher(PoseStamped, PLACE_GOAL)
        bench.hear(JointState, PLACE_STATE, CONTROLLER_STATE)
        bench.hear(Bool, PLACE_RELEASE)

    def touch(self):
        stamp = self._bench.peer.get_clock().now().to_msg()
        at = stamp.sec, stamp.nanosec
        angles = USUAL_FINGER.inverse(0.0, 0.08)
        joints = dict(zip(TOPICS[JOINT_STATES].field_names, angles, strict=True))
        self.joints.publish(filled(JointState(), joint_state_fields(at, joints)))
        self.contacts.publish(filled(PoseStamped(), pose_fields(at, 0.0, 0.0135, 0.1)))

    @property
    def stage(self):
        heard = self._bench.heard[PLACE_STATE]
        return STAGES[int(self._bench.values(PLACE_STATE)['stage'])] if heard else ''

    def until(self, condition):
        self._bench.until(condition, self.touch)


def test_each_control_period_has_a_state_of_the_goal_with_its_stamp(bench):
    bench.start(PushController, **RATE)
    finger = Finger(bench)
    finger.until(lambda: len(bench.heard[PLACE_STATE]) > 5)
    assert finger.stage == NO_GOAL
    assert tuple(bench.values(PLACE_STATE)) == TOPICS[PLACE_STATE].field_names
    periods = {stamp_of(message) for message in bench.heard[CONTROLLER_STATE]}
    both = [stamp_of(message) in periods for message in bench.heard[PLACE_STATE][1:-1]]
    assert all(both)
    assert bench.health == (OK, 'waiting for a goal')


def test_a_goal_that_is_none_is_refused_with_one_line_and_a_number(bench):
    node = bench.start(PushController, **RATE)
    warned = []
    node.get_logger().warning = warned.append
    finger = Finger(bench)
    finger.goals.publish(goal(theta=0.1, frame='map'))
    finger.until(lambda: finger.stage and bench.values(PLACE_STATE)['refused'] == 1.0)
    (line,) = warned
    assert line == 'place/goal: refused (x 0 m, theta 5.7 degrees): another frame'


def test_a_goal_is_served_given_up_by_the_service_and_nothing_is_let_go(bench):
    node = bench.start(PushController, **RATE)
    finger = Finger(bench)
    cancel = bench.peer.create_client(Trigger, CANCEL)
    bench.until(cancel.service_is_ready)
    finger.goals.publish(goal())
    finger.until(lambda: finger.stage and bench.values(PLACE_STATE)['goals'] == 1.0)
    answer = cancel.call_async(Trigger.Request())
    finger.until(answer.done)
    assert answer.result().success
    assert answer.result().message.startswith('was ')
    finger.until(lambda: finger.stage == CANCELLED)
    assert bench.health == (OK, 'nothing to do: cancelled')
    again = node._place._on_cancel(Trigger.Request(), Trigger.Response())
    assert (again.success, again.message) == (False, CANCELLED)
    assert [message.data for message in bench.heard[PLACE_RELEASE]] == [False]


def test_without_active_sensing_the_goal_ends_as_an_error(bench):
    bench.start(PushController, **RATE)
    finger = Finger(bench)
    finger.goals.publish(goal())
    finger.until(lambda: finger.stage == NOTHING_KNOWN)
    finger.until(lambda: bench.health == (ERROR, 'nothing to do: nothing known'))
    assert [message.data for message in bench.heard[PLACE_RELEASE]] == [False]


def test_an_inactive_node_serves_no_goal(bench):
    node = bench.start(PushController, autostart=False, **RATE)
    node.trigger_configure()
    warned = []
    node.get_logger().warning = warned.append
    goals = bench.publisher(PoseStamped, PLACE_GOAL)
    goals.publish(goal())
    bench.until(lambda: warned)
    assert warned[0].endswith('inactive')
    answer = node._place._on_cancel(Trigger.Request(), Trigger.Response())
    assert (answer.success, answer.message) == (False, 'inactive')


def test_the_law_counts_from_the_next_activation_on(bench):
    node = bench.start(PushController, **PATIENT)
    assert PLACE_STATE not in node._outputs
    (result,) = node.set_parameters([RosParameter('law', value=PLACE)])
    assert result.successful
    assert node._steps.placing is None
    node.trigger_deactivate()
    node.trigger_activate()
    assert node._steps.placing is not None
    bench.until(lambda: PLACE_STATE in bench.topics()[0])
    node.set_parameters([RosParameter('law', value=PUSH)])
    node.trigger_deactivate()
    node.trigger_activate()
    assert node._steps.placing is None
    assert node._state_machine.current_state[0] == State.PRIMARY_STATE_ACTIVE


def test_the_law_that_steers_takes_goals_and_gives_them_up(bench):
    node = bench.start(PushController, law=STEER, **PATIENT)
    bench.until(lambda: PLACE_GOAL in bench.topics()[1])
    assert PLACE_RELEASE not in node._outputs
    warned = []
    node.get_logger().warning = warned.append
    goals = bench.publisher(PoseStamped, PLACE_GOAL)
    goals.publish(goal(x=0.5))
    bench.until(lambda: warned)
    assert warned == ['place/goal: refused (x 0.5 m, theta 0.0 degrees): outside the workspace']
    goals.publish(goal(x=0.02))
    bench.until(lambda: node._control.steadying.goal == 0.02)
    answer = node._place._on_cancel(Trigger.Request(), Trigger.Response())
    assert (answer.success, answer.message) == (True, f'was {STEERING_BLINDLY}')
    assert math.isnan(node._control.steadying.goal)
    node.set_parameters([RosParameter('law', value=PLACE)])
    node.trigger_deactivate()
    node.trigger_activate()
    bench.until(lambda: PLACE_RELEASE in bench.topics()[0])
    goals.publish(goal(x=0.01))
    bench.until(lambda: node._steps.placing.goals == 1)  # heard once


def test_the_law_that_settles_takes_goals_and_says_when_nothing_is_known(bench):
    node = bench.start(PushController, **(RATE | {'law': SETTLE}))
    warned = []
    node.get_logger().warning = warned.append
    finger = Finger(bench)
    finger.goals.publish(goal(x=0.5, theta=0.2))
    finger.until(lambda: node._steps.placing.goals == 1)
    assert node._control.law.aim == pytest.approx(0.2)
    doubt = 'nothing is known of the object, so law (18) acts'
    finger.until(lambda: bench.health == (WARN, f'pushing, but {doubt}'))
    assert warned == [f'place/goal: {doubt}']
    assert finger.stage == SETTLING_BLINDLY
    assert PLACE_RELEASE not in node._outputs
    answer = node._place._on_cancel(Trigger.Request(), Trigger.Response())
    assert (answer.success, answer.message) == (True, f'was {SETTLING_BLINDLY}')


class Told:
    """Stands in for the steps: wants to let go soon, and says whether that holds."""

    def __init__(self, let_go_in, holds=True):
        self.let_go_in, self.holds = let_go_in, holds
        self.stage, self.doubt = 'placing', ''
        self.released = 0
        self.awaits_estimate = False

    def release(self):
        self.released += self.holds
        self.let_go_in = math.nan
        return self.holds

    def look_ahead(self):
        pass

    def cancel(self):
        self.let_go_in = math.nan
        return True


@pytest.fixture
def serving(bench):
    """Return what lets a node serve steps that stand in, and the words to let go that it said."""
    node = bench.start(PushController, **RATE)
    bench.hear(Bool, PLACE_RELEASE)
    node.destroy_timer(node._timer)  # so that no tick comes in between
    place: PlaceTopics = node._place

    def serve(told):
        place.serve(told)
        place.after_tick(node.get_clock().now().to_msg())
        return place

    return serve


def waits(bench, seconds):
    """Let the node run for a while, by its own clock."""
    clock = bench.node.get_clock()
    end = clock.now().nanoseconds + seconds * 1e9
    bench.until(lambda: clock.now().nanoseconds > end)


def test_the_word_comes_at_its_moment(bench, serving):
    told = Told(0.15)
    start = bench.node.get_clock().now().nanoseconds
    serving(told)
    bench.until(lambda: told.released)
    assert (bench.node.get_clock().now().nanoseconds - start) * 1e-9 >= 0.15
    bench.until(lambda: bench.heard[PLACE_RELEASE])
    waits(bench, 0.2)
    assert [message.data for message in bench.heard[PLACE_RELEASE]] == [True]


def test_a_word_that_does_not_hold_any_more_is_not_said(bench, serving):
    told = Told(0.02, holds=False)
    serving(told)
    bench.until(lambda: math.isnan(told.let_go_in))
    waits(bench, 0.1)
    assert bench.heard[PLACE_RELEASE] == []


def test_a_tick_that_comes_first_says_the_word_that_is_overdue(bench, serving):
    told = Told(5.0)
    serving(told).before_tick()
    assert told.released == 1


@pytest.mark.parametrize(
    'end',
    [
        lambda place: place._on_cancel(Trigger.Request(), Trigger.Response()),
        lambda place: place.serve(None),
    ],
    ids=['cancelled', 'deactivated'],
)
def test_what_comes_before_keeps_the_word_back(bench, serving, end):
    told = Told(0.05)
    end(serving(told))
    waits(bench, 0.2)
    assert told.released == 0
    assert bench.heard[PLACE_RELEASE] == []


def test_simulated_time_waits_for_an_estimate_but_not_for_ever(bench, serving):
    told = Told(math.nan)
    place = serving(told)
    assert not place.waits()
    told.awaits_estimate = True
    assert place.waits()
    bench.until(lambda: not place.waits())
    # Who has not answered is not waited for until it does.
    assert not place.waits()
    told.sensed = lambda *message: None
    place._on_estimate(JointState())
    assert place.waits()


def test_each_end_of_a_goal_is_told_once_at_its_level(bench, serving, capfd):
    told = Told(math.nan)
    place = serving(told)
    stamp = bench.node.get_clock().now().to_msg()
    capfd.readouterr()
    # Through rclpy's own logger, which takes no two levels of one line of code.
    for stage in ('released', 'released', 'learning', 'missed', 'cancelled'):
        told.stage = stage
        place.after_tick(stamp)
    lines = capfd.readouterr().err.splitlines()
    assert [(line.split(']')[0], line.split(': ', 1)[1]) for line in lines] == [
        ('[INFO', 'place/goal: released'),
        ('[WARN', 'place/goal: missed'),
        ('[WARN', 'place/goal: cancelled'),
    ]
