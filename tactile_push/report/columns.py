# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What a bag says, as columns of numbers."""

import math
from array import array
from collections import defaultdict
from collections.abc import Callable, Mapping, Set
from typing import Any

import numpy as np
import numpy.typing as npt

from tactile_push.bags import BagReader
from tactile_push.fingers import fingers_in, is_own
from tactile_push.interface import (
    CONTACT,
    CONTROLLER_STATE,
    DIAGNOSTICS,
    GEOMETRY_STATE,
    JOINT_STATE_TYPE,
    OBJECT_POSE,
    PLACE_STATE,
    SENSING_STATE,
    TACTILE,
    TOPICS,
    TRUE_POSE,
    TRUE_STATE,
)
from tactile_push.pipeline.named import by_name
from tactile_push.pipeline.orientation import yaw_of_quaternion
from tactile_push.report.episodes import Label
from tactile_push.report.labels import status_label

# The topics of a finger that a report shows.
SHOWN = (
    CONTROLLER_STATE,
    TRUE_STATE,
    GEOMETRY_STATE,
    SENSING_STATE,
    TRUE_POSE,
    TACTILE,
    CONTACT,
    OBJECT_POSE,
    PLACE_STATE,
)
# What is taken of their JointState messages: of those that are as fast as the sensor no more than
# is shown.
TAKEN: Mapping[str, Set[str]] = {
    topic: frozenset(TOPICS[topic].field_names)
    for topic in SHOWN
    if TOPICS[topic].type_name == JOINT_STATE_TYPE
} | {TACTILE: frozenset(), GEOMETRY_STATE: frozenset(['refusal'])}
PROGRESS_EVERY = 1000  # messages
FAR = 10.0  # between stamp and log time: a message takes less, so the stamp is of another clock [s]

Column = npt.NDArray[np.float64]
Table = dict[str, Column]
"""Columns by name; 'time' counts from the start of the bag [s] and does not decrease."""
Statuses = dict[str, list[tuple[float, Label | None]]]
"""When and what the diagnostics said, by name."""


def namespaces(bag: BagReader) -> list[str]:
    """Return the fingers' namespaces, '' or such as '/left', first the one with most topics."""
    nothing = f'nothing to report, expected messages on {", ".join(SHOWN)}'
    found = fingers_in(bag, SHOWN, {*SHOWN, DIAGNOSTICS}, nothing)
    return sorted(found, key=lambda name: (-len(found[name].intersection(SHOWN)), name))


def topics_of(bag: BagReader, namespace: str) -> dict[str, str]:
    """Return the topics of a finger that a report shows: full name to relative name."""
    wanted = {f'{namespace}/{own}': own for own in SHOWN} | {DIAGNOSTICS: DIAGNOSTICS}
    return {topic: own for topic, own in wanted.items() if is_own(bag, topic)}


def read_tables(
    bag: BagReader, topics: Mapping[str, str], progress: Callable[[int], None] = lambda count: None
) -> tuple[Mapping[str, Table], Statuses]:
    """Read topics, as `topics_of` returns them, into columns by relative name; and diagnostics."""
    columns: dict[str, Columns] = defaultdict(Columns)
    statuses: Statuses = defaultdict(list)
    for done, message in enumerate(bag.messages(topics), 1):
        own = topics[message.topic]
        content = bag.decode(message)
        time = time_of(content.header.stamp, message.log_time, bag.start_time)
        if own == DIAGNOSTICS:
            for status in content.status:
                statuses[status.name].append((time, status_label(status)))
        else:
            values = positions(content, TAKEN[own]) if own in TAKEN else pose(content)
            columns[own].add(time, values)
        if done % PROGRESS_EVERY == 0:
            progress(done)
    return {own: found.table() for own, found in columns.items()}, statuses


def time_of(stamp: Any, log_time: int, start: int) -> float:
    """Return the time of a message from the start of the bag [s]."""
    stamped = (stamp.sec * 1_000_000_000 + stamp.nanosec - start) * 1e-9
    logged = (log_time - start) * 1e-9
    return stamped if abs(stamped - logged) <= FAR else logged


def positions(content: Any, taken: Set[str]) -> dict[str, float]:
    """Return the positions of a JointState message by those names that are taken."""
    values = by_name(content.name, content.position)
    return {name: value for name, value in values.items() if name in taken}


def pose(content: Any) -> dict[str, float]:
    """Return x, y and yaw of a pose message, with or without a covariance."""
    place = getattr(content.pose, 'pose', content.pose)
    rotation = place.orientation
    yaw = yaw_of_quaternion(rotation.x, rotation.y, rotation.z, rotation.w)
    return {'x': place.position.x, 'y': place.position.y, 'yaw': yaw}


class Columns:
    """Values by name, eight bytes each: a bag may have very many."""

    def __init__(self) -> None:
        self._time = array('d')
        self._columns: dict[str, array[float]] = {}

    def add(self, time: float, values: Mapping[str, float]) -> None:
        """Take a row; it gets NaN where it lacks a name that others have."""
        for name in values.keys() - self._columns.keys():
            self._columns[name] = array('d', [math.nan]) * len(self._time)
        self._time.append(time)
        for name, column in self._columns.items():
            column.append(values.get(name, math.nan))

    def table(self) -> Table:
        """Return the columns in the order of time."""
        columns = {'time': self._time, **self._columns}
        order = np.argsort(np.array(self._time), kind='stable')
        return {name: np.array(column)[order] for name, column in columns.items()}
