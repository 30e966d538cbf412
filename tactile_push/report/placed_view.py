# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Drawings of placed objects in the report: from above on the belt, and what was believed of d."""

import html
import math
from collections.abc import Mapping, Sequence

import numpy as np
import numpy.typing as npt

from tactile_push.interface import PLACE_STATE, SENSING_STATE, TRUE_POSE, TRUE_STATE
from tactile_push.placed_way import PlacedWay, from_above
from tactile_push.report.columns import Column, Table
from tactile_push.report.data import Scene
from tactile_push.report.placings import Placing, way_of

MILLIMETRES = 1e3
MARGIN = 6.0  # around what is drawn [mm]
MOST_POINTS = 400  # of a line
BAR = 20.0  # length of the scale [mm]
HEIGHT = 80.0  # of the drawing of d [mm]


def drawings(
    found: Sequence[Placing], tables: Mapping[str, Table], scene: Scene
) -> list[tuple[str, str]]:
    """Return a title and SVG for each goal that there is something to draw of.

    `tables` are the columns of the bag's topics, `scene` is what was pushed by what.
    """
    drawn = []
    for number, one in enumerate(found, 1):
        way = way_of(one, tables.get(TRUE_STATE, {}), tables.get(TRUE_POSE, {}), scene)
        parts = [] if way is None else [_from_above(way)]
        parts += _believed(one, tables)
        if parts:
            drawn.append((f'Goal {number}: {one.stage}', ''.join(parts)))
    return drawn


def _from_above(way: PlacedWay) -> str:
    """Draw ways and outlines, the belt's direction to the right, left of the finger above."""
    seen = from_above(way)
    shapes = [('passed', outline) for _, outline in seen.passed]
    shapes += [('free', seen.free), ('wanted', seen.wanted)]
    outlines = (outline for _, outline in shapes)
    everything = np.concatenate(
        [seen.finger, seen.centre, seen.tip, seen.goal[np.newaxis], *outlines]
    )
    low = MILLIMETRES * everything.min(axis=0)[::-1] - MARGIN
    high = MILLIMETRES * everything.max(axis=0)[::-1] + MARGIN
    across = f'{MILLIMETRES * seen.goal[0]:.2f}'
    lines = [
        f'<path class="goal-line" d="M{low[0]:.2f} {across}H{high[0]:.2f}"/>',
        *(_path(name, points, 'Z') for name, points in shapes if len(points)),
        _path('finger-way', seen.finger),
        _path('centre-way', seen.centre),
        _path('tip', seen.tip, 'Z'),
        _scale(high[0] - MARGIN, high[1] - MARGIN / 2.0),
    ]
    return _svg((*low, *(high - low)), lines, 'Finger and object from above')


def _believed(one: Placing, tables: Mapping[str, Table]) -> list[str]:
    """Draw what was believed of d, its 95 % interval and the truth, against time."""
    believed = _within(one, tables.get(PLACE_STATE, {}), 'd')
    if believed is None:
        return []
    lines = []
    sensed = tables.get(SENSING_STATE, {})
    low, high = (_within(one, sensed, name) for name in ('d_lower', 'd_upper'))
    true = _within(one, tables.get(TRUE_STATE, {}), 'd')
    spans = [line for line in (believed, true) if line is not None]
    least = min(float(line[1].min()) for line in spans) - 1e-3
    most = max(float(line[1].max()) for line in spans) + 1e-3
    lasted = max(one.end - one.start, 1e-3)

    def scaled(time: Column, d: Column) -> Column:
        """Return points with d upwards, on a drawing twice as long as high."""
        along = (time - one.start) / lasted * 2.0 * HEIGHT
        up = (most - np.clip(d, least, most)) / (most - least) * HEIGHT
        return np.stack([up, along], axis=1) / MILLIMETRES

    if low is not None and high is not None:
        band = np.concatenate([scaled(*low), scaled(*high)[::-1]])
        lines.append(_path('interval', band, 'Z'))
    if true is not None:
        lines.append(_path('true', scaled(*true)))
    lines.append(_path('believed', scaled(*believed)))
    for d, at in ((most, 3.5), (least, HEIGHT)):
        lines.append(f'<text x="0" y="{at:.2f}">{d * MILLIMETRES:.1f} mm</text>')
    box = -1.0, -1.0, 2.0 * HEIGHT + 2.0, HEIGHT + 2.0
    return [_svg(box, lines, 'd as believed, its 95 % interval, and the true one')]


def _within(one: Placing, table: Table, name: str) -> tuple[Column, Column] | None:
    """Return times and values of a quantity while a goal was served, None if there are none."""
    if name not in table:
        return None
    time, values = table['time'], table[name]
    kept = (time >= one.start) & (time <= one.end) & np.isfinite(values)
    return (time[kept], values[kept]) if kept.any() else None


def _path(name: str, points: npt.NDArray[np.float64], close: str = '') -> str:
    """Return a path through points across and along the belt [m]."""
    some = points[:: max(1, math.ceil(len(points) / MOST_POINTS))]
    some = np.concatenate([some, points[-1:]])
    places = 'L'.join(f'{MILLIMETRES * y:.2f} {MILLIMETRES * x:.2f}' for x, y in some.tolist())
    return f'<path class="{name}" d="M{places}{close}"/>'


def _scale(right: float, below: float) -> str:
    return (
        f'<path class="scale" d="M{right - BAR:.2f} {below:.2f}h{BAR:g}"/>'
        f'<text x="{right - BAR:.2f}" y="{below - 1.5:.2f}">{BAR:g} mm</text>'
    )


def _svg(box: Sequence[float], lines: Sequence[str], label: str) -> str:
    view = ' '.join(f'{value:.2f}' for value in box)
    return (
        f'<svg class="placed" viewBox="{view}" role="img" aria-label="{html.escape(label)}">'
        f'{"".join(lines)}</svg>\n'
    )
