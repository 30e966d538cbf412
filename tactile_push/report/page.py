# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""A run as one HTML page that needs no network: plots, a view from above, tables.

The page is made of page.html, page.css and the scripts in assets/, of plotly.js as the
package plotly brings it, and of the run as JSON. Degrees, millimetres and seconds, as people read.
"""

import base64
import hashlib
import html
import json
import math
from collections.abc import Iterable, Sequence
from importlib.resources import files
from itertools import zip_longest
from string import Template

import numpy as np
import numpy.typing as npt

from tactile_push.report.data import LEVELS, Episode, Run, Scene, Series
from tactile_push.report.episodes import joined
from tactile_push.report.visible import frame_times, held, visible

DEGREES, MILLIMETRES, SECONDS = 180.0 / math.pi, 1e3, 1.0

# What a report shows against time, if the bag has it: factor from SI, offset and decimals.
LENGTHS = ('v_x', 'v_x_true', 'd', 'd_lower', 'd_upper', 'd_least', 'd_most', 'd_true')
SERIES = {
    **dict.fromkeys(('theta', 'theta_desired'), (DEGREES, 0.0, 3)),
    **dict.fromkeys(('phi', 'psi'), (DEGREES, -90.0, 3)),
    **dict.fromkeys(LENGTHS, (MILLIMETRES, 0.0, 4)),  # and lengths a second
    **dict.fromkeys(('silence', 'interval'), (SECONDS, 0.0, 4)),
}
# What only the view from above shows.
VIEWED = {
    **dict.fromkeys(('object_x', 'object_y'), (MILLIMETRES, 0.0, 3)),
    'object_angle': (DEGREES, 0.0, 3),
    **dict.fromkeys(('estimate_x', 'estimate_y'), (MILLIMETRES, 0.0, 3)),
    **dict.fromkeys(('finger_x', 'belt_travel'), (MILLIMETRES, 0.0, 2)),
    'state': (1.0, 0.0, 0),
}
UNSEEN = 1e-3  # gap between two episodes, relative to the duration: about a pixel
HOLD = 1.0  # the view shows no value that is older [s]: ten control periods of the paper
SCRIPTS = ('page.js', 'plots.js', 'view.js')
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

    plotly, script = get_plotlyjs(), _script()
    return Template(_part('page.html')).substitute(
        policy=_policy(plotly, script),
        name=html.escape(run.name),
        style=_part('page.css'),
        facts=html.escape(' · '.join(run.facts)),
        warnings=_warnings(run.warnings),
        summary=_outcome(run.outcome) if run.outcome else '',
        events=_events(run.episodes),
        parameters=''.join(_details(title, rows) for title, rows in run.tables.items()),
        data=_script_json(_content(run)),
        plotly=plotly,
        script=script,
    )


def _part(name: str) -> str:
    return (
        files('tactile_push.report').joinpath('assets').joinpath(name).read_text(encoding='utf-8')
    )


def _script() -> str:
    """Return the page's own script, which adds no names to the window."""
    parts = '\n'.join(_part(name) for name in SCRIPTS)
    return f'(() => {{\n{parts}}})();\n'


def _policy(*scripts: str) -> str:
    """Allow these scripts and nothing else: no other script, nothing from elsewhere."""
    hashes = [base64.b64encode(hashlib.sha256(text.encode()).digest()) for text in scripts]
    allowed = ' '.join(f"'sha256-{digest.decode()}'" for digest in hashes)
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
    frames: dict[str, object] = {'time': _numbers(moments, 4)}
    for name, (factor, offset, decimals) in (SERIES | VIEWED).items():
        series = run.series.get(name, nothing)
        values = held(series.time, series.values, moments, HOLD) * factor + offset
        frames[name] = _numbers(values, decimals)
    gravest: dict[str, int] = {}
    drawn = joined(run.episodes, UNSEEN * run.duration, run.duration)
    for episode in drawn:
        level = LEVELS.index(episode.level)
        gravest[episode.lane] = max(level, gravest.get(episode.lane, 0))
    return {
        'duration': max(run.duration, 1e-3),  # an axis needs a length
        'series': {
            name: _line(run.series[name], *SERIES[name]) for name in SERIES if name in run.series
        },
        'frames': frames,
        'states': list(run.states),
        'lanes': sorted(gravest, key=lambda lane: (-gravest[lane], lane)),
        'episodes': [vars(episode) for episode in drawn],
        'scene': _scene(run.scene),
    }


def _line(series: Series, factor: float, offset: float, decimals: int) -> dict[str, object]:
    seen = visible(series.time, series.values)
    return {
        'time': _numbers(series.time[seen], 4),
        'values': _numbers(series.values[seen] * factor + offset, decimals),
    }


def _numbers(values: npt.NDArray[np.float64], decimals: int) -> list[float | None]:
    """Round, and write None where there is no number: JSON has no NaN."""
    rounded = np.round(values, decimals) + 0.0  # no -0.0
    return [value if math.isfinite(value) else None for value in rounded.tolist()]


def _scene(scene: Scene) -> dict[str, object]:
    mu_c = scene.mu_c
    return {
        'radius': scene.radius * MILLIMETRES,
        'outline': [_numbers(MILLIMETRES * np.array(point), 3) for point in scene.outline],
        'mu_c': 'infinite' if mu_c == math.inf else mu_c,
    }


def _outcome(rows: Sequence[tuple[str, str, str]]) -> str:
    typeset = str.maketrans({'-': '−', ' ': '\N{NO-BREAK SPACE}'})
    return _table(
        ('', 'this run', 'paper'),
        [[cell.translate(typeset) if ' to ' in cell else cell for cell in row] for row in rows],
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
