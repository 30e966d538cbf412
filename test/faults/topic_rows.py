# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Faults of whoever publishes: contacts, readings and commands that are not what they should be."""

import itertools
import math
import signal
import time
from collections.abc import Callable
from typing import Any

from geometry_msgs.msg import PoseStamped, Quaternion, TwistStamped
from lifecycle_msgs.msg import State
from sensor_msgs.msg import JointState

from tactile_push.testing import field

from .bench import Bench, expect
from .promise import ONE_PERIOD, fault

FRAME = 'finger_disk'
BAD = 0.3  # for so long contacts that must stop the finger are sent [s]
STREAM = 1.0  # for so long messages that must not count are sent [s]
PERIOD = 0.02  # between them [s]
CALM = 3e-3  # larger than any step of v_x that the law itself makes here [m/s]
NAN = math.nan
SECOND = 'second_controller'


def contact(
    rotation: Quaternion | None = None, frame: str = FRAME, late: float = 0.0
) -> PoseStamped:
    """Return a contact at theta = 60 degrees, stamped some time ago [s]."""
    message = PoseStamped()
    message.header.stamp.sec, message.header.stamp.nanosec = _stamp(late)
    message.header.frame_id = frame
    half = math.radians(30.0)
    message.pose.orientation = rotation or Quaternion(z=math.sin(half), w=math.cos(half))
    return message


def _stamp(late: float = 0.0) -> tuple[int, int]:
    return divmod(time.time_ns() - round(late * 1e9), 1_000_000_000)


def _implausible(bench: Bench, rotation: Quaternion | None = None, frame: str = FRAME) -> None:
    """Publish contacts that no edge can have, among the real ones."""
    finger = bench.finger
    begin = time.monotonic()
    while time.monotonic() - begin < BAD:
        finger.publish('contact', contact(rotation, frame))
        bench.observer.spin(PERIOD)
    bench.stopped(begin, hold=0.1)
    expect('implausible contact' in finger.reasons_since(begin), 'stopped for another reason')
    finger.wait_until_moving()


@fault('contact not finite', ONE_PERIOD)
def contact_not_finite(bench: Bench) -> None:
    """Implausible contact; pushes on its own when they are good for a while."""
    _implausible(bench, Quaternion(x=NAN, y=NAN, z=NAN, w=NAN))


@fault('contact infinite', ONE_PERIOD)
def contact_infinite(bench: Bench) -> None:
    """Implausible contact; pushes on its own when they are good for a while."""
    _implausible(bench, Quaternion(z=math.inf, w=1.0))


@fault('contact without rotation', ONE_PERIOD)
def contact_without_rotation(bench: Bench) -> None:
    """Implausible contact; pushes on its own when they are good for a while."""
    _implausible(bench, Quaternion(w=0.0))


@fault('contact tilted', ONE_PERIOD)
def contact_tilted(bench: Bench) -> None:
    """Implausible contact; pushes on its own when they are good for a while."""
    _implausible(bench, Quaternion(x=0.5, y=0.5, z=0.5, w=0.5))


@fault('contact from behind', ONE_PERIOD)
def contact_from_behind(bench: Bench) -> None:
    """Implausible contact; pushes on its own when they are good for a while."""
    _implausible(bench, Quaternion(z=1.0, w=0.0))


@fault('contact in another frame', ONE_PERIOD)
def contact_in_another_frame(bench: Bench) -> None:
    """Implausible contact; pushes on its own when they are good for a while."""
    _implausible(bench, frame='map')


def _does_not_count(bench: Bench, topic: str, make: Callable[[], Any]) -> None:
    """Publish messages for a while and watch that the finger goes on as if there were none."""
    finger = bench.finger
    begin = time.monotonic()
    commands = max(0, len(finger.commands) - 1)
    while time.monotonic() - begin < STREAM:
        finger.publish(topic, make())
        bench.observer.spin(PERIOD)
    reasons = finger.reasons_since(begin) - {''}
    expect(not reasons, f'stopped: {", ".join(reasons)}')
    v_x = [h.twist.linear.x for h in finger.commands[commands:]]
    step = max(abs(b - a) for a, b in itertools.pairwise(v_x))
    expect(step < CALM, f'step of {1000.0 * step:.1f} mm/s')


@fault('contacts old')
def contacts_old(bench: Bench) -> None:
    """Pushes on: they do not count."""
    _does_not_count(bench, 'contact', lambda: contact(late=1.0))


