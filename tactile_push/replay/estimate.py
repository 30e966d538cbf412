# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Runs active sensing over the control periods in a bag."""

import math
import os
from collections.abc import Callable, Mapping
from contextlib import ExitStack
from functools import partial
from pathlib import Path
from typing import Any

from tactile_push.bags import BagError, BagReader
from tactile_push.control import tick_of
from tactile_push.fingers import fingers_in
from tactile_push.interface import (
    ACTIVE_SENSING,
    CONTROLLER_STATE,
    OBJECT_POSE,
    SENSING_STATE,
    TOPICS,
    TRUE_STATE,
)
from tactile_push.paper import object_with
from tactile_push.parameters import ActiveSensingParameters
from tactile_push.parameters.active_sensing import make_sensing
from tactile_push.pipeline import by_name
from tactile_push.pipeline.stamps import epoch_of, seconds_since, stamp_of
from tactile_push.replay.messages import still_free
from tactile_push.replay.new_bag import new_bag
from tactile_push.replay.object_history import ObjectFigures, ObjectHistory
from tactile_push.replay.parameters import FingerParameters, ParameterFile, parameters_in

INPUTS = (CONTROLLER_STATE, TRUE_STATE)
MADE = (SENSING_STATE, OBJECT_POSE)


def estimate(
    bag: BagReader,
    *,
    config: Path | None = None,
    sensing: Mapping[str, Any] | None = None,
    out: str | os.PathLike[str] | None = None,
    progress: Callable[[int], None] = lambda count: None,
) -> list[ObjectFigures]:
    """Run active sensing over all recorded control periods, whatever was recorded of it.

    A bag with readings but without control periods is refused: nobody knows how the finger moved.

    Parameters
    ----------
    bag : BagReader
        The bag, with `push_controller/state` of at least one finger.
    sensing : mapping of str to object, optional
        Values of parameters of `active_sensing` to use instead of the recorded ones.
    config, out, progress : optional
        As for `tactile_push.replay.replay`; of the file only `active_sensing` counts.

    Returns
    -------
    list of ObjectFigures
        One for each finger.

    Raises
    ------
    BagError
        If there are no control periods or the bag cannot be read.
    ValueError, OSError
        As for `tactile_push.replay.replay`.
    """
    from tactile_push.pipeline import Sensing  # which loads the compiler

    nothing = (
        f'no control periods, expected a topic {CONTROLLER_STATE}: nobody knows how the finger '
        'moved'
    )
    found = fingers_in(bag, [CONTROLLER_STATE], {*INPUTS, *MADE}, nothing)
    recorded = parameters_in(bag)
    file = ParameterFile(config)
    file.check(found, [ACTIVE_SENSING])
    seconds = partial(seconds_since, epoch_of(bag.start_time // 10**9))
    steps: dict[str, Sensing] = {}
    histories: dict[str, ObjectHistory] = {}
    for namespace in found:
        wanted = {ACTIVE_SENSING: sensing or {}}
        parameters = FingerParameters.of(recorded, namespace, file, wanted)
        values = ActiveSensingParameters.of(parameters.sensing)
        steps[namespace] = Sensing(make_sensing(values), seconds)
        known = {*parameters.recorded[ACTIVE_SENSING], *parameters.wanted[ACTIVE_SENSING]}
        told = bool(known & {'vertices', 'disk_radius'})
        pushed = object_with(values.corners, values.disk_radius)
        finger = namespace.removeprefix('/')
        histories[namespace] = ObjectHistory(finger, bag.start_time, told, pushed)
    inputs = {f'{n}/{t}': (n, t) for n, topics in found.items() for t in INPUTS if t in topics}
    made = {f'{n}/{topic}': TOPICS[topic].type_name for n in found for topic in MADE}
    made = still_free(bag, made)
    with ExitStack() as stack:
        new = None if out is None else stack.enter_context(new_bag(out, bag, made))
        for count, message in enumerate(bag.messages(inputs if new is None else None)):
            if count % 1000 == 0:
                progress(count)
            if new is not None and message.topic not in made:
                new.copy(message)
            if message.topic not in inputs:
                continue
            namespace, topic = inputs[message.topic]
            decoded = bag.decode(message)
            values_by_name = by_name(decoded.name, decoded.position)
            if topic == TRUE_STATE:
                histories[namespace].truth(stamp_of(decoded), values_by_name)
                continue
            try:
                tick = tick_of(values_by_name)
            except ValueError as error:
                raise BagError(f'{bag.path}: {message.topic}: {error}') from None
            sensed = steps[namespace].tick(stamp_of(decoded), tick)
            desired = values_by_name.get('theta_desired', math.nan) - tick.trim
            histories[namespace].add(tick.state, desired, sensed)
            if new is not None:
                for topic, fields in sensed.outputs():
                    new.write(f'{namespace}/{topic}', fields, message.log_time)
    return [history.figures() for history in histories.values()]
