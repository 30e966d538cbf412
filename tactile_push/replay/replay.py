# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Goes through a bag, replays its fingers, and writes a bag with what comes out."""

import os
from collections.abc import Callable, Mapping
from contextlib import ExitStack
from pathlib import Path
from typing import Any

from tactile_push.bags import BagReader
from tactile_push.fingers import fingers_in, is_own
from tactile_push.interface import (
    COMMAND,
    CONTACT,
    CONTROLLER_STATE,
    GEOMETRY_STATE,
    JOINT_STATES,
    OBJECT_POSE,
    PARAMETER_EVENTS,
    PLACE_STATE,
    PUSH_CONTROLLER,
    SENSING_STATE,
    TACTILE,
    TOPICS,
)
from tactile_push.replay.comparison import Comparison
from tactile_push.replay.finger import Finger
from tactile_push.replay.messages import still_free
from tactile_push.replay.new_bag import new_bag
from tactile_push.replay.parameters import (
    FingerParameters,
    ParameterFile,
    changed_parameters,
    parameters_in,
)

READINGS = (TACTILE, GEOMETRY_STATE, CONTACT)  # of which a replay needs one
MADE = (CONTACT, GEOMETRY_STATE, CONTROLLER_STATE, COMMAND)
SENSED = (SENSING_STATE, OBJECT_POSE)
PLACED = (PLACE_STATE,)  # made if it was recorded


def replay(
    bag: BagReader,
    *,
    config: Path | None = None,
    controller: Mapping[str, Any] | None = None,
    out: str | os.PathLike[str] | None = None,
    progress: Callable[[int], None] = lambda count: None,
) -> list[Comparison]:
    """Run a bag's readings through geometry, law and active sensing again.

    The readings go through the steps that the nodes run, on the recorded stamps, in the recorded
    order, and without waiting: the result is the same every time, to the bit. If nothing else is
    asked for and the bag has `contact_geometry/state` and `push_controller/state`, it is what the
    nodes gave. With any law but `push` that takes `place/state` and `active_sensing/state`, too,
    and a processor of the same kind. The object is sensed if the parameters of `active_sensing`
    were recorded or the file has a section for it.

    Parameters
    ----------
    bag : BagReader
        The bag, with `tactile` or `contact` of at least one finger.
    config : Path, optional
        ROS parameter file with values to use instead of the recorded ones.
    controller : mapping of str to object, optional
        Values of parameters of `push_controller` to use instead.
    out : Path, optional
        Folder of the bag to write, not there yet.
    progress : callable, optional
        Called with the number of messages read so far.

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
    used = {TACTILE, JOINT_STATES, PARAMETER_EVENTS, *MADE, *SENSED, *PLACED}
    found = fingers_in(
        bag, READINGS, used, 'nothing to replay, expected a topic tactile or contact'
    )
    recorded = parameters_in(bag)
    file = ParameterFile(config)
    file.check(found)
    replayed = []
    for namespace, topics in found.items():
        wanted = {PUSH_CONTROLLER: controller or {}}
        parameters = FingerParameters.of(recorded, namespace, file, wanted)
        replayed.append((namespace, Finger(namespace, topics, parameters, bag)))
    handlers = {
        f'{namespace}/{topic}': handler
        for namespace, finger in replayed
        for topic, handler in finger.handlers.items()
        if topic in found[namespace]
    }
    made = {
        f'{namespace}/{topic}': TOPICS[topic].type_name
        for namespace, finger in replayed
        for topic in (*MADE, *(() if finger.comparison.sensed is None else SENSED), *PLACED)
        if topic not in PLACED or topic in found[namespace]
    }
    made = still_free(bag, made)
    events = is_own(bag, PARAMETER_EVENTS)
    with ExitStack() as stack:
        new = None if out is None else stack.enter_context(new_bag(out, bag, made))
        for _, finger in replayed:
            finger.new_bag = new
        read = {*handlers, PARAMETER_EVENTS} if new is None else None
        for count, message in enumerate(bag.messages(read)):
            if count % 1000 == 0:
                progress(count)
            if message.topic in handlers:
                handlers[message.topic](message)
            elif message.topic == PARAMETER_EVENTS and events:
                node, values = changed_parameters(bag.decode(message))
                for _, finger in replayed:
                    finger.change(node, values)
            if new is not None and message.topic not in made:
                new.copy(message)
        for _, finger in replayed:
            finger.finish()
    return [finger.comparison for _, finger in replayed]
