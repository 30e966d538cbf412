# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""`tactile_push replay`: a bag's readings through geometry, law and active sensing again."""

import argparse
import sys
from typing import TYPE_CHECKING

from tactile_push.cli.arguments import Commands, number, rerun_options
from tactile_push.interface import PUSH_CONTROLLER, node_in
from tactile_push.streams import complain

if TYPE_CHECKING:
    from tactile_push.replay import Comparison

GAINS = ('kp', 'kd')


def add(commands: Commands) -> None:
    """Add the command."""
    replay = commands.add_parser(
        'replay',
        help="run a bag's readings through geometry, control law and active sensing again",
        description='Feeds the recorded readings through the code that the nodes run, on the '
        'recorded stamps, without nodes and without waiting, and says what the law would have '
        'commanded beside what was commanded. The same bag gives the same commands to the bit. The '
        'object is sensed again if active_sensing was recorded. Exit status: 0 done, 1 no control '
        'period of a finger could be made again, 2 bad input.',
    )
    option = replay.add_argument
    gain = number('a finite gain of 0 or more', 0.0, sys.float_info.max)
    option(
        '--kp', type=gain, metavar='X', help='proportional gain [rad/rad] (default: as recorded)'
    )
    option('--kd', type=gain, metavar='X', help='derivative gain [rad/rad] (default: as recorded)')
    rerun_options(
        replay,
        config='ROS parameter file with values for contact_geometry, push_controller and '
        'active_sensing to use instead of the recorded ones; with a section for active_sensing the '
        'replay senses the object even if that node was not recorded',
        out='write a copy of the bag, with what was computed again in place of what was recorded',
        json='write every control period as one JSON object in SI units; - prints it instead of '
        'the summary',
    )
    replay.set_defaults(run=_replay)


def _replay(options: argparse.Namespace) -> int:
    from tactile_push.cli.output import opened, reading, warner, write_json
    from tactile_push.replay import replay

    warn = warner('replay')
    gains = {name: getattr(options, name) for name in GAINS if getattr(options, name) is not None}
    with opened(options.bag, warn) as bag, reading(sum(bag.counts.values())) as progress:
        comparisons = replay(
            bag, config=options.config, controller=gains, out=options.out, progress=progress
        )
    if options.json is not None:
        write_json(options.json, {'fingers': [one.as_json() for one in comparisons]})
    if options.json != '-':
        _print(comparisons)
    for comparison in comparisons:
        for parameter in comparison.without_effect:
            warn(f'{options.config}: {parameter}: has no effect, the bag says what came of it')
        if not comparison.ticks:
            complain('tactile_push replay', f'{options.bag}: {_why_not(comparison)}')
        elif comparison.kept and (gains or options.config is not None):
            warn(
                f'{_node(comparison)}: {comparison.kept} control periods are kept as recorded, '
                'whatever the values'
            )
    return 0 if all(comparison.ticks for comparison in comparisons) else 1


def _node(comparison: 'Comparison') -> str:
    return f'/{node_in(comparison.finger, PUSH_CONTROLLER)}'


def _why_not(comparison: 'Comparison') -> str:
    """Return why no control period could be computed."""
    if not comparison.kept:
        return f'{_node(comparison)}: no contact, so no control period'
    why = 'what they depend on is not in the bag'
    if comparison.went_back:
        why = f'the stamps of {comparison.went_back} go back'
    return (
        f'{_node(comparison)}: no control period could be made again, {comparison.kept} kept as '
        f'recorded: {why}'
    )


def _print(comparisons: 'list[Comparison]') -> None:
    from rich.table import Table

    from tactile_push.cli.output import bounded, shown, wide_console

    console = wide_console()
    for comparison in comparisons:
        table = Table(show_header=False, title=shown(comparison.finger) or None)

        def row(label: str, value: object, table: Table = table) -> None:
            table.add_row(label, str(value))

        different = comparison.different()
        row('readings', comparison.readings)
        row('contacts', comparison.contacts)
        for reason, count in sorted(comparison.refused.items()):
            row(f'refused: {reason}', count)
        row('control periods', len(comparison.ticks))
        if comparison.kept:
            row('before them, kept as recorded', comparison.kept)
        if comparison.recorded:
            row('commands that differ', len(different))
        else:
            row('commands that differ', 'none recorded to compare with')
        if different:
            first = different[0]
            largest = max(different, key=lambda tick: abs(tick.v_x - tick.v_x_recorded))
            for label, tick in (('first', first), ('largest', largest)):
                row(
                    f'{label} difference',
                    f'{1000.0 * tick.v_x:.3f} mm/s instead of '
                    f'{1000.0 * tick.v_x_recorded:.3f} mm/s after {tick.time:.2f} s',
                )
        if comparison.sensed:
            row(r'd at the end \[mm]', bounded(comparison.sensed[-1]._asdict(), 'd', 1e3, 2))
        console.print(table)
