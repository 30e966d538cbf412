# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""How well the finger pushed, beside the paper, in words and numbers for people."""

import math
from collections import Counter
from collections.abc import Mapping, Sequence
from typing import NamedTuple

from rich.markup import escape
from rich.table import Table as RichTable

from tactile_push.control import PUSHING, STATES
from tactile_push.paper import TOLERANCE, PaperFigures, Range, paper_figures
from tactile_push.report.columns import Table
from tactile_push.report.merit import KNOWN, PushFigures, known_step, push_figures
from tactile_push.report.placings import GOAL_HEADS, Placing, goal_cells
from tactile_push.report.pushed import Pushed

DEGREES, MILLIMETRES = 180.0 / math.pi, 1e3


class Row(NamedTuple):
    """A row of the table "this run | paper": the quantity with its unit, and its values."""

    what: str
    here: str
    paper: str = ''


def outcome_of(ticks: Table, sensing: Table, pushed: Pushed) -> list[Row]:
    """Return the figures of merit of a run in which this object was pushed.

    `ticks` and `sensing` are the columns of `push_controller/state` and `active_sensing/state`,
    empty if they were not recorded.
    """
    if not ticks:
        return []
    desired = float(ticks.get('theta_desired', [math.nan])[-1] - ticks.get('trim', [0.0])[-1])
    paper = paper_figures(desired, pushed.object)
    band = paper.band if paper else TOLERANCE
    push = push_figures(ticks, band, pushed.l, pushed.object, pushed.lever)
    known = None
    if 'state' in ticks and {'d_lower', 'd_upper'} <= sensing.keys():
        widths = sensing['d_upper'] - sensing['d_lower']
        if widths.any():  # of a round object d is 0 from the beginning
            steps = ticks['time'][ticks['state'] == STATES.index(PUSHING)]
            known = step_words(known_step(steps, sensing['time'], widths))
    return push_rows(push, known)


def push_rows(push: PushFigures, known: str | None = None) -> list[Row]:
    """Return the figures of merit of a push beside the paper's; unknown ones are left out.

    `known` says from which step on d was known, if active sensing was recorded.
    """
    paper = push.paper
    theta, phi, d = (paper.theta_range, paper.phi_range, paper.d_range) if paper else (None,) * 3
    band, settled = f'{push.band * DEGREES:.3g}°', ''
    if paper is not None:
        other = not math.isclose(paper.band, push.band)
        settled = f'{paper.settle_step}' + (f' ({paper.band * DEGREES:g}°)' if other else '')
    rows = [Row('steps', f'{push.steps:,}')]
    if push.theta_desired is not None:
        changes = push.theta_desired_changes
        changed = f' (changed {changes} times)' if changes else ''
        rows.append(Row('θ_d [°]', fixed(push.theta_desired * DEGREES, 1) + changed))
    rows += _range('θ_d trimmed by [°]', push.trim_range, None, DEGREES, 1)
    if push.steps:
        rows.append(Row(f'θ within {band} of θ_d from step', step_words(push.settle_step), settled))
    since = f'from step {push.ranges_from}'
    rows += _range(f'θ {since} [°]', push.theta_range, theta, DEGREES, 1)
    rows += _range(f'φ {since} [°]', push.phi_range, phi, DEGREES, 1)
    if push.l is not None:
        rows.append(Row('l [mm]', f'{push.l * MILLIMETRES:g}'))
    rows += _range('so d by (17) [mm]', push.d_range, d, MILLIMETRES, 2)
    if known is not None:
        rows.append(known_row(known, paper))
    rows += _range('v_x [mm/s]', push.v_x_range, None, MILLIMETRES, 2)
    for what, share in (('φ', push.saturated_share), ('v_x', push.limited_share)):
        if share is not None:
            rows.append(Row(f'steps with {what} at its bound', f'{share:.1%}'))
    for what, count in (('control ticks', push.ticks), ('control ticks lost', push.ticks_lost)):
        if count is not None:
            rows.append(Row(what, f'{count:,}'))
    if push.silence is not None:
        silence = f'{push.silence:.3f} at {push.silence_at:.3f} s'
        rows.append(Row('longest silence of the contact [s]', silence))
    reasons = Counter(stop.reason for stop in push.stops)
    stops = ', '.join(f'{reason} {count}×' for reason, count in reasons.items())
    return [*rows, Row('stops', stops or 'none')]


def known_row(known: str, paper: PaperFigures | None) -> Row:
    """Return the row that says from which step on d was known."""
    of_paper = paper.known_step if paper is not None else None
    what = f'd known to {KNOWN * MILLIMETRES:g} mm from step'
    return Row(what, known, '' if of_paper is None else f'{of_paper}')


def step_words(step: int | None) -> str:
    """Return a step for people, 'never' if there is none."""
    return 'never' if step is None else f'{step:,}'


def fixed(value: float, digits: int) -> str:
    """Return a number with so many decimals, without the sign of what rounds to -0."""
    return f'{round(value, digits) + 0.0:.{digits}f}'


def outcome_table(
    runs: Mapping[str, tuple[Sequence[Row], PaperFigures | None]], title: str | None = None
) -> RichTable:
    """Return the table "this run | paper" for a terminal.

    `runs` has for the heading of each run its rows and what the paper publishes of the same
    experiment; without that a run has no column of the paper.
    """
    table = RichTable(title=None if title is None else escape(title), title_justify='left')
    table.add_column('')
    order: list[str] = []
    for heading, (rows, paper) in runs.items():
        table.add_column(escape(heading), justify='right')
        if paper is not None:
            table.add_column(f'paper, fig. {paper.figure}', justify='right', style='dim')
        place = 0
        for row in rows:  # what other runs do not have goes behind the row before it
            if row.what not in order:
                order.insert(place, row.what)
            place = order.index(row.what) + 1
    for what in order:
        cells = []
        for rows, paper in runs.values():
            row = next((row for row in rows if row.what == what), Row(what, ''))
            cells += [row.here] if paper is None else [row.here, row.paper]
        table.add_row(*map(escape, [what, *cells]))
    return table


def goal_table(goals: Sequence[Placing], title: str | None = None) -> RichTable:
    """Return the table of what became of goals, for a terminal."""
    table = RichTable(title=title, title_justify='left')
    for heading in GOAL_HEADS:
        table.add_column(heading)
    for cells in goal_cells(goals):
        table.add_row(*map(escape, cells))
    return table


def _range(
    what: str, found: Range | None, paper: Range | None, factor: float, digits: int
) -> list[Row]:
    """Return the row of a range; none if it was not found."""
    if found is None:
        return []
    here, there = (
        '' if pair is None else ' to '.join(fixed(value * factor, digits) for value in pair)
        for pair in (found, paper)
    )
    return [Row(what, here, there)]
