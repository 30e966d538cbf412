# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""`tactile_push info`: what is in a bag, and how well the finger pushed."""

import argparse
import json
import math
import sys
from dataclasses import asdict
from datetime import datetime, timezone
from pathlib import Path
from typing import TYPE_CHECKING, Any

from tactile_push.cli.arguments import Commands, number

if TYPE_CHECKING:
    from rich.console import Console

    from tactile_push.report.info import BagInfo
    from tactile_push.report.merit import PushFigures

# A clock that counts from the epoch is later than this [ns]: 2001. Simulated time is earlier.
_EPOCH_CLOCK = 10**18


def add(commands: Commands) -> None:
    """Add the command.

    Parameters
    ----------
    commands : argparse subparsers
        Where it belongs.
    """
    info = commands.add_parser(
        'info',
        help='say what is in a bag, and how well the finger pushed',
        description='Says what is in a bag: files, topics, rates, gaps, the parameters of the '
        "experiment, and the paper's figures of merit if the controller's states are there.",
    )
    option = info.add_argument
    option('bag', type=Path, metavar='BAG', help='folder or file of a bag')
    option(
        '--band-deg',
        type=number('degrees between 0 and 180', 0.0, 180.0, closed=False),
        default=3.0,
        metavar='DEG',
        help='how near to its desired value theta counts as settled (default: 3)',
    )
    option('--json', action='store_true', help='print one JSON object, SI units')
    info.set_defaults(run=_info)


def _info(options: argparse.Namespace) -> int:
    from tactile_push.bags import BagError, BagReader
    from tactile_push.cli.bags import reading, warner
    from tactile_push.report.info import bag_info

    try:
        with (
            BagReader(options.bag, warner('info')) as bag,
            reading(sum(bag.counts.values())) as progress,
        ):
            info = bag_info(bag, math.radians(options.band_deg), progress)
    except BagError as error:
        print(f'tactile_push info: {error}', file=sys.stderr)
        return 2
    if options.json:
        print(json.dumps(_as_json(info), indent=2))
    else:
        _print(info)
    return 0


def _as_json(info: 'BagInfo') -> dict[str, Any]:
    from tactile_push.cli.bags import plain

    values = asdict(info)
    values['path'] = str(info.path)
    for entry in values['files']:
        entry['path'] = str(entry['path'])
    values['start_time_ns'] = values.pop('start_time')
    return plain(values)


def _print(info: 'BagInfo') -> None:
    from rich.markup import escape
    from rich.table import Table

    from tactile_push.cli.bags import wide_console

    console = wide_console()
    head = Table.grid(padding=(0, 2))
    head.add_row('bag', escape(str(info.path)))
    for file in info.files:
        compression = f', compression: {file.compression}' if file.compression else ''
        head.add_row('file', escape(f'{file.path.name}, {_size(file.size)}{compression}'))
    head.add_row('start', _start(info.start_time))
    head.add_row('duration', f'{info.duration:.3f} s')
    head.add_row('messages', str(info.messages))
    head.add_row('tactile_push', escape(info.version or 'version not recorded'))
    console.print(head, highlight=False)

    topics = Table()
    for heading in ('topic', 'type'):
        topics.add_column(heading, no_wrap=True)
    for heading in ('messages', 'rate [Hz]', 'largest gap [s]', 'at [s]', 'out of order'):
        topics.add_column(escape(heading), justify='right')
    for topic in info.topics:
        topics.add_row(
            escape(topic.name),
            escape(topic.type_name),
            str(topic.messages),
            _fixed(topic.rate, 2),
            _fixed(topic.largest_gap, 3),
            _fixed(topic.gap_at, 3),
            '' if topic.out_of_order is None else str(topic.out_of_order),
        )
    console.print(topics)
    for namespace, figures in info.pushes.items():
        _print_push(console, namespace, figures)
    _print_parameters(console, info)
    for remark in info.remarks:
        console.print(escape(remark), highlight=False)


