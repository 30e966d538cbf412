# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What is in a bag, and how well its fingers pushed."""

from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from tactile_push.bags import BagError, BagReader, Message
from tactile_push.bags.survey import FileInfo, TopicInfo, survey
from tactile_push.fingers import definition_trouble, is_own, left_alone
from tactile_push.interface import CONTROLLER_STATE, VERSION_NOTE, own_name
from tactile_push.parameters.recorded import recorded_parameters
from tactile_push.report.columns import TAKEN, Columns, positions
from tactile_push.report.merit import PushFigures, push_figures
from tactile_push.report.pushed import pushed_object


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
    namespaces = set()
    for name, topic in sorted(bag.topics.items()):
        trouble = definition_trouble(bag, name)
        if topic.decodes and trouble and not topic.trouble({}):  # which the survey says
            remarks.append(trouble)
        if own_name(name) == CONTROLLER_STATE and is_own(bag, name) and not trouble:
            namespaces.add(name.removesuffix(f'/{CONTROLLER_STATE}'))
    states = {f'{namespace}/{CONTROLLER_STATE}': Columns() for namespace in sorted(namespaces)}
    undecoded: Counter[str] = Counter()

    def hear(message: Message, stamp: int | None) -> None:
        if message.topic not in states or stamp is None:
            return
        try:
            state = bag.decode(message)
        except BagError:
            undecoded[message.topic] += 1
            return
        stamped = {'stamp': (stamp - bag.start_time) / 1e9}
        time = (message.log_time - bag.start_time) / 1e9
        states[message.topic].add(time, positions(state, TAKEN[CONTROLLER_STATE]) | stamped)

    found = survey(bag, progress, hear)
    pushes = {}
    for name, columns in states.items():
        namespace = name.removesuffix(f'/{CONTROLLER_STATE}')
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
