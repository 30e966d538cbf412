# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Messages at their extremes, to the real nodes."""

import copy
import math
import time
from collections.abc import Callable
from typing import Any

from geometry_msgs.msg import TwistStamped
from sensor_msgs.msg import JointState

from faults.bench import Bench
from faults.finger import goal
from tactile_push.control import HELD
from tactile_push.interface import PLACE
from tactile_push.testing import field

from .chain import FuzzError
from .messages import extremes

PAUSE = 0.005  # between messages [s]
CLOSE_LOOK = 10  # messages between two looks at what the nodes said


def send_extremes(bench: Bench, progress: Callable[[str], None] = lambda what: None) -> int:
    """Send every message that the nodes hear with every field at its extremes.

    Parameters
    ----------
    bench : Bench
        A running bench.
    progress : callable, optional
        Told what is being sent.

    Returns
    -------
    int
        How many messages were sent.

    Raises
    ------
    FuzzError
        If a node said or did what it must not.
    BrokenPromiseError
        If the finger does not push afterwards.
    """
    finger = bench.finger
    places = bench.setup.law == PLACE
    topics = _of_placing(bench) if places else _of_pushing(bench)
    sent = 0
    for topic, valid in topics.items():
        for what, message in extremes(valid):
            progress(f'{topic}: {what}')
            if places:  # with the stamps of real periods, whose commands are no foreign ones
                bench.observer.publish(finger.name(topic), message)
            else:
                finger.publish(topic, message)
            bench.observer.spin(PAUSE)
            sent += 1
            if sent % CLOSE_LOOK == 0:
                _look(bench, f'{topic}: {what}')
        _look(bench, topic)
    bench.observer.spin(1.0)
    finger.turn()
    if finger.reason in HELD:
        finger.resume()
    finger.wait_until_moving(10.0)
    _look(bench, 'at the end')
    return sent


def _of_pushing(bench: Bench) -> dict[str, Any]:
    """Return valid messages by topic that the nodes of law (18) hear."""
    finger = bench.finger
    joints = bench.observer.hear(JointState, finger.name('joint_states'))
    finger.push()
    bench.observer.wait_for(lambda: joints, 'joint states')
    finger.nodes.start('active_sensing', {})
    state = finger.name('push_controller/state')
    bench.observer.wait_for(
        lambda: bench.observer.node.count_subscribers(state) > 1, 'active_sensing to listen'
    )
    return {
        'contact': finger.contacts[-1],
        'tactile': finger.tactile[-1],
        'joint_states': joints[-1],
        'push_controller/state': finger.states[-1],
        'finger/cmd_vel': TwistStamped(),
    }


def _of_placing(bench: Bench) -> dict[str, Any]:
    """Return those that the law that places hears besides."""
    estimates = bench.observer.hear(JointState, bench.finger.name('active_sensing/state'))
    bench.finger.push()
    bench.observer.wait_for(lambda: estimates, 'an estimate')
    return {'active_sensing/state': estimates[-1], 'place/goal': goal(0.0)}


def _stamped(message: Any) -> Any:
    """Return a copy that is stamped now."""
    fresh = copy.deepcopy(message)
    stamp = fresh.header.stamp
    stamp.sec, stamp.nanosec = divmod(time.time_ns(), 1_000_000_000)
    return fresh


def _look(bench: Bench, after: str) -> None:
    """Raise `FuzzError` if a node has ended, thrown or moved by what is no number."""
    found = bench.complaints()
    if not all(math.isfinite(field(m, 'v_x')) for m in bench.finger.truth[-100:]):
        found.append('the finger moves at no finite velocity')
    if found:
        raise FuzzError(f'after {after}: {"; ".join(found)}')