def _print_push(console: 'Console', namespace: str, push: 'PushFigures') -> None:
    from rich.markup import escape
    from rich.table import Table

    paper = push.paper
    table = Table(title=escape(f'{namespace}/push_controller'), title_justify='left')
    table.add_column('')
    table.add_column('this bag', justify='right')
    if paper is not None:
        table.add_column(f'paper, fig. {paper.figure}', justify='right', style='dim')

    def row(label: str, value: str, of_paper: str = '') -> None:
        table.add_row(escape(label), value, *([of_paper] if paper is not None else []))

    band, settled = f'{math.degrees(push.band):g}°', ''
    if paper is not None:
        other = not math.isclose(paper.band, push.band)
        settled = f'{paper.settle_step}' + (f' ({math.degrees(paper.band):g}°)' if other else '')
    theta, phi, d = (paper.theta_range, paper.phi_range, paper.d_range) if paper else (None,) * 3
    row('steps', str(push.steps))
    if push.theta_desired is not None:
        changes = push.theta_desired_changes
        changed = f' (changed {changes} times)' if changes else ''
        row('θ_d [°]', _fixed(math.degrees(push.theta_desired), 1) + changed)
    if push.steps:
        since = f'from step {push.ranges_from} on'
        step = 'never' if push.settle_step is None else str(push.settle_step)
        row(f'within {band} of θ_d from step', step, settled)
        row(f'θ {since} [°]', _degrees(push.theta_range), _degrees(theta))
        row(f'φ {since} [°]', _degrees(push.phi_range), _degrees(phi))
    if push.l is not None and push.d_range is not None:
        label = f'so d by (17), l = {1e3 * push.l:g} mm [mm]'
        row(label, _range(push.d_range, 1e3, 2), _range(d, 1e3, 2))
    row('v_x [mm/s]', _range(push.v_x_range, 1e3, 2))
    row('steps with φ at a bound', _percent(push.saturated_share))
    row('steps with v_x at a bound', _percent(push.limited_share))
    row('ticks', '' if push.ticks is None else str(push.ticks))
    row('ticks lost', '' if push.ticks_lost is None else str(push.ticks_lost))
    silence = '' if push.silence is None else f'{push.silence:.3f} at {push.silence_at:.3f} s'
    row('longest without a contact [s]', silence)
    row('stops', str(len(push.stops)))
    console.print(table)
    for stop in push.stops:
        end = '' if stop.ended else ', to the end of the bag'
        console.print(
            f'stopped at {stop.at:.3f} s for {stop.duration:.3f} s{end}: {escape(stop.reason)}',
            highlight=False,
        )
    if push.missing:
        console.print(f'not in this bag: {", ".join(push.missing)}', highlight=False)


def _print_parameters(console: 'Console', info: 'BagInfo') -> None:
    from rich.markup import escape
    from rich.table import Table

    if not info.parameters:
        console.print('parameters: not recorded')
        return
    for node, parameters in sorted(info.parameters.items()):
        table = Table.grid(padding=(0, 2))
        for name, value in sorted(parameters.items()):
            table.add_row('', escape(name), escape(str(value)))
        console.print(f'parameters of /{escape(node)}', highlight=False)
        console.print(table, highlight=False)


def _start(time: int) -> str:
    from tactile_push.comparing.fields import seconds

    if time < _EPOCH_CLOCK:
        return f'{seconds(time)} s (simulated time)'
    return datetime.fromtimestamp(time / 1e9, tz=timezone.utc).isoformat(' ', 'milliseconds')


def _size(size: int) -> str:
    from rich.filesize import decimal

    return decimal(size)


def _fixed(value: float | None, digits: int) -> str:
    # Adding 0 takes the sign from what rounds to -0.
    return '' if value is None else f'{round(value, digits) + 0.0:.{digits}f}'


def _percent(share: float | None) -> str:
    return '' if share is None else f'{100.0 * share:.1f} %'


def _degrees(bounds: 'tuple[float, float] | None') -> str:
    return _range(bounds, math.degrees(1.0), 1)


def _range(bounds: 'tuple[float, float] | None', unit: float, digits: int) -> str:
    if bounds is None:
        return ''
    return ' to '.join(_fixed(unit * bound, digits) for bound in bounds)
