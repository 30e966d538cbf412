# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""`tactile_push info`: what is in a bag, how well the finger pushed, and what became of goals."""

import argparse
import json
import math
from dataclasses import asdict
from datetime import datetime, timezone
from typing import TYPE_CHECKING

from tactile_push.cli.arguments import BAG, Commands, number
from tactile_push.interface import CLOCK, PLACE_GOAL, PUSH_CONTROLLER
from tactile_push.paper import TOLERANCE

if TYPE_CHECKING:
    from rich.console import Console

    from tactile_push.report.info import BagInfo
    from tactile_push.report.merit import PushFigures

# A clock that was set is later than this [ns]: 2001. Simulated time is earlier, and so is a clock
# that nobody has set since the machine began, as of a robot without a battery for its clock.
_EPOCH_CLOCK = 10**18


def add(commands: Commands) -> None:
    """Add the command."""
    info = commands.add_parser(
        'info',
        help='say what is in a bag, and how well the finger pushed',
        description='Says what is in a bag: files, topics, rates, gaps, the parameters of the '
        "experiment, the paper's figures of merit if the controller's states are there, and what "
        'became of goals to place objects at.',
    )
    option = info.add_argument
    option('bag', **BAG)
    option(
        '--band-deg',
        type=number('degrees between 0 and 180', 0.0, 180.0, closed=False),
        default=round(math.degrees(TOLERANCE), 9),
        metavar='DEG',
        help='theta counts as settled this near to its desired value (default: 3)',
    )
    option('--json', action='store_true', help='print one JSON object, SI units')
    info.set_defaults(run=_info)


def _info(options: argparse.Namespace) -> int:
    from tactile_push.cli.output import opened, plain, reading, warner
    from tactile_push.report.info import bag_info

    with opened(options.bag, warner('info')) as bag, reading(sum(bag.counts.values())) as progress:
        info = bag_info(bag, math.radians(options.band_deg), progress)
    if options.json:
        values = asdict(info)
        values['start_time_ns'] = values.pop('start_time')
        print(json.dumps(plain(values), indent=2))
    else:
        _print(info)
    return 0


def _print(info: 'BagInfo') -> None:
    from rich.filesize import decimal
    from rich.table import Table

    from tactile_push.cli.output import shown, wide_console
    from tactile_push.report.outcome import fixed, goal_table

    console = wide_console()
    head = Table.grid(padding=(0, 2))
    head.add_row('bag', shown(str(info.path)))
    for file in info.files:
        compression = f', compression: {file.compression}' if file.compression else ''
        head.add_row('file', shown(f'{file.path.name}, {decimal(file.size)}{compression}'))
    head.add_row('start', _start(info))
    head.add_row('duration', f'{info.duration:.3f} s')
    head.add_row('messages', str(info.messages))
    head.add_row('tactile_push', shown(info.version or 'version not recorded'))
    console.print(head, highlight=False)

    topics = Table()
    for heading in ('topic', 'type'):
        topics.add_column(heading, no_wrap=True)
    for heading in ('messages', 'rate [Hz]', 'largest gap [s]', 'at [s]', 'out of order'):
        topics.add_column(shown(heading), justify='right')
    for topic in info.topics:
        topics.add_row(
            shown(topic.name),
            shown(topic.type_name),
            str(topic.messages),
            *(
                '' if value is None else fixed(value, digits)
                for value, digits in ((topic.rate, 2), (topic.largest_gap, 3), (topic.gap_at, 3))
            ),
            '' if topic.out_of_order is None else str(topic.out_of_order),
        )
    console.print(topics)
    for namespace, figures in info.pushes.items():
        _print_push(console, namespace, figures)
    for namespace, goals in info.goals.items():
        console.print(goal_table(goals, f'{shown(namespace)}/{PLACE_GOAL}'))
    _print_parameters(console, info)
    for remark in info.remarks:
        console.print(shown(remark), highlight=False)


def _print_push(console: 'Console', namespace: str, push: 'PushFigures') -> None:
    from tactile_push.cli.output import shown
    from tactile_push.report.outcome import outcome_table, push_rows

    runs = {'this bag': (push_rows(push), push.paper)}
    console.print(outcome_table(runs, title=f'{shown(namespace)}/{PUSH_CONTROLLER}'))
    for stop in push.stops:
        end = '' if stop.ended else ', to the end of the bag'
        console.print(
            f'stopped at {stop.at:.3f} s for {stop.duration:.3f} s{end}: {shown(stop.reason)}',
            highlight=False,
        )
    if push.missing:
        console.print(f'not in this bag: {", ".join(push.missing)}', highlight=False)


def _print_parameters(console: 'Console', info: 'BagInfo') -> None:
    from rich.table import Table

    from tactile_push.cli.output import shown

    if not info.parameters:
        console.print('parameters: not recorded')
        return
    for node, parameters in sorted(info.parameters.items()):
        table = Table.grid(padding=(0, 2))
        for name, value in sorted(parameters.items()):
            table.add_row('', shown(name), shown(str(value)))
        console.print(f'parameters of /{shown(node)}', highlight=False)
        console.print(table, highlight=False)


def _start(info: 'BagInfo') -> str:
    from tactile_push.comparing.fields import seconds

    time = info.start_time
    if time < _EPOCH_CLOCK:
        simulated = any(topic.name == CLOCK and topic.messages for topic in info.topics)
        why = 'simulated time' if simulated else 'simulated time, or a clock that was not set'
        return f'{seconds(time)} s ({why})'
    return datetime.fromtimestamp(time / 1e9, tz=timezone.utc).isoformat(' ', 'milliseconds')
