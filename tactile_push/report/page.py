# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""A run as one HTML page that needs no network: plots, a view from above, tables.

The page is made of page.html, page.css and the scripts in assets/, of plotly.js as the
package plotly brings it, and of the run as JSON. Degrees, millimetres and seconds, as people read.
"""

import html
import json
from collections.abc import Iterable, Sequence
from itertools import zip_longest
from string import Template

import numpy as np

from tactile_push.report.data import LEVELS, Episode, Run, Series
from tactile_push.report.episodes import joined
from tactile_push.report.page_parts import allowance, asset, own_script
from tactile_push.report.placings import GOAL_HEADS
from tactile_push.report.scene import scene_content
from tactile_push.report.shown import HOLD, SERIES, VIEWED, numbers, readable
from tactile_push.report.visible import frame_times, held, visible

UNSEEN = 1e-3  # gap between two episodes, relative to the duration: about a pixel
SCRIPTS = ('page.js', 'panels.js', 'plots.js', 'view.js')
# Of the drawings of placed objects.
KEY = """<ul class="key" id="placed-key">
<li style="--key: var(--blue)">finger</li>
<li style="--key: var(--orange)">centre of mass</li>
<li style="--key: var(--text)">let go</li>
<li class="dashed" style="--key: var(--error)">goal</li>
<li style="--key: var(--green)">d as believed</li>
<li class="dashed" style="--key: var(--text)">true d</li>
</ul>
"""
MOST_ROWS = 50  # of kinds of episodes: as many as a person may read; picked


def report_html(run: Run) -> str:
    """Make the page.

    Parameters
    ----------
    run : Run
        What to show.

    Returns
    -------
    str
        An HTML document.
    """
    from plotly.offline import get_plotlyjs  # which Ubuntu does not have; the figures need it not

    plotly, script = get_plotlyjs(), own_script(*map(asset, SCRIPTS))
    return Template(asset('page.html')).substitute(
        policy=_policy(plotly, script),
        name=html.escape(run.name),
        style=asset('page.css'),
        view=asset('view.svg'),
        facts=html.escape(' · '.join(run.facts)),
        warnings=_warnings(run.warnings),
        summary=_outcome(run.outcome) if run.outcome else '',
        placed=_placed(run) if run.goals else '',
        events=_events(run.episodes),
        parameters=''.join(_details(title, rows) for title, rows in run.tables.items()),
        data=_script_json(_content(run)),
        plotly=plotly,
        script=script,
    )


def _policy(*scripts: str) -> str:
    """Allow these scripts and nothing else: no other script, nothing from elsewhere."""
    allowed = ' '.join(map(allowance, scripts))
    return (
        f"default-src 'none'; img-src data: blob:; style-src 'unsafe-inline'; script-src {allowed}"
    )


def _script_json(content: object) -> str:
    """Write JSON that cannot end the script element in which it stands."""
    text = json.dumps(content, allow_nan=False, separators=(',', ':'))
    return text.replace('&', r'\u0026').replace('<', r'\u003c').replace('>', r'\u003e')


def _content(run: Run) -> dict[str, object]:
    """Return what the page's script needs, as plain values."""
    moments = frame_times(run.duration)
    nothing = Series(np.empty(0), np.empty(0))
    frames: dict[str, object] = {'time': numbers(moments, 4)}
    for name in SERIES | VIEWED:
        series = run.series.get(name, nothing)
        frames[name] = readable(name, held(series.time, series.values, moments, HOLD))
    gravest: dict[str, int] = {}
    drawn = joined(run.episodes, UNSEEN * run.duration, run.duration)
    for episode in drawn:
        level = LEVELS.index(episode.level)
        gravest[episode.lane] = max(level, gravest.get(episode.lane, 0))
    return {
        'duration': max(run.duration, 1e-3),  # an axis needs a length
        'series': {name: _line(name, run.series[name]) for name in SERIES if name in run.series},
        'frames': frames,
        'states': list(run.states),
        'lanes': sorted(gravest, key=lambda lane: (-gravest[lane], lane)),
        'episodes': [vars(episode) for episode in drawn],
        'scene': scene_content(run.scene),
    }


def _line(name: str, series: Series) -> dict[str, object]:
    seen = visible(series.time, series.values)
    return {
        'time': numbers(series.time[seen], 4),
        'values': readable(name, series.values[seen]),
    }


def _outcome(rows: Sequence[tuple[str, str, str]]) -> str:
    typeset = str.maketrans({'-': '−', ' ': '\N{NO-BREAK SPACE}'})
    return _table(
        ('', 'this run', 'paper'),
        [[cell.translate(typeset) if ' to ' in cell else cell for cell in row] for row in rows],
    )


def _placed(run: Run) -> str:
    """Make the section about goals to place objects at."""
    pictures = ''.join(
        f'<figure><figcaption>{html.escape(title)}</figcaption>\n{drawing}</figure>\n'
        for title, drawing in run.drawings
    )
    return (
        '<section id="placed-section" aria-labelledby="placed-heading">\n'
        f'<h2 id="placed-heading">Placed objects</h2>\n{_table(GOAL_HEADS, run.goals)}{pictures}'
        f'{KEY if run.drawings else ""}</section>\n'
    )


def _warnings(warnings: Sequence[str]) -> str:
    if not warnings:
        return ''
    lines = ''.join(f'<p>{html.escape(warning)}</p>' for warning in warnings)
    return f'<div class="warnings" role="note">{lines}</div>\n'


def _events(found: Sequence[Episode]) -> str:
    """Make a table of the different episodes, the gravest first."""
    if not found:
        return '<p>None.</p>\n'
    alike: dict[tuple[int, str, str], list[Episode]] = {}
    for episode in found:
        key = -LEVELS.index(episode.level), episode.lane, episode.text
        alike.setdefault(key, []).append(episode)
    levels, rows = [], []
    for (level, lane, text), group in sorted(alike.items()):
        lasted = sum(episode.end - episode.start for episode in group)
        levels.append(LEVELS[-level])
        rows.append(
            (f'{lane}: {text}', f'{len(group):,}', f'{group[0].start:.2f}', f'{lasted:.2f}')
        )
    heads = ('what', 'times', 'first [s]', 'total [s]')
    more = len(rows) - MOST_ROWS
    return _table(heads, rows[:MOST_ROWS], levels[:MOST_ROWS]) + (
        f'<p>And {more:,} more kinds.</p>\n' if more > 0 else ''
    )


def _details(title: str, rows: Sequence[tuple[str, ...]]) -> str:
    return f'<details><summary>{html.escape(title)}</summary>\n{_table((), rows)}</details>\n'


def _table(heads: Sequence[str], rows: Iterable[Sequence[str]], levels: Iterable[str] = ()) -> str:
    """Make a table; the first cell of a row says what the row is, behind its level."""
    head = ''.join(f'<th scope="col">{html.escape(text)}</th>' for text in heads)
    lines = [f'<thead><tr>{head}</tr></thead>\n'] if heads else []
    for row, level in zip_longest(rows, levels, fillvalue=''):
        mark = f'<span class="level {level}">{level}</span> ' if level else ''
        cells = ''.join(f'<td>{html.escape(text)}</td>' for text in row[1:])
        lines.append(f'<tr><th scope="row">{mark}{html.escape(row[0])}</th>{cells}</tr>\n')
    return f'<div class="scroll"><table>\n{"".join(lines)}</table></div>\n'
