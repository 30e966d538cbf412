# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The topics of a bag that a report needs, as columns."""

import math
from array import array
from collections import Counter, defaultdict
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from tactile_push.bags import BagError, BagReader
from tactile_push.pipeline.orientation import yaw_of_quaternion
from tactile_push.report.data import ERROR, WARNING
from tactile_push.report.episodes import Label
from tactile_push.report.merit import FIELDS

JOINTS, POSE = 'sensor_msgs/msg/JointState', 'geometry_msgs/msg/PoseStamped'
UNSURE_POSE = 'geometry_msgs/msg/PoseWithCovarianceStamped'
STATE, TRUTH, TRUE_POSE = 'push_controller/state', 'ground_truth/state', 'ground_truth/object_pose'
READINGS, SENSING, ESTIMATE = 'contact_geometry/state', 'active_sensing/state', 'object_pose'
TACTILE, CONTACT = 'tactile', 'contact'
TYPES = {
    STATE: JOINTS,
    TRUTH: JOINTS,
    READINGS: JOINTS,
    SENSING: JOINTS,
    TRUE_POSE: POSE,
    TACTILE: JOINTS,
    CONTACT: POSE,
    ESTIMATE: UNSURE_POSE,
}
# What is taken of a joint state; all of a pose.
NAMES = {
    STATE: {*FIELDS, 'finger_x'},
    TRUTH: {'theta', 'phi', 'd', 'v_x', 'finger_x', 'belt_travel'},
    READINGS: {'refusal'},
    SENSING: {'d', 'd_lower', 'd_upper', 'd_least', 'd_most', 'contradiction'},
    TACTILE: set(),
}
DIAGNOSTICS, DIAGNOSTICS_TYPE = '/diagnostics', 'diagnostic_msgs/msg/DiagnosticArray'
LEVELS = (None, WARNING, ERROR, ERROR)  # of diagnostics: ok, warn, error, stale
PROGRESS_EVERY = 1000  # messages
FAR = 10.0  # between stamp and log time: the stamp is of another clock [s]

Table = dict[str, npt.NDArray[np.float64]]
"""Columns by name; 'time' counts from the start of the bag [s] and does not decrease."""
Statuses = dict[str, list[tuple[float, Label | None]]]
"""When and what the diagnostics said, by name."""


def namespaces(bag: BagReader) -> list[str]:
    """Find the namespaces of the package's topics in a bag.

    Parameters
    ----------
    bag : BagReader
        The bag.

    Returns
    -------
    list of str
        Such as '' or '/left'; first the one of which the bag has most topics.

    Raises
    ------
    BagError
        If there is none.
    """
    found: Counter[str] = Counter()
    for topic, count in bag.counts.items():
        own = next((own for own in TYPES if count and topic.endswith(f'/{own}')), None)
        if own is not None:
            found[topic.removesuffix(f'/{own}')] += 1
    if not found:
        raise BagError(f'{bag.path}: nothing to report, expected messages on {", ".join(TYPES)}')
    return sorted(found, key=lambda name: (-found[name], name))


def topics_of(bag: BagReader, namespace: str) -> dict[str, str]:
    """Find the topics that a report needs.

    Parameters
    ----------
    bag : BagReader
        The bag.
    namespace : str
        Of the topics.

    Returns
    -------
    dict of str to str
        Their names within the namespace, by full name; those that the bag has.

    Raises
    ------
    BagError
        If one has another type than expected.
    """
    wanted = {f'{namespace}/{own}': own for own in TYPES} | {DIAGNOSTICS: DIAGNOSTICS}
    there = {topic: own for topic, own in wanted.items() if topic in bag.topics}
    for topic, own in there.items():
        expected, found = TYPES.get(own, DIAGNOSTICS_TYPE), bag.topics[topic].type_name
        if found != expected:
            raise BagError(f'{bag.path}: {topic}: expected {expected}, got {found}')
    return there


def read_tables(
    bag: BagReader, topics: Mapping[str, str], progress: Callable[[int], None]
) -> tuple[Mapping[str, Table], Statuses]:
    """Read the topics.

    Parameters
    ----------
    bag : BagReader
        The bag.
    topics : mapping of str to str
        The topics, as `topics_of` gives them.
    progress : callable
        Told now and then how many messages are read.

    Returns
    -------
    tables : mapping of str to dict
        The columns by the topic's name within the namespace, of those that have messages.
    statuses : dict
        The diagnostics.

    Raises
    ------
    BagError
        If a message does not decode.
    """
    columns: dict[str, _Columns] = defaultdict(_Columns)
    statuses: Statuses = defaultdict(list)
    for done, message in enumerate(bag.messages(topics), 1):
        own = topics[message.topic]
        content = bag.decode(message)
        time = _time(content.header.stamp, message.log_time, bag.start_time)
        if own == DIAGNOSTICS:
            for status in content.status:
                statuses[status.name].append((time, _status_label(status)))
        else:
            values = _positions(content, NAMES[own]) if own in NAMES else _pose(content)
            columns[own].add(time, values)
        if done % PROGRESS_EVERY == 0:
            progress(done)
    return {own: found.table() for own, found in columns.items()}, statuses


def _time(stamp: Any, log_time: int, start: int) -> float:
    """Give the time of a message from the start of the bag [s]."""
    stamped = (stamp.sec * 1_000_000_000 + stamp.nanosec - start) * 1e-9
    logged = (log_time - start) * 1e-9
    return stamped if abs(stamped - logged) <= FAR else logged


def _status_label(status: Any) -> Label | None:
    level = LEVELS[min(ord(status.level) if isinstance(status.level, bytes) else status.level, 3)]
    return None if level is None else (level, status.message)


def _positions(content: Any, names: set[str]) -> dict[str, float]:
    pairs = zip(content.name, content.position, strict=False)
    return {name: value for name, value in pairs if name in names}


def _pose(content: Any) -> dict[str, float]:
    pose = getattr(content.pose, 'pose', content.pose)
    rotation = pose.orientation
    yaw = yaw_of_quaternion(rotation.x, rotation.y, rotation.z, rotation.w)
    return {'x': pose.position.x, 'y': pose.position.y, 'yaw': yaw}


class _Columns:
    """Values by name as they come: eight bytes each, for a bag may have very many."""

    def __init__(self) -> None:
        self._time = array('d')
        self._columns: dict[str, array[float]] = {}

    def add(self, time: float, values: Mapping[str, float]) -> None:
        """Take a row; one that lacks a name that others have gets NaN there."""
        for name in values.keys() - self._columns.keys():
            self._columns[name] = array('d', [math.nan]) * len(self._time)
        self._time.append(time)
        for name, column in self._columns.items():
            column.append(values.get(name, math.nan))

    def table(self) -> Table:
        """Give the columns in the order of time."""
        columns = {'time': self._time, **self._columns}
        order = np.argsort(np.array(self._time), kind='stable')
        return {name: np.array(column)[order] for name, column in columns.items()}
