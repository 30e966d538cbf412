# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What is in a bag, how well its fingers pushed, and what became of goals."""

from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from tactile_push.bags import BagError, BagReader, Message
from tactile_push.bags.survey import FileInfo, TopicInfo, survey
from tactile_push.fingers import definition_trouble, is_own, left_alone
from tactile_push.interface import (
    CONTROLLER_STATE,
    PLACE_STATE,
    TRUE_STATE,
    VERSION_NOTE,
    own_name,
)
from tactile_push.parameters.recorded import recorded_parameters
from tactile_push.report.columns import TAKEN, Columns, positions
from tactile_push.report.merit import PushFigures, push_figures
from tactile_push.report.placings import Placing, placings
from tactile_push.report.pushed import pushed_object

HEARD = (CONTROLLER_STATE, PLACE_STATE, TRUE_STATE)


@dataclass(frozen=True)
class BagInfo:
    """A bag and how well its fingers pushed."""

    path: Path
    files: list[FileInfo]
    start_time: int  # of the first message [ns]
    duration: float  # from the first to the last message [s]
    messages: int
    topics: list[TopicInfo]  # in the order of their names
    version: str | None  # of this package, if it recorded the bag
    parameters: dict[str, dict[str, Any]] | None  # of the nodes by name, if they were recorded
    pushes: dict[str, PushFigures]  # by the fingers' namespaces, '' or such as '/left'
    goals: dict[str, list[Placing]]  # to place objects at, by the fingers that had some
    remarks: list[str]  # what could not be used


def bag_info(
    bag: BagReader, band: float, progress: Callable[[int], None] = lambda count: None
) -> BagInfo:
    """Find out what is in a bag, reading it once.

    Theta counts as settled within `band` of its desired value [rad]. `progress` is told now and
    then how many messages have been read.
    """
    parameters, remarks = recorded_parameters(bag.notes)
    if foreign := left_alone(bag, {CONTROLLER_STATE}):
        remarks.append(foreign)
    topics = {}
    for name, topic in sorted(bag.topics.items()):
        trouble = definition_trouble(bag, name)
        if topic.decodes and trouble and not topic.trouble({}):  # which the survey says
            remarks.append(trouble)
        if own_name(name) in HEARD and is_own(bag, name) and not trouble:
            topics[name] = Columns()
    for name in [name for name in topics if own_name(name) == TRUE_STATE]:
        if f'{name.removesuffix(TRUE_STATE)}{PLACE_STATE}' not in topics:  # it judges goals alone
            del topics[name]
    undecoded: Counter[str] = Counter()

    def hear(message: Message, stamp: int | None) -> None:
        if message.topic not in topics or stamp is None:
            return
        try:
            state = bag.decode(message)
        except BagError:
            undecoded[message.topic] += 1
            return
        stamped = {'stamp': (stamp - bag.start_time) / 1e9}
        time = (message.log_time - bag.start_time) / 1e9
        taken = TAKEN[own_name(message.topic) or '']
        topics[message.topic].add(time, positions(state, taken) | stamped)

    found = survey(bag, progress, hear)
    pushes, goals = {}, {}
    for name in sorted(topics, key=_namespace):
        own, namespace, columns = own_name(name), _namespace(name), topics[name]
        if own == PLACE_STATE:
            truth = topics.get(f'{namespace}/{TRUE_STATE}', Columns()).table()
            goals[namespace] = placings(columns.table(), truth)
        if own == CONTROLLER_STATE:
            pushed = pushed_object(parameters or {}, namespace)
            pushes[namespace] = push_figures(
                *(columns.table(), band, pushed.l, pushed.object, pushed.lever)
            )
            if pushed.remark:
                remarks.append(pushed.remark)
    return BagInfo(
        path=bag.path,
        files=found.files,
        start_time=bag.start_time,
        duration=(bag.end_time - bag.start_time) / 1e9,
        messages=found.messages,
        topics=found.topics,
        version=bag.notes.get(VERSION_NOTE),
        parameters=parameters,
        pushes=pushes,
        goals={namespace: some for namespace, some in goals.items() if some},
        remarks=list(
            dict.fromkeys(
                [
                    *remarks,
                    *found.remarks,
                    *(f'{n} messages of {name} do not decode' for name, n in undecoded.items()),
                ]
            )
        ),
    )


def _namespace(topic: str) -> str:
    """Return the namespace of the finger that one of the package's topics is of."""
    return topic.removesuffix(f'/{own_name(topic)}')
