# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Read a run from its bag."""

from collections.abc import Callable, Mapping
from datetime import datetime, timezone

import numpy as np

from tactile_push.bags import BagReader
from tactile_push.interface import (
    CONTROLLER_STATE,
    GEOMETRY_STATE,
    PLACE_STATE,
    SENSING_STATE,
    TACTILE,
    TRUE_STATE,
    VERSION_NOTE,
)
from tactile_push.parameters.recorded import recorded_parameters
from tactile_push.report.columns import (
    Statuses,
    Table,
    namespaces,
    read_tables,
    topics_of,
)
from tactile_push.report.data import Episode, Run, Series
from tactile_push.report.episodes import episodes, joined
from tactile_push.report.labels import (
    BOUNDS,
    DOING,
    STATUS_LASTS,
    TICK_LASTS,
    bound_label,
    contradiction_label,
    doing,
    refusal_label,
    stage_label,
    stop_label,
)
from tactile_push.report.outcome import outcome_of
from tactile_push.report.placed_view import drawings
from tactile_push.report.placings import goal_cells, placings
from tactile_push.report.pushed import plant_in, pushed_object
from tactile_push.report.scene import scene_of
from tactile_push.report.shown import SOURCES


def messages_shown(bag: BagReader) -> int:
    """Count the messages that `read_run` will read.

    Parameters
    ----------
    bag : BagReader
        The bag.

    Returns
    -------
    int
        How many there are.

    Raises
    ------
    BagError
        If the bag has nothing to show.
    """
    return sum(bag.counts[topic] for topic in topics_of(bag, namespaces(bag)[0]))


def read_run(bag: BagReader, progress: Callable[[int], None] = lambda done: None) -> Run:
    """Read what a report shows.

    Parameters
    ----------
    bag : BagReader
        The bag.
    progress : callable, optional
        Told now and then how many messages are read.

    Returns
    -------
    Run
        The run.

    Raises
    ------
    BagError
        If the bag cannot be read or has nothing to show.
    """
    namespace, *others = namespaces(bag)
    tables, statuses = read_tables(bag, topics_of(bag, namespace), progress)
    recorded, warnings = recorded_parameters(bag.notes)
    parameters = recorded or {}
    plant = parameters.get(plant_in(namespace, parameters))
    scene = scene_of(plant, tables)
    placed = placings(tables.get(PLACE_STATE, {}), tables.get(TRUE_STATE, {}))
    duration = (bag.end_time - bag.start_time) * 1e-9
    series = _series(tables)
    ticks = tables.get(CONTROLLER_STATE, {})
    pushed = pushed_object(parameters, namespace)
    if ticks and pushed.remark:
        warnings.append(pushed.remark)
    if others:
        warnings.append(f'not shown: the topics in {", ".join(name or "/" for name in others)}')
    return Run(
        name=bag.path.resolve().name,
        duration=duration,
        series=series,
        states=DOING if 'state' in series else (),
        episodes=joined(_episodes(tables, statuses), 0.0, duration),
        scene=scene,
        facts=_facts(bag, duration),
        outcome=outcome_of(ticks, tables.get(SENSING_STATE, {}), pushed),
        goals=goal_cells(placed),
        drawings=drawings(placed, tables, scene),
        tables=_details(bag, parameters),
        warnings=warnings,
    )


def _series(tables: Mapping[str, Table]) -> dict[str, Series]:
    series = {}
    for name, sources in SOURCES.items():
        for topic, column in sources:
            table = tables.get(topic, {})
            if column in table:
                series[name] = Series(table['time'], table[column])
                break
    if TACTILE in tables:
        time = tables[TACTILE]['time']
        series['interval'] = Series(time[1:], np.diff(time))
    if {'state', 'stop_reason'} <= tables.get(CONTROLLER_STATE, {}).keys():
        ticks = tables[CONTROLLER_STATE]
        series['state'] = Series(ticks['time'], doing(ticks['state'], ticks['stop_reason']))
    return series


def _episodes(tables: Mapping[str, Table], statuses: Statuses) -> list[Episode]:
    ticks, readings, sensing, placing = (
        tables.get(topic, {})
        for topic in (CONTROLLER_STATE, GEOMETRY_STATE, SENSING_STATE, PLACE_STATE)
    )
    found = []
    if {'state', 'stop_reason'} <= ticks.keys():
        labels = [
            stop_label(state, reason)
            for state, reason in zip(ticks['state'], ticks['stop_reason'], strict=True)
        ]
        found += episodes('controller', ticks['time'], labels, TICK_LASTS)
    for name in BOUNDS:
        if name in ticks:
            flags = [bound_label(name, flag) for flag in ticks[name]]
            found += episodes('bounds', ticks['time'], flags, TICK_LASTS)
    if 'refusal' in readings:
        refusals = [refusal_label(number) for number in readings['refusal']]
        found += episodes('readings', readings['time'], refusals, 0.0)
    if 'contradiction' in sensing:
        contradictions = [contradiction_label(number) for number in sensing['contradiction']]
        found += episodes('object', sensing['time'], contradictions, TICK_LASTS)
    if 'stage' in placing:
        stages = [stage_label(number) for number in placing['stage']]
        found += episodes('goal', placing['time'], stages, TICK_LASTS)
    for name, said in statuses.items():
        said.sort(key=lambda status: status[0])
        times, levels = [time for time, _ in said], [label for _, label in said]
        found += episodes(name, times, levels, STATUS_LASTS)
    return found


def _facts(bag: BagReader, duration: float) -> list[str]:
    facts = [f'{duration:.1f} s', f'{sum(bag.counts.values()):,} messages']
    start = datetime.fromtimestamp(bag.start_time * 1e-9, timezone.utc)
    if start.year > 1970:  # of no simulated clock
        facts.insert(0, f'{start:%Y-%m-%d %H:%M:%S} UTC')
    if VERSION_NOTE in bag.notes:
        facts.append(f'tactile_push {bag.notes[VERSION_NOTE]}')
    return facts


def _details(
    bag: BagReader, parameters: Mapping[str, Mapping[str, object]]
) -> dict[str, list[tuple[str, ...]]]:
    details: dict[str, list[tuple[str, ...]]] = {
        'Topics': [
            (name, topic.type_name, f'{bag.counts.get(name, 0):,}')
            for name, topic in sorted(bag.topics.items())
        ]
    }
    for node, values in sorted(parameters.items()):
        details[f'Parameters of {node}'] = [
            (name, str(value)) for name, value in sorted(values.items())
        ]
    return details
