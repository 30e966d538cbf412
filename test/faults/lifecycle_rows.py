# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Managed nodes that are asked for every transition in every state, also for wrong ones."""

import random
import signal
import subprocess
from functools import partial

from geometry_msgs.msg import TwistStamped
from lifecycle_msgs.msg import State, Transition
from sensor_msgs.msg import JointState

from tactile_push.interface import CAMERA_SENSOR, NODES

from .bench import Bench, expect
from .promise import NO_BENCH, fault

UNCONFIGURED, INACTIVE = State.PRIMARY_STATE_UNCONFIGURED, State.PRIMARY_STATE_INACTIVE
ACTIVE, FINALIZED = State.PRIMARY_STATE_ACTIVE, State.PRIMARY_STATE_FINALIZED
LEADS_TO = {
    (UNCONFIGURED, Transition.TRANSITION_CONFIGURE): INACTIVE,
    (UNCONFIGURED, Transition.TRANSITION_UNCONFIGURED_SHUTDOWN): FINALIZED,
    (INACTIVE, Transition.TRANSITION_CLEANUP): UNCONFIGURED,
    (INACTIVE, Transition.TRANSITION_ACTIVATE): ACTIVE,
    (INACTIVE, Transition.TRANSITION_INACTIVE_SHUTDOWN): FINALIZED,
    (ACTIVE, Transition.TRANSITION_DEACTIVATE): INACTIVE,
    (ACTIVE, Transition.TRANSITION_ACTIVE_SHUTDOWN): FINALIZED,
}
NO_SHUTDOWN = tuple(range(5))  # create, configure, clean up, activate, deactivate
EVERY = (*range(9), 10, 11, 20, 30, 42, 62, 255)  # internal and unknown ones too
REQUESTS = 60
MANAGED = ('push_controller', 'sensor_driver')
# Those that start without a file.
EVERY_MANAGED = tuple(n.name for n in NODES.values() if n.managed and n.name != CAMERA_SENSOR)


def _ask(bench: Bench, node: str, state: int, transition: int) -> int:
    """Ask for a transition, compare with what the state allows, and give the state after it."""
    after = LEADS_TO.get((state, transition), state)
    done = bench.observer.change_state(node, transition)
    now = bench.observer.lifecycle_state(node)
    expect(
        (done, now) == ((state, transition) in LEADS_TO, after),
        f'{node}: transition {transition} in state {state} {"led" if done else "did not lead"} '
        f'to {now}, expected {after}',
    )
    return after


def _has_ended(process: subprocess.Popen[bytes]) -> bool:
    return process.poll() is not None


@fault('lifecycle: every order')
def every_order(bench: Bench) -> None:
    """Makes what the state allows, refuses the rest; silent unless active; pushes on."""
    finger, draw = bench.finger, random.Random(1)
    for name in MANAGED:
        node, state = finger.name(name), ACTIVE
        for _ in range(REQUESTS):
            said = len(finger.commands), len(finger.tactile)
            state = _ask(bench, node, state, draw.choice(NO_SHUTDOWN))
            if state != ACTIVE:
                spoken = len(finger.tactile) - said[1]
                if name == 'push_controller':
                    spoken = sum(h.twist.linear.x != 0.0 for h in finger.commands[said[0] + 1 :])
                expect(spoken <= 2, f'{name} speaks in state {state}')
        bench.observer.reach_state(node, ACTIVE)
    finger.wait_until_moving()


@fault('lifecycle: every transition in every state', setup=NO_BENCH)
def every_transition(bench: Bench) -> None:
    """Refuses, twice, what the state does not allow; nothing leads out of the last state."""
    for name in EVERY_MANAGED:
        for goal in (UNCONFIGURED, INACTIVE, ACTIVE):
            bench.nodes.start(name, {'autostart': False})
            bench.observer.reach_state(name, goal)
            wrong = [t for t in EVERY if (goal, t) not in LEADS_TO]
            for transition in (*wrong, *wrong):
                _ask(bench, name, goal, transition)
            (shutdown,) = [t for s, t in LEADS_TO if s == goal and LEADS_TO[s, t] == FINALIZED]
            _ask(bench, name, goal, shutdown)
            for transition in EVERY:
                _ask(bench, name, FINALIZED, transition)
            process = bench.nodes.running.pop(name)
            process.send_signal(signal.SIGINT)
            bench.observer.wait_for(partial(_has_ended, process), f'{name} to end', 5.0)
            expect(process.returncode == 0, f'{name}: exit status {process.returncode}')


@fault('controller alone', setup=NO_BENCH)
def controller_alone(bench: Bench) -> None:
    """Commands nothing before the first contact; a last 0 only."""
    commands = bench.observer.hear(TwistStamped, '/finger/cmd_vel')
    states = bench.observer.hear(JointState, '/push_controller/state')
    process = bench.nodes.start('push_controller')
    bench.observer.wait_for(lambda: len(states) > 10, 'ticks')
    expect(not commands, f'{len(commands)} commands')
    bench.nodes.running.pop('push_controller')
    process.send_signal(signal.SIGTERM)
    bench.observer.wait_for(partial(_has_ended, process), 'the controller to end', 5.0)
    expect(all(h.twist.linear.x == 0.0 for h in commands), 'a last command that is not 0')
