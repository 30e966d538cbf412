# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Goes through a bag, replays its fingers, and writes a bag with what comes out."""

import os
from collections.abc import Callable, Mapping
from contextlib import ExitStack
from functools import partial
from pathlib import Path
from typing import Any

from tactile_push.bags import BagError, BagReader, BagWriter
from tactile_push.pipeline.stamps import epoch_of
from tactile_push.replay.comparison import Comparison
from tactile_push.replay.finger import INPUTS, OUTPUTS, Finger
from tactile_push.replay.new_bag import copy, new_bag
from tactile_push.replay.parameters import (
    ByNode,
    changed_parameters,
    check_config,
    names_node,
    read_config,
    recorded_parameters,
    sensing_parameters,
    without_effect,
)
from tactile_push.replay.sensing import TOPICS as OF_SENSING

EVENTS = '/parameter_events'
READINGS = {'tactile', 'contact_geometry/state', 'contact'}  # of which a replay needs one


def replay(
    bag: BagReader,
    *,
    config: Path | None = None,
    controller: Mapping[str, Any] | None = None,
    out: str | os.PathLike[str] | None = None,
    progress: Callable[[int], None] = lambda count: None,
) -> list[Comparison]:
    """Run a bag's readings through geometry, law and active sensing again.

    The readings go through the code that the nodes run, on the recorded stamps, in the recorded
    order, and without waiting: the result is the same every time, to the bit. Where nothing else
    is asked for and the bag has `contact_geometry/state` and `push_controller/state`, it is what
    the nodes gave. The object is sensed if the parameters of `active_sensing` were recorded or the
    file has a section for it.

    Parameters
    ----------
    bag : BagReader
        The bag, with `tactile` or `contact` of at least one finger.
    config : path, optional
        ROS parameter file with values to use instead of the recorded ones.
    controller : mapping of str to object, optional
        Values of parameters of `push_controller` to use instead.
    out : path, optional
        Folder of the bag to write, not there yet.
    progress : callable, optional
        Told how many messages have been read.

    Returns
    -------
    list of Comparison
        One for each finger.

    Raises
    ------
    BagError
        If there is nothing to replay or the bag cannot be read.
    ValueError
        If a value of a parameter is refused.
    OSError
        If a file cannot be read, or the new bag cannot be written.
    """
    fingers: dict[str, Finger] = {}
    found = _namespaces(bag)
    if not found:
        raise BagError(f'{bag.path}: nothing to replay, expected a topic tactile or contact')
    check_config(config, found)
    with ExitStack() as stack:
        parameters = {n: _parameters(bag, n, config, controller or {}) for n in found}
        begin = bag.start_time, epoch_of(bag.start_time // 10**9)
        for namespace, (given, wanted) in parameters.items():
            fingers[namespace] = Finger(
                namespace,
                found[namespace],
                given,
                set(wanted['push_controller']),
                begin,
                bag.decode,
            )
            fingers[namespace].comparison.without_effect = without_effect(
                recorded_parameters(bag.notes, namespace), wanted, found[namespace]
            )
        if out is not None:
            made = {
                f'{namespace}{topic}': INPUTS[topic]
                for namespace, finger in fingers.items()
                for topic in OUTPUTS
                if topic not in OF_SENSING or finger.comparison.sensed is not None
            }
            writer = stack.enter_context(new_bag(out, bag, made))
            for namespace, finger in fingers.items():
                finger.write = partial(_write, writer, namespace)
        inputs = {f'{n}{topic}': (n, topic) for n in found for topic in INPUTS}
        wanted_topics = None if out is not None else {*inputs, EVENTS}
        for count, message in enumerate(bag.messages(wanted_topics)):
            if count % 1000 == 0:
                progress(count)
            if message.topic in inputs:
                namespace, topic = inputs[message.topic]
                fingers[namespace].take(topic, message)
                if topic not in OUTPUTS and out is not None:
                    copy(writer, message)
            else:
                if message.topic == EVENTS:
                    _change(fingers, parameters, bag.decode(message))
                if out is not None:
                    copy(writer, message)
        for finger in fingers.values():
            finger.finish()
    return [finger.comparison for finger in fingers.values()]


def _namespaces(bag: BagReader) -> dict[str, set[str]]:
    """Find the fingers, and the topics of each that can be replayed."""
    found: dict[str, set[str]] = {}
    for name in bag.topics:
        for reading in READINGS:
            if name.endswith(f'/{reading}') and bag.counts[name]:
                found.setdefault(name.removesuffix(reading), set())
    for namespace, topics in found.items():
        for known, type_name in INPUTS.items():
            name = f'{namespace}{known}'
            if name in bag.topics and bag.counts[name]:
                if bag.topics[name].type_name != type_name:
                    raise BagError(
                        f'{bag.path}: {name}: expected {type_name}, '
                        f'got {bag.topics[name].type_name}'
                    )
                topics.add(known)
    return found


def _parameters(
    bag: BagReader, namespace: str, config: Path | None, controller: Mapping[str, Any]
) -> tuple[ByNode, ByNode]:
    """Give the parameters of a finger's nodes, and those of them that do not follow the bag."""
    given = recorded_parameters(bag.notes, namespace)
    wanted = read_config(config, namespace)
    wanted['push_controller'].update(controller)
    used = {node: given[node] | wanted[node] for node in given}
    used['active_sensing'] = sensing_parameters(given, wanted)
    if not (given['active_sensing'] or names_node(config, namespace, 'active_sensing')):
        del used['active_sensing']
    return used, wanted


def _change(
    fingers: Mapping[str, Finger],
    parameters: Mapping[str, tuple[Mapping[str, Any], Mapping[str, Any]]],
    event: Any,
) -> None:
    """Let a finger's nodes know of parameters that changed and are not wanted otherwise."""
    name, changed = changed_parameters(event)
    for namespace, finger in fingers.items():
        node = name.removeprefix(namespace)
        if name.startswith(namespace) and '/' not in node:
            wanted = parameters[namespace][1].get(node, {})
            finger.change(node, {k: v for k, v in changed.items() if k not in wanted})


def _write(writer: BagWriter, namespace: str, topic: str, data: bytes, log_time: int) -> None:
    writer.write(f'{namespace}{topic}', data, log_time, log_time)