@fault('contacts out of order')
def contacts_out_of_order(bench: Bench) -> None:
    """Pushes on: they do not count."""
    _does_not_count(bench, 'contact', lambda: contact(late=0.2))


@fault('contacts from the future')
def contacts_from_the_future(bench: Bench) -> None:
    """Pushes on: they do not count, and real ones still do."""
    sent = itertools.count()

    def now_and_then() -> PoseStamped:
        return contact(late=-10.0 if next(sent) % 20 == 0 else 1.0)

    _does_not_count(bench, 'contact', now_and_then)


@fault('contacts repeated')
def contacts_repeated(bench: Bench) -> None:
    """Pushes on: a stamp counts once."""
    finger = bench.finger

    def again() -> PoseStamped:
        message = contact()
        message.header = finger.contacts[-5].header
        return message

    _does_not_count(bench, 'contact', again)


@fault('readings not finite, on the topic')
def tactile_not_finite(bench: Bench) -> None:
    """Pushes on: they are refused."""
    values = itertools.cycle((NAN, math.inf, -math.inf, 1e308))

    def reading() -> JointState:
        value = next(values)
        message = JointState(name=['azimuth', 'elevation'], position=[value, value])
        message.header.stamp.sec, message.header.stamp.nanosec = _stamp()
        return message

    _does_not_count(bench, 'tactile', reading)


@fault('readings without fields, on the topic')
def tactile_without_fields(bench: Bench) -> None:
    """Pushes on: they are refused."""
    shapes = itertools.cycle(
        (([], []), (['azimuth'], []), ([], [1.0]), (['elevation', 'azimuth'], [1.0]))
    )

    def reading() -> JointState:
        names, position = next(shapes)
        message = JointState(name=names, position=position)
        message.header.stamp.sec, message.header.stamp.nanosec = _stamp()
        return message

    _does_not_count(bench, 'tactile', reading)


def command(v_x: float) -> TwistStamped:
    """Return a command that is not the controller's."""
    message = TwistStamped()
    message.header.stamp.sec, message.header.stamp.nanosec = _stamp()
    message.header.frame_id = 'finger_base'
    message.twist.linear.x = v_x
    return message


def _held(bench: Bench, reason: str) -> None:
    """Watch that the finger rests for this reason until the service is called."""
    bench.finger.expect_reason(reason)
    bench.finger.expect_rest(reason)
    bench.finger.resume()


@fault('another command', ONE_PERIOD)
def another_command(bench: Bench) -> None:
    """Another command; resumes by service."""
    bench.stopped(bench.finger.publish('finger/cmd_vel', command(0.001)))
    _held(bench, 'another command')


@fault('another command, not finite', ONE_PERIOD)
def another_command_not_finite(bench: Bench) -> None:
    """The plant ignores it; another command; resumes by service."""
    bench.stopped(bench.finger.publish('finger/cmd_vel', command(NAN)))
    _held(bench, 'another command')


@fault('two controllers', ONE_PERIOD)
def two_controllers(bench: Bench) -> None:
    """Both stop: another command; the one that is left resumes by service."""
    finger = bench.finger
    topics = ('push_controller/state', 'push_controller/resume')
    arguments = [f'{topic}:={topic.replace("push_controller", SECOND)}' for topic in topics]
    arguments.append(f'__node:={SECOND}')
    finger.nodes.start(
        'push_controller',
        {'autostart': False},
        name=SECOND,
        arguments=tuple(word for argument in arguments for word in ('-r', argument)),
    )
    bench.observer.reach_state(SECOND, State.PRIMARY_STATE_INACTIVE)
    # Nobody hears a publisher that he has not found yet.
    bench.observer.wait_for(
        lambda: finger.count('push_controller', 'other publishers of finger/cmd_vel'),
        'the controller to find the other',
    )
    ticks = bench.observer.hear(JointState, f'{SECOND}/state')
    bench.observer.reach_state(SECOND, State.PRIMARY_STATE_ACTIVE)

    def commands() -> list[float]:
        return [at for at, tick in ticks.timed() if math.isfinite(field(tick, 'v_x'))]

    first, *_ = bench.observer.wait_for(commands, 'the second controller to command the finger')
    bench.stopped(first)
    finger.signal(SECOND, signal.SIGINT)
    status = finger.ended(SECOND)
    expect(status == 0, f'exit status {status}')
    _held(bench, 'another command')
