# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What the control periods in a bag tell about the objects that were pushed."""

import math
import os
from collections.abc import Callable, Mapping
from contextlib import ExitStack
from pathlib import Path
from typing import Any

from tactile_push.bags import BagError, BagReader
from tactile_push.control import tick_of
from tactile_push.paper import BLOCK_CORNERS, object_with
from tactile_push.pipeline.stamps import epoch_of
from tactile_push.replay.new_bag import copy, new_bag
from tactile_push.replay.object_history import ObjectFigures, ObjectHistory
from tactile_push.replay.parameters import (
    check_config,
    read_config,
    recorded_parameters,
    sensing_parameters,
)
from tactile_push.replay.sensing import POSE, STATE, TOPICS, Sensing

TICKS, TRUTH = 'push_controller/state', 'ground_truth/state'
JOINT_STATE = 'sensor_msgs/msg/JointState'


def estimate(
    bag: BagReader,
    *,
    config: Path | None = None,
    sensing: Mapping[str, Any] | None = None,
    out: str | os.PathLike[str] | None = None,
    progress: Callable[[int], None] = lambda count: None,
) -> list[ObjectFigures]:
    """Run active sensing over all recorded control periods, whatever was recorded of it.

    Readings without control periods do not do: nobody knows how the finger moved.

    Parameters
    ----------
    bag : BagReader
        The bag, with `push_controller/state` of at least one finger.
    config : path, optional
        ROS parameter file with values for `active_sensing` to use instead of the recorded ones.
    sensing : mapping of str to object, optional
        Values of its parameters to use instead.
    out : path, optional
        Folder of the bag to write, not there yet.
    progress : callable, optional
        Told how many messages have been read.

    Returns
    -------
    list of ObjectFigures
        One for each finger.

    Raises
    ------
    BagError
        If there are no control periods or the bag cannot be read.
    ValueError
        If a value of a parameter is refused.
    OSError
        If a file cannot be read, or the new bag cannot be written.
    """
    namespaces = _namespaces(bag)
    check_config(config, namespaces, ['active_sensing'])
    epoch = epoch_of(bag.start_time // 10**9)
    sensors: dict[str, Sensing] = {}
    histories: dict[str, ObjectHistory] = {}
    for namespace in namespaces:
        given = recorded_parameters(bag.notes, namespace)
        wanted = read_config(config, namespace)
        wanted['active_sensing'].update(sensing or {})
        values = sensing_parameters(given, wanted)
        sensors[namespace] = Sensing(values, epoch)
        known = {*given['active_sensing'], *wanted['active_sensing']}
        told = bool(known & {'vertices', 'disk_radius'})
        numbers = values.get('vertices', [x for corner in BLOCK_CORNERS for x in corner])
        corners = zip(numbers[::2], numbers[1::2], strict=True)
        pushed = object_with(corners, values.get('disk_radius', 0.0))
        histories[namespace] = ObjectHistory(namespace.strip('/'), bag.start_time, told, pushed)
    inputs = {f'{n}{topic}': (n, topic) for n in namespaces for topic in (TICKS, TRUTH)}
    made = {f'{n}{topic}': kind for n in namespaces for topic, kind in TOPICS.items()}
    with ExitStack() as stack:
        writer = None if out is None else stack.enter_context(new_bag(out, bag, made))
        for count, message in enumerate(bag.messages(inputs if writer is None else None)):
            if count % 1000 == 0:
                progress(count)
            if writer is not None and message.topic not in made:
                copy(writer, message)
            if message.topic not in inputs:
                continue
            namespace, topic = inputs[message.topic]
            decoded = bag.decode(message)
            stamp = decoded.header.stamp.sec, decoded.header.stamp.nanosec
            values = dict(zip(decoded.name, decoded.position, strict=False))
            if topic == TRUTH:
                histories[namespace].truth(stamp, values)
                continue
            try:
                tick = tick_of(values)
            except ValueError as error:
                raise BagError(f'{bag.path}: {message.topic}: {error}') from None
            sensed = sensors[namespace].tick(stamp, tick)
            desired = values.get('theta_desired', math.nan)
            histories[namespace].add(stamp, tick.state, desired, sensed)
            for topic, data in ((STATE, sensed.state), (POSE, sensed.pose)):
                if writer is not None and data is not None:
                    at = message.log_time
                    writer.write(f'{namespace}{topic}', data, at, at)
    return [history.figures() for history in histories.values()]


def _namespaces(bag: BagReader) -> list[str]:
    """Find the fingers of which the bag has control periods."""
    found = [
        name.removesuffix(TICKS)
        for name in bag.topics
        if name.endswith(f'/{TICKS}') and bag.counts[name]
    ]
    if not found:
        raise BagError(
            f'{bag.path}: no control periods, expected a topic {TICKS}: nobody knows how the '
            'finger moved'
        )
    for namespace in found:
        for topic in (TICKS, TRUTH):
            known = bag.topics.get(f'{namespace}{topic}')
            if known is not None and known.type_name != JOINT_STATE:
                raise BagError(
                    f'{bag.path}: {known.name}: expected {JOINT_STATE}, got {known.type_name}'
                )
    return found
