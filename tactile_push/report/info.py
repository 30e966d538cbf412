# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What is in a bag: its topics and their rates, and how well its fingers pushed."""

import json
import math
from array import array
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from mcap.exceptions import McapError
from mcap.records import Chunk
from mcap.records import Message as MessageRecord
from mcap.stream_reader import StreamReader

from tactile_push.bags.headers import HeaderStamps
from tactile_push.bags.reader import BagError, BagReader
from tactile_push.report.merit import PushFigures, PushHistory

STATE_TOPIC = '/push_controller/state'
_JOINT_STATE = 'sensor_msgs/msg/JointState'
# The parameter of `sim_plant` that is l, by what is pushed.
_DISTANCES = {'block': 'edge_to_cm', 'disk': 'disk_radius'}
_PROGRESS_EVERY = 1000  # messages
_SAMPLE = 16384  # intervals of a topic that are kept to find their median


@dataclass(frozen=True)
class FileInfo:
    """A file of a bag.

    Parameters
    ----------
    path : Path
        Where it is.
    size : int
        Its size [bytes].
    compression : str
        How its chunks are compressed, ``'none'`` if they are not; ``''`` if it has none.
    """

    path: Path
    size: int
    compression: str


@dataclass(frozen=True)
class TopicInfo:
    """A topic of a bag.

    Parameters
    ----------
    name, type_name : str
        Full name and message type.
    messages : int
        How many it has.
    rate : float or None
        Messages a second, by the median time between two of them [Hz].
    largest_gap : float or None
        Longest time between two messages [s].
    gap_at : float or None
        When that began [s], from the start of the bag.
    out_of_order : int or None
        Messages with a stamp before that of the message before; None if they have no header.
    """

    name: str
    type_name: str
    messages: int
    rate: float | None
    largest_gap: float | None
    gap_at: float | None
    out_of_order: int | None


@dataclass(frozen=True)
class BagInfo:
    """A bag.

    Parameters
    ----------
    path : Path
        Where it is.
    files : list of FileInfo
        Its files.
    start_time : int
        Time of the first message [ns].
    duration : float
        From the first to the last message [s].
    messages : int
        How many it has.
    topics : list of TopicInfo
        Its topics, in the order of their names.
    version : str or None
        Version of this package that recorded it, if one did.
    parameters : dict or None
        Parameters of the nodes by name, if they were recorded.
    pushes : dict of str to PushFigures
        How well each finger pushed, by its namespace (``''`` or such as ``'/left'``).
    remarks : list of str
        What could not be made use of.
    """

    path: Path
    files: list[FileInfo]
    start_time: int
    duration: float
    messages: int
    topics: list[TopicInfo]
    version: str | None
    parameters: dict[str, dict[str, Any]] | None
    pushes: dict[str, PushFigures]
    remarks: list[str]


def bag_info(bag: BagReader, band: float, progress: Callable[[int], None] | None = None) -> BagInfo:
    """Find out what is in a bag, reading it once.

    Parameters
    ----------
    bag : BagReader
        The bag.
    band : float
        How near to its desired value theta counts as settled [rad].
    progress : callable, optional
        Told now and then how many messages have been read.

    Returns
    -------
    BagInfo
        What is in it.

    Raises
    ------
    BagError
        If it cannot be read.
    """
    remarks: list[str] = []
    parameters = _parameters(bag, remarks)
    stamps = HeaderStamps(bag)
    surveys = {name: _Survey() for name in bag.topics}
    histories = _histories(bag, band, parameters or {}, remarks)
    encoded = Counter(topic.in_words for topic in bag.topics.values() if not topic.decodes)
    for words, count in encoded.items():
        remarks.append(f'{count} of {len(bag.topics)} topics cannot be decoded: {words}')
    broken: Counter[str] = Counter()
    odd: Counter[str] = Counter()
    messages = 0
    for messages, message in enumerate(bag.messages(), 1):
        topic = message.topic
        stamp = None
        if topic in stamps:
            try:
                stamp = stamps.of(message)
            except BagError:
                broken[topic] += 1
        surveys[topic].add(message.log_time, stamp)
        if topic in histories and stamp is not None:
            try:
                state = bag.decode(message)
            except BagError:
                odd[topic] += 1
            else:
                histories[topic].add(
                    (message.log_time - bag.start_time) / 1e9,
                    (stamp - bag.start_time) / 1e9,
                    dict(zip(state.name, state.position, strict=False)),
                )
        if progress is not None and messages % _PROGRESS_EVERY == 0:
            progress(messages)
    for name, count in broken.items():
        remarks.append(f'{count} messages of {name} end before their stamp')
    for name, count in odd.items():
        remarks.append(f'{count} messages of {name} do not decode')
    return BagInfo(
        path=bag.path,
        files=[FileInfo(file, file.stat().st_size, _compression(file)) for file in bag.files],
        start_time=bag.start_time,
        duration=(bag.end_time - bag.start_time) / 1e9,
        messages=messages,
        topics=[
            surveys[name].topic_info(name, bag.topics[name].type_name, bag.start_time)
            for name in sorted(bag.topics)
        ],
        version=bag.notes.get('tactile_push.version'),
        parameters=parameters,
        pushes={
            namespace: histories[namespace + STATE_TOPIC].figures()
            for namespace in sorted(topic.removesuffix(STATE_TOPIC) for topic in histories)
        },
        remarks=remarks,
    )


