# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Faults of goals, and of what is known of the object, while it is placed."""

import math
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace

from geometry_msgs.msg import PoseStamped
from lifecycle_msgs.msg import Transition
from std_srvs.srv import Trigger

from tactile_push.control.placing import REFUSALS
from tactile_push.interface import ACTIVE_SENSING, CANCEL, JOINT_STATES, PLACE, SETTLE
from tactile_push.tactile import NO_CONTACT
from tactile_push.testing import field

from .bench import Bench, expect
from .finger import Finger, goal
from .promise import ASKED, ESTIMATE_LOST, ONE_PERIOD, SIGNAL, SILENT, Setup, fault
from .topic_rows import command

PLACES = Setup(law=PLACE)
SETTLES = Setup(law=SETTLE)
# Pushed so far to the right at this angle, an object goes to the left all the way.
TURNED, OFF = 0.35, 0.015  # [rad, m]
REGRASPS = Setup(
    law=PLACE,
    controller=(('axes', 2),),
    sensing=(('edge', 0), ('l_share', 0.01), ('noise', 0.003), ('tilt_max', 0.0)),
    plant=(('theta_initial', TURNED), ('d_initial', 0.012)),
)
JOINTLESS = replace(REGRASPS, relay=JOINT_STATES)
SHORT = Setup(law=PLACE, controller=(('belt_length', 0.01),))
# Turns a third as fast as the object that is pushed.
DEEP = [-0.025, -0.1, 0.025, -0.1, 0.025, 0.1, -0.025, 0.1]
OTHER = Setup(law=PLACE, sensing=(('vertices', DEEP),))
RESTS = 0.6  # for so long a finger is watched that has nothing to do any more [s]
SLOW = 30.0  # within which a belt is used up or another object shows [s]
BEYOND = 1.0  # outside any workspace [m]


@contextmanager
def _nothing_let_go(bench: Bench) -> Iterator[Finger]:
    """Watch that the object is not let go meanwhile."""
    finger = bench.finger
    before = len(finger.releases)
    yield finger
    bench.observer.spin(0.1)
    expect(not any(message.data for message in finger.releases[before:]), 'let the object go')


def _ends(finger: Finger, stage: str) -> None:
    """Watch that a goal has ended so, and that the finger rests although all is well again."""
    finger.expect_stage(stage)
    finger.expect_reason('nothing to do')  # the last command of a belt that is used up is its own
    finger.expect_rest('nothing to do', RESTS)
    expect(finger.stage == stage, f'went on as {finger.stage}')


def _refused(bench: Bench, message: PoseStamped, why: str) -> None:
    """Give a goal that is none, and watch that the finger goes on to the one before."""
    with _nothing_let_go(bench) as finger:
        taken, begin = field(finger.place_states[-1], 'goals'), time.monotonic()
        finger.give_goal(message)
        said = finger.place_states[-1]
        reason = REFUSALS[int(field(said, 'refusal'))]
        expect(reason == why, f'refused as {reason or "none"}')
        expect(field(said, 'goals') == taken, 'taken')
        finger.wait_until_moving()
        stopped = finger.reasons_since(begin) - {''}
        expect(not stopped, f'stopped: {", ".join(stopped)}')


@fault('goal not finite', setup=PLACES)
def goal_not_finite(bench: Bench) -> None:
    """Refused; pushes on to the goal before."""
    _refused(bench, goal(math.nan), 'not finite')
    _refused(bench, goal(0.0, math.nan), 'not finite')


@fault('goal in another frame', setup=PLACES)
def goal_in_another_frame(bench: Bench) -> None:
    """Refused; pushes on to the goal before."""
    _refused(bench, goal(0.0, frame='map'), 'another frame')


@fault('goal tilted', setup=PLACES)
def goal_tilted(bench: Bench) -> None:
    """Refused; pushes on to the goal before."""
    message = goal(0.0)
    message.pose.orientation.x = 0.5
    _refused(bench, message, 'no rotation about z')


@fault('goal from behind', setup=PLACES)
def goal_from_behind(bench: Bench) -> None:
    """Refused; pushes on to the goal before."""
    _refused(bench, goal(0.0, 3.0), 'the edge would face away')


@fault('goal outside the workspace', setup=PLACES)
def goal_outside_the_workspace(bench: Bench) -> None:
    """Refused; pushes on to the goal before."""
    _refused(bench, goal(BEYOND), 'outside the workspace')


def _cancel(bench: Bench) -> None:
    name = bench.finger.name(CANCEL)
    answer = bench.observer.call(Trigger, name, Trigger.Request(), patience=3.0)
    expect(answer.success, f'refused: {answer.message}')


def _deactivate(bench: Bench) -> None:
    node = bench.finger.name('push_controller')
    done = bench.observer.change_state(node, Transition.TRANSITION_DEACTIVATE)
    expect(done, 'deactivation refused')


@fault('goal cancelled', ASKED, setup=PLACES)
def goal_cancelled(bench: Bench) -> None:
    """Rests until the next goal; nothing is let go."""
    _given_up(bench, _cancel)
    _ends(bench.finger, 'cancelled')


@fault('controller deactivated while placing', SIGNAL, setup=PLACES)
def deactivated_while_placing(bench: Bench) -> None:
    """Gives the goal up; active again it commands nothing before the next goal."""
    _given_up(bench, _deactivate)
    finger, node = bench.finger, bench.finger.name('push_controller')
    finger.expect_stage('cancelled')
    said = len(finger.commands)
    expect(bench.observer.change_state(node, Transition.TRANSITION_ACTIVATE), 'activation refused')
    finger.expect_stage('no goal')
    bench.observer.spin(RESTS)
    expect(len(finger.commands) == said, 'commands without a goal')


