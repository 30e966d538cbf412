# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""`tactile_push estimate`: what a bag tells about the object that was pushed."""

import argparse
import math
from dataclasses import asdict
from typing import TYPE_CHECKING, Any

from tactile_push.cli.arguments import Commands, edge, number, rerun_options
from tactile_push.interface import ACTIVE_SENSING, node_in

if TYPE_CHECKING:
    from tactile_push.replay import ObjectFigures
    from tactile_push.report.outcome import Row


def add(commands: Commands) -> None:
    """Add the command."""
    estimate = commands.add_parser(
        'estimate',
        help='say what the pushes in a bag tell about the object',
        description='Runs active sensing over the control periods that were recorded, and says '
        'where along the edge the finger was, how sure that is and from when on, and when the '
        'readings contradicted the object. Exit status: 0 done, 1 nothing was ever known of an '
        'object, 2 bad input.',
    )
    option = estimate.add_argument
    option(
        '--edge',
        type=edge,
        metavar='N',
        help='the pushed edge, 0 from the first corner to the second; -1 if it is not known '
        '(default: as recorded)',
    )
    option(
        '--noise-deg',
        type=number('degrees from 0.001 to 28', 0.001, 28.0),
        metavar='DEG',
        help='standard deviation of the readings (default: as recorded)',
    )
    rerun_options(
        estimate,
        config='ROS parameter file with values for active_sensing to use instead of the recorded '
        'ones, such as the outline',
        out='write a copy of the bag, with these estimates in place of the recorded ones',
        json='write results and every control period as one JSON object in SI units; - prints it '
        'instead of the summary',
    )
    estimate.set_defaults(run=_estimate)


def _estimate(options: argparse.Namespace) -> int:
    from tactile_push.cli.output import opened, reading, warner, write_json
    from tactile_push.replay import estimate

    warn = warner('estimate')
    sensing: dict[str, Any] = {}
    if options.edge is not None:
        sensing['edge'] = options.edge
    if options.noise_deg is not None:
        sensing['noise'] = math.radians(options.noise_deg)
    with opened(options.bag, warn) as bag, reading(sum(bag.counts.values())) as progress:
        results = estimate(
            bag, config=options.config, sensing=sensing, out=options.out, progress=progress
        )
    if options.json is not None:
        write_json(options.json, {'fingers': [_as_json(result) for result in results]})
    for result in results:
        if not result.object_told:
            warn(f"{_node(result)} was not recorded: taken for the paper's block")
    if options.json != '-':
        _print(results)
    return 0 if all(result.values is not None for result in results) else 1


def _node(result: 'ObjectFigures') -> str:
    return f'/{node_in(result.finger, ACTIVE_SENSING)}'


def _as_json(result: 'ObjectFigures') -> dict[str, Any]:
    from tactile_push.cli.output import plain

    return plain({**asdict(result), 'ticks': [tick.as_json() for tick in result.ticks]})


def _print(results: 'list[ObjectFigures]') -> None:
    from tactile_push.cli.output import shown, wide_console
    from tactile_push.report.outcome import outcome_table

    console = wide_console()
    for result in results:
        runs = {'this bag': (_rows(result), result.paper)}
        console.print(outcome_table(runs, title=shown(_node(result))))
        for one in result.contradictions:
            end = '' if one.ended else ', to the end of the bag'
            console.print(
                f'contradiction at {one.at:.3f} s for {one.duration:.3f} s{end}: {one.reason}',
                highlight=False,
            )
        for reason in dict.fromkeys(one.reason for one in result.forgotten):
            times = [one.at for one in result.forgotten if one.reason == reason]
            often = '' if len(times) == 1 else f', {len(times)} times up to {times[-1]:.3f} s'
            console.print(f'all forgotten at {times[0]:.3f} s{often}: {reason}', highlight=False)


def _rows(result: 'ObjectFigures') -> 'list[Row]':
    from tactile_push.cli.output import bounded
    from tactile_push.report.outcome import Row, known_row, step_words

    rows = [Row('control periods', str(len(result.ticks))), Row('readings', str(result.readings))]
    values = result.values
    if values is None:
        rows.append(Row('d', 'never known'))
    else:
        rows.append(Row('known last at [s]', f'{result.at:.3f}'))
        rows.append(Row('d [mm]', bounded(values, 'd', 1e3, 2)))
        rows.append(Row('c [mm]', bounded(values, 'c', 1e3, 1)))
        rows.append(Row('μ_c', bounded(values, 'mu_c', 1.0, 2)))
        if math.isfinite(values['edge']):  # a disk has none, and its d is 0
            rows.append(Row('edge', f'{values["edge"]:.0f} ({values["edge_weight"]:.0%})'))
            rows.append(known_row(step_words(result.known_step), result.paper))
    if result.inside is not None and result.inside_guaranteed is not None:
        rows += [
            Row('control periods with a true d', str(result.compared)),
            Row('of them inside the 95 % interval', f'{result.inside:.1%}'),
            Row('of them within the guaranteed bounds', f'{result.inside_guaranteed:.1%}'),
        ]
    return rows