class _Survey:
    """Follows the messages of a topic."""

    def __init__(self) -> None:
        self._messages = 0
        self._last: int | None = None
        self._last_stamp: int | None = None
        self._gap, self._gap_at = -1, 0
        self._out_of_order = 0
        # Evenly spaced among all intervals, thinned out whenever there are too many.
        self._intervals = array('q')
        self._stride = 1

    def add(self, time: int, stamp: int | None) -> None:
        """Take a message."""
        if self._last is not None:
            interval = time - self._last
            if interval > self._gap:
                self._gap, self._gap_at = interval, self._last
            if (self._messages - 1) % self._stride == 0:
                self._intervals.append(interval)
                if len(self._intervals) == _SAMPLE:
                    self._intervals = self._intervals[::2]
                    self._stride *= 2
        if stamp is not None:
            if self._last_stamp is not None and stamp < self._last_stamp:
                self._out_of_order += 1
            self._last_stamp = stamp
        self._last = time
        self._messages += 1

    def topic_info(self, name: str, type_name: str, start: int) -> TopicInfo:
        """Return what is known now."""
        apart = float(np.median(self._intervals)) if self._intervals else 0.0
        several = self._messages > 1
        return TopicInfo(
            name,
            type_name,
            self._messages,
            rate=1e9 / apart if apart > 0.0 else None,
            largest_gap=self._gap / 1e9 if several else None,
            gap_at=(self._gap_at - start) / 1e9 if several else None,
            out_of_order=None if self._last_stamp is None else self._out_of_order,
        )


def _parameters(bag: BagReader, remarks: list[str]) -> dict[str, dict[str, Any]] | None:
    text = bag.notes.get('tactile_push.parameters')
    if text is None:
        return None
    try:
        parameters = json.loads(text)
    except ValueError:
        parameters = None
    if not isinstance(parameters, dict) or not all(
        isinstance(values, dict) for values in parameters.values()
    ):
        remarks.append('the recorded parameters cannot be read: expected JSON, node to values')
        return None
    return parameters


def _histories(
    bag: BagReader, band: float, parameters: dict[str, dict[str, Any]], remarks: list[str]
) -> dict[str, PushHistory]:
    """Return a history for each finger, by the topic of its states."""
    histories = {}
    for name, topic in bag.topics.items():
        if not name.endswith(STATE_TOPIC):
            continue
        if topic.type_name != _JOINT_STATE:
            remarks.append(f'{name} has type {topic.type_name}, expected {_JOINT_STATE}')
            continue
        if not topic.decodes:
            continue
        namespace = name.removesuffix(STATE_TOPIC)
        plant = parameters.get(f'{namespace}/sim_plant'.removeprefix('/'), {})
        pushed = str(plant['object']) if 'object' in plant else None
        l = plant.get(_DISTANCES.get(pushed or '', ''))
        known = isinstance(l, float) and math.isfinite(l) and l > 0.0
        histories[name] = PushHistory(band, l if known else None, pushed)
    return histories


def _compression(file: Path) -> str:
    """Return how the first chunk of a file is compressed."""
    if file.suffix == '.zstd':
        return 'zstd, the whole file'
    with file.open('rb') as stream:
        try:
            for record in StreamReader(stream, emit_chunks=True).records:
                if isinstance(record, Chunk):
                    return record.compression or 'none'
                if isinstance(record, MessageRecord):
                    return 'none'
        except McapError:
            pass  # cut off before the end of its first chunk
    return ''