def _given_up(bench: Bench, give_up: Callable[[Bench], None]) -> None:
    with _nothing_let_go(bench):
        at = time.monotonic()
        give_up(bench)
        bench.stopped(at)


@fault('contact lost while placing', SILENT, setup=PLACES)
def contact_lost_while_placing(bench: Bench) -> None:
    """Object lost; rests though the contact is back; nothing is let go."""
    with _nothing_let_go(bench) as finger:
        at = time.monotonic()
        finger.proxy.alter = lambda sentence: replace(sentence, reading=NO_CONTACT)
        bench.stopped(at)
        finger.proxy.mend()
        _ends(finger, 'object lost')


@fault('another command while placing', ONE_PERIOD, setup=PLACES)
def another_command_while_placing(bench: Bench) -> None:
    """Another command; refuses goals until it is resumed; nothing is let go."""
    with _nothing_let_go(bench) as finger:
        bench.stopped(finger.publish('finger/cmd_vel', command(0.001)))
        finger.expect_rest('another command')
        finger.give_goal(goal(0.0))
        refusal = REFUSALS[int(field(finger.place_states[-1], 'refusal'))]
        expect(refusal == 'stopped until resumed', f'refused as {refusal or "none"}')
        finger.resume()


@fault('belt used up while placing', setup=SHORT)
def belt_used_up(bench: Bench) -> None:
    """Missed; rests; nothing is let go."""
    with _nothing_let_go(bench) as finger:
        finger.expect_stage('missed', SLOW)
        _ends(finger, 'missed')


@fault('another object while placing', setup=OTHER)
def another_object(bench: Bench) -> None:
    """Contradiction; rests; nothing is let go."""
    with _nothing_let_go(bench) as finger:
        finger.expect_stage('contradiction', SLOW)
        _ends(finger, 'contradiction')


@fault('active_sensing killed while placing', ESTIMATE_LOST, setup=PLACES, last=True)
def sensing_killed(bench: Bench) -> None:
    """Goes on by the last estimate for 5 control periods; nothing known; nothing is let go."""
    with _nothing_let_go(bench) as finger:
        bench.stopped(finger.kill(ACTIVE_SENSING))
        _ends(finger, 'nothing known')


@contextmanager
def _off_the_object(bench: Bench) -> Iterator[Finger]:
    """Give a goal that only a second contact leads to, and wait until the finger goes there."""
    with _nothing_let_go(bench) as finger:
        start = field(finger.truth[0], 'object_x')
        finger.give_goal(goal(start + OFF, TURNED))
        finger.expect_stage('regrasping', SLOW)
        finger.wait_until_moving()  # across
        expect(finger.stage == 'regrasping', f'is {finger.stage} already')
        yield finger


@fault('contact lost on purpose', setup=REGRASPS)
def contact_lost_on_purpose(bench: Bench) -> None:
    """No stop; the object is touched elsewhere, and what is known of it stays."""
    begin = time.monotonic()
    with _off_the_object(bench) as finger:
        finger.expect_stage('placing', SLOW)
        stopped = finger.reasons_since(begin) - {''}
        expect(not stopped, f'stopped: {", ".join(stopped)}')


@fault('contact that does not come back', setup=REGRASPS)
def contact_that_does_not_come_back(bench: Bench) -> None:
    """Object lost; rests though the contact is back; nothing is let go."""
    with _off_the_object(bench) as finger:
        finger.proxy.alter = lambda sentence: replace(sentence, reading=NO_CONTACT)
        finger.expect_stage('object lost', SLOW)
        finger.proxy.mend()
        _ends(finger, 'object lost')


@fault('goal cancelled off the object', ASKED, setup=REGRASPS)
def goal_cancelled_off_the_object(bench: Bench) -> None:
    """Rests until the next goal, both ways."""
    with _off_the_object(bench) as finger:
        at = time.monotonic()
        _cancel(bench)
        bench.stopped(at)
        _ends(finger, 'cancelled')


@fault('joint states missing off the object', SILENT, setup=JOINTLESS)
def joint_states_missing_off_the_object(bench: Bench) -> None:
    """Finger position unknown; then the object is lost; nothing is let go."""
    with _off_the_object(bench) as finger:
        at = time.monotonic()
        finger.relay.alter = lambda message: None
        bench.stopped(at)
        finger.relay.mend()
        finger.expect_stage('object lost')


@fault('contact lost while settling', SILENT, setup=SETTLES)
def contact_lost_while_settling(bench: Bench) -> None:
    """Contact silent; goes on to the goal when contact is back."""
    finger = bench.finger
    at = time.monotonic()
    finger.proxy.alter = lambda sentence: replace(sentence, reading=NO_CONTACT)
    bench.stopped(at)
    finger.expect_rest('contact silent')
    finger.proxy.mend()
    finger.turn()
    finger.wait_until_moving()
    finger.expect_stage('settling')


@fault('active_sensing killed while settling', setup=SETTLES, last=True)
def sensing_killed_while_settling(bench: Bench) -> None:
    """Goes on by the last estimate for 5 control periods, then by law (18)."""
    finger = bench.finger
    finger.expect_stage('settling')
    begin = time.monotonic()
    finger.kill(ACTIVE_SENSING)
    finger.expect_stage('settling by law (18)')
    finger.turn()
    finger.wait_until_moving()
    stopped = finger.reasons_since(begin) - {''}
    expect(not stopped, f'stopped: {", ".join(stopped)}')
