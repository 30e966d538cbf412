# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""`tactile_push diff`: what is different between two bags."""

import argparse
import json
import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from tactile_push.cli.arguments import BAG, Commands, tolerance, topic

if TYPE_CHECKING:
    from rich.table import Table

    from tactile_push.comparing.differences import Difference, TopicDiff


def add(commands: Commands) -> None:
    """Add the command."""
    diff = commands.add_parser(
        'diff',
        help='compare two bags, message by message',
        description='Compares two bags topic by topic. It pairs messages by the stamp in their '
        'header, or by their order if they have none, and compares them field by field. Exit '
        'status: 0 same, 1 different, 2 bad input.',
    )
    option = diff.add_argument
    option('a', **BAG | {'metavar': 'BAG_A'})
    option('b', **BAG | {'metavar': 'BAG_B', 'help': 'the bag to compare with it'})
    option(
        '--tolerance',
        type=tolerance,
        action='append',
        default=[],
        metavar='X|TOPIC:FIELD=X',
        help='how far apart numbers may be, in their SI units, everywhere or in one field, such '
        'as /push_controller/state:theta=1e-9; inf leaves a field out; may be repeated '
        '(default: 0, exactly equal)',
    )
    topics: dict[str, Any] = {'type': topic, 'nargs': '+', 'action': 'extend', 'metavar': 'TOPIC'}
    option('--topics', **topics, help='topics to compare (default: all)')
    option('--ignore', **topics, default=[], help='topics not to compare')
    option('--times', action='store_true', help='compare log and publish times, too')
    option('--json', action='store_true', help='print one JSON object, SI units')
    diff.set_defaults(run=_diff)


def _diff(options: argparse.Namespace) -> int:
    from tactile_push.cli.output import opened, reading, warner
    from tactile_push.comparing.diff import diff
    from tactile_push.comparing.differences import Tolerances

    warn = warner('diff')
    general = [value for place, value in options.tolerance if place is None]
    special = {place: value for place, value in options.tolerance if place is not None}
    with opened(options.a, warn) as a, opened(options.b, warn) as b:
        messages = sum(
            count
            for bag in (a, b)
            for topic, count in bag.counts.items()
            if topic in (options.topics or bag.counts) and topic not in options.ignore
        )
        tolerances = Tolerances(general[-1] if general else 0.0, special)
        chosen = {name: getattr(options, name) for name in ('topics', 'ignore', 'times')}
        with reading(messages) as progress:
            results = diff(a, b, tolerances=tolerances, **chosen, progress=progress)
    if options.json:
        print(json.dumps(_as_json(options, results), indent=2))
    else:
        _print(options, results)
    return 0 if all(result.same for result in results) else 1


def _as_json(options: argparse.Namespace, results: 'Sequence[TopicDiff]') -> dict[str, Any]:
    from tactile_push.cli.output import plain

    return {
        'a': str(options.a),
        'b': str(options.b),
        'same': all(result.same for result in results),
        'topics': {result.name: plain(_topic_as_json(result)) for result in results},
    }


def _topic_as_json(result: 'TopicDiff') -> dict[str, Any]:
    def at(key: int | None) -> dict[str, int] | None:
        return None if key is None else {'stamp_ns' if result.by_stamp else 'place': key}

    def entry(found: 'Difference') -> dict[str, Any]:
        return {
            'at': at(found.key),
            'field': found.where,
            'a': found.a,
            'b': found.b,
            # Texts and the like are different, but not by so much.
            'difference': found.distance if math.isfinite(found.distance) else None,
        }

    return {
        'same': result.same,
        'types': result.types,
        'messages': result.counts,
        'paired_by': 'stamp' if result.by_stamp else 'order',
        'compared': result.compared,
        'different': result.different,
        'only_in_a': {'messages': result.only_a, 'first': at(result.first_only_a)},
        'only_in_b': {'messages': result.only_b, 'first': at(result.first_only_b)},
        'fields_only_in_a': result.fields_only_a,
        'fields_only_in_b': result.fields_only_b,
        'remarks': result.remarks,
        'notes': result.notes,
        'first': None if result.first is None else entry(result.first),
        'fields': {
            name: {
                'messages': found.messages,
                'first': entry(found.first),
                'largest': entry(found.largest),
            }
            for name, found in result.fields.items()
        },
    }


def _print(options: argparse.Namespace, results: 'Sequence[TopicDiff]') -> None:
    from rich.table import Table

    from tactile_push.cli.output import shown, wide_console

    console = wide_console()
    console.print(
        f'A: {shown(str(options.a))}\nB: {shown(str(options.b))}', highlight=False, soft_wrap=True
    )
    overview = Table()
    for heading in ('topic', 'messages in A', 'in B', 'compared', 'only in A', 'only in B'):
        overview.add_column(heading, justify='left' if heading == 'topic' else 'right')
    overview.add_column('different', justify='right')
    overview.add_column('')
    remarks = []
    for result in results:
        numbers = (*result.counts, result.compared, result.only_a, result.only_b)
        verdict = '[green]same' if result.same else '[red]different'
        cells = [str(number) for number in (*numbers, result.different)]
        overview.add_row(shown(result.name), *cells, verdict)

        for bag, key in (('A', result.first_only_a), ('B', result.first_only_b)):
            if key is not None:
                remarks.append(f'{result.name}: first message only in {bag}: {_at(result, key)}')
        for bag, fields in (('A', result.fields_only_a), ('B', result.fields_only_b)):
            if fields:
                remarks.append(f'{result.name}: fields only in {bag}: {", ".join(fields)}')
        remarks += [f'{result.name}: {remark}' for remark in result.remarks + result.notes]
    console.print(overview)
    details = _details(results)
    if details.row_count:
        console.print(details)
    for remark in remarks:
        console.print(shown(remark), highlight=False, soft_wrap=True)
    different = sum(not result.same for result in results)
    console.print(f'{different} of {len(results)} topics are different', highlight=False)


def _details(results: 'Sequence[TopicDiff]') -> 'Table':
    from rich.table import Table

    from tactile_push.cli.output import shown

    table = Table()
    for heading in ('field', 'messages', 'first at', 'A', 'B', 'largest', 'at'):
        left = heading == 'field'
        table.add_column(heading, justify='left' if left else 'right', overflow='fold')
    for result in results:
        if result.fields:
            table.add_section()
            table.add_row(f'[bold]{shown(result.name)}')
        for name, found in result.fields.items():
            sized = math.isfinite(found.largest.distance)
            table.add_row(
                shown(name),
                str(found.messages),
                _at(result, found.first.key),
                shown(_short(found.first.a)),
                shown(_short(found.first.b)),
                f'{found.largest.distance:.6g}' if sized else '',
                _at(result, found.largest.key),
            )
    return table


def _at(result: 'TopicDiff', key: int) -> str:
    """Return which message it is: that of a stamp, or of a place."""
    from tactile_push.comparing.fields import seconds

    return f'{seconds(key)} s' if result.by_stamp else f'message {key}'


def _short(value: object) -> str:
    text = str(value)
    return text if len(text) <= 40 else f'{text[:39]}…'
