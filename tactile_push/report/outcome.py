# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""How well the finger pushed, beside the paper, in words and numbers for people."""

import math
from collections import Counter
from collections.abc import Mapping

from tactile_push.control import PUSHING, STATES
from tactile_push.paper import Range, paper_figures
from tactile_push.report.known import KNOWN, known_step
from tactile_push.report.merit import PushFigures, PushHistory
from tactile_push.report.reading import Table

BAND = math.radians(3.0)  # how near to its desired value theta counts as settled [rad]
# The parameter of `sim_plant` that is l, by what is pushed.
DISTANCES = {'block': 'edge_to_cm', 'disk': 'disk_radius'}
DEGREES, MILLIMETRES = 180.0 / math.pi, 1e3

Row = tuple[str, str, str]
"""What, its value, the paper's."""


def outcome_of(ticks: Table, sensing: Table, plant: Mapping[str, object]) -> list[Row]:
    """Give the figures of merit.

    Parameters
    ----------
    ticks : dict
        The columns of `push_controller/state`; empty if the bag does not have it.
    sensing : dict
        Those of `active_sensing/state`.
    plant : mapping of str to object
        The parameters of `sim_plant`, as far as they are known.

    Returns
    -------
    list of tuple of str
        What, its value, the paper's.
    """
    if not ticks:
        return []
    pushed = plant.get('object')
    thing = pushed if isinstance(pushed, str) else None
    l = plant.get(DISTANCES.get(thing or '', ''))
    paper = paper_figures(float(ticks.get('theta_desired', [math.nan])[-1]), thing)
    history = PushHistory(paper.band if paper else BAND, l if isinstance(l, float) else None, thing)
    names = [name for name in ticks if name != 'time']
    for time, *values in zip(ticks['time'], *(ticks[name] for name in names), strict=True):
        history.add(float(time), float(time), dict(zip(names, map(float, values), strict=True)))
    return _rows(history.figures(), _known(ticks, sensing))


def _known(ticks: Table, sensing: Table) -> str | None:
    """Tell from which step on d is known; None if that is not recorded or d is 0 by roundness."""
    if 'state' not in ticks or not {'d_lower', 'd_upper'} <= sensing.keys():
        return None
    widths = sensing['d_upper'] - sensing['d_lower']
    if not widths.any():
        return None
    steps = ticks['time'][ticks['state'] == STATES.index(PUSHING)]
    step = known_step(steps, sensing['time'], widths)
    return 'never' if step is None else f'{step:,}'


def _rows(push: PushFigures, known: str | None) -> list[Row]:
    paper = push.paper
    theta, phi, d = (paper.theta_range, paper.phi_range, paper.d_range) if paper else (None,) * 3
    since = f'from step {push.ranges_from}'
    band = f'{push.band * DEGREES:.3g}°'
    rows: list[Row | None] = [
        ('steps', f'{push.steps:,}', ''),
        (
            f'θ within {band} of θ_d from step',
            'never' if push.settle_step is None else f'{push.settle_step:,}',
            f'{paper.settle_step}' if paper else '',
        ),
        _range(f'θ {since} [°]', push.theta_range, theta, DEGREES, 1),
        _range(f'φ {since} [°]', push.phi_range, phi, DEGREES, 1),
        _range('so d by (17) [mm]', push.d_range, d, MILLIMETRES, 2),
        _known_row(known, paper.known_step if paper else None),
        _range('v_x [mm/s]', push.v_x_range, None, MILLIMETRES, 2),
        _share('steps with φ at its bound', push.saturated_share),
        _share('steps with v_x at its bound', push.limited_share),
        _number('control ticks lost', push.ticks_lost, ','),
        _number('longest silence of the contact [s]', push.silence, '.2f'),
    ]
    reasons = Counter(stop.reason for stop in push.stops)
    stops = ', '.join(f'{reason} {count}×' for reason, count in reasons.items())
    return [*(row for row in rows if row is not None), ('stops', stops or 'none', '')]


def _known_row(known: str | None, paper: int | None) -> Row | None:
    what = f'd known to {KNOWN * MILLIMETRES:g} mm from step'
    return None if known is None else (what, known, '' if paper is None else str(paper))


def _range(
    what: str, found: Range | None, paper: Range | None, factor: float, digits: int
) -> Row | None:
    if found is None:
        return None
    here, there = (
        '' if pair is None else ' to '.join(_fixed(value * factor, digits) for value in pair)
        for pair in (found, paper)
    )
    typeset = {ord('-'): '−', ord(' '): '\N{NO-BREAK SPACE}'}
    return what, here.translate(typeset), there.translate(typeset)


def _fixed(value: float, digits: int) -> str:
    return f'{round(value, digits) + 0.0:.{digits}f}'  # of no -0.0


def _share(what: str, share: float | None) -> Row | None:
    return None if share is None else (what, f'{share:.1%}', '')


def _number(what: str, number: float | None, form: str) -> Row | None:
    return None if number is None else (what, format(number, form), '')
