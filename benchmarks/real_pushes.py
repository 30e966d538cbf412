# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Predict measured pushes from the outline and two fitted numbers, without any force data.

    python benchmarks/real_pushes.py DIR [--json]

DIR holds JSON files of pushes: `outline` as `tactile_push simulate --object` takes it, `tip_radius`
[m], and `pushes`, each with `tip_start`, `tip_end` [x, y in m], `object_start` and `object_end`
[x, y in m, yaw in rad] in one fixed frame. `published` and `object_did_not_move_baseline`, if they
are there, are shown beside the errors.

The object slides on the exact limit surface of a load between the centroid and the corners: one
number says how far it is spread (`Support.spread`), and so its c. The other number is mu_c. Both
are fitted on one half of a file's pushes, every second one, and tried on the other half, and the
other way round: every push is predicted by numbers that do not know it. `nominal` has nothing
fitted: uniform pressure and mu_c = 0.25.

A file may have the `support` on which the object rested, `points` [m] and `loads`. A further
prediction then has these loads and fits mu_c alone, and one more fits mu_c and the tilt of a push
above the support (`ExactLimitSurface`), both on one half for the other.

The measured poses at the start of a push overlap by up to 2 mm in places. There the finger's way is
moved out of the object along the contact normal: as if the offset were one of measurement, and
stayed.
"""

import argparse
import json
import math
import reprlib
import sys
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
from rich.console import Console
from rich.progress import Progress
from rich.table import Table

from tactile_push.mechanics import (
    ExactLimitSurface,
    Outline,
    Pose,
    Slider,
    Support,
    clearance,
    tangent_angle,
)
from tactile_push.mechanics.spread import largest_spread
from tactile_push.simulation import read_object

POINTS = 200  # that stand for the support
NOMINAL_MU_C = 0.25
SPREADS = np.arange(0.6, 3.01, 0.4)  # from close to the centroid to the corners
FRICTIONS = np.arange(0.05, 0.451, 0.1)
PLACES = {'tip_start': 2, 'tip_end': 2, 'object_start': 3, 'object_end': 3}
KNOWN_FRICTIONS = np.arange(0.3, 0.601, 0.05)  # of pushes on a known support
TILTS = np.arange(0.0, 9e-3, 1e-3)  # [m]
KNOWN = {'known': 'known support', 'known_tilt': 'known support, tilted'}
REFINEMENTS = 3  # each halves the steps of the grid around the best point


@dataclass(frozen=True)
class Pushes:
    """A file of measured pushes."""

    name: str
    outline: Outline
    tip_radius: float
    starts: list[Pose]
    ends: list[Pose]
    ways: list[tuple[tuple[float, float], tuple[float, float]]]
    published: dict[str, Any]
    support: Support | None  # if the file has it


@dataclass(frozen=True)
class Errors:
    """Errors of predicted final poses, [m] and [rad], shape (N,) each."""

    position: np.ndarray
    angle: np.ndarray

    def figures(self) -> dict[str, float]:
        """Give mean and median in millimetres and degrees."""
        millimetres, degrees = 1000.0 * self.position, np.degrees(self.angle)
        return {
            'mean_mm': float(millimetres.mean()),
            'mean_deg': float(degrees.mean()),
            'median_mm': float(np.median(millimetres)),
            'median_deg': float(np.median(degrees)),
        }


def read_pushes(file: Path) -> Pushes:
    """Read a file of pushes."""
    outline, _ = read_object(file)
    content = json.loads(file.read_text())
    try:
        radius = _numbers('tip_radius', [content.get('tip_radius')], 1)[0]
        if not radius > 0.0:
            raise ValueError(f'tip_radius: expected a positive length [m], got {radius}')
        pushes = content.get('pushes')
        if not isinstance(pushes, list) or len(pushes) < 2:
            raise ValueError(f'pushes: expected a list of two or more, got {reprlib.repr(pushes)}')
        rows: dict[str, list[tuple[float, ...]]] = {key: [] for key in PLACES}
        for k, push in enumerate(pushes):
            for key, count in PLACES.items():
                value = push.get(key) if isinstance(push, dict) else None
                rows[key].append(_numbers(f'pushes[{k}]: {key}', value, count))
        support = _support(content['support']) if 'support' in content else None
        published = content.get('published', {})
        if 'object_did_not_move_baseline' in content and isinstance(published, dict):
            published = published | {'object did not move': content['object_did_not_move_baseline']}
        if not isinstance(published, dict) or not all(map(_are_errors, published.values())):
            raise ValueError(
                'published: expected an object of errors for every model, got '
                f'{reprlib.repr(published)}'
            )
    except ValueError as error:
        raise ValueError(f'{file}: {error}') from None
    return Pushes(
        file.stem,
        outline,
        radius,
        [Pose(*pose) for pose in rows['object_start']],
        [Pose(*pose) for pose in rows['object_end']],
        list(zip(rows['tip_start'], rows['tip_end'], strict=True)),
        published,
        support,
    )


def _support(content: Any) -> Support:
    if not (isinstance(content, dict) and isinstance(content.get('points'), list)):
        raise ValueError(f'support: expected points and loads, got {reprlib.repr(content)}')
    points = [_numbers('support: points', point, 2) for point in content['points']]
    loads = _numbers('support: loads', content.get('loads'), len(points))
    return Support.at_points(points, loads)


def _are_errors(errors: Any) -> bool:
    return isinstance(errors, dict) and all(map(_is_number, errors.values()))


def _is_number(value: Any) -> bool:
    return type(value) in (int, float) and abs(value) <= sys.float_info.max


def _numbers(name: str, value: Any, count: int) -> tuple[float, ...]:
    if not (isinstance(value, list) and len(value) == count and all(map(_is_number, value))):
        what = 'a finite number' if count == 1 else f'{count} finite numbers'
        raise ValueError(f'{name}: expected {what}, got {reprlib.repr(value)}')
    return tuple(map(float, value))


def moved(pose: Pose, x: float, y: float) -> Pose:
    """Give the pose of a point of the object instead of its origin's."""
    sin, cos = math.sin(pose.angle), math.cos(pose.angle)
    return Pose(pose.x + cos * x - sin * y, pose.y + sin * x + cos * y, pose.angle)


def predict(pushes: Pushes, support: Support, mu_c: float, tilt: float = 0.0) -> Errors:
    """Predict every push and compare the final poses."""
    slider = Slider.on(pushes.outline, support, exact=True, tilt=tilt)
    x, y = support.centre
    path = slider.outline.path(pushes.tip_radius)
    position, angle = [], []
    for begin, end, (start, stop) in zip(pushes.starts, pushes.ends, pushes.ways, strict=True):
        pose = moved(begin, x, y)
        sigma, gap = clearance(pose, *start, path, pushes.tip_radius)
        theta = pose.angle + tangent_angle(sigma, path)
        back = min(gap, 0.0)
        shift = -math.sin(theta) * back, math.cos(theta) * back
        predicted = slider.pushed(
            pose,
            (start[0] + shift[0], start[1] + shift[1]),
            (stop[0] + shift[0], stop[1] + shift[1]),
            mu_c,
            pushes.tip_radius,
        )
        predicted = moved(predicted, -x, -y)
        position.append(math.hypot(predicted.x - end.x, predicted.y - end.y))
        angle.append(abs(math.remainder(predicted.angle - end.angle, 2.0 * math.pi)))
    return Errors(np.array(position), np.array(angle))


def fit(pushes: Pushes, progress: Progress) -> tuple[Errors, list[dict[str, float]]]:
    """Fit both numbers on either half of the pushes and predict the other half."""
    length = Support.uniform(pushes.outline, POINTS).c  # weighs angles against positions

    @cache
    def errors(spread: float, mu_c: float) -> Errors:
        return predict(pushes, Support.spread(pushes.outline, spread, POINTS), mu_c)

    most = largest_spread(pushes.outline)
    spreads = np.unique(np.minimum(SPREADS, most))

    half = np.arange(len(pushes.ways)) % 2
    grid = [(round(float(spread), 6), float(mu_c)) for spread in spreads for mu_c in FRICTIONS]
    task = progress.add_task(pushes.name, total=len(grid) + 2 * 8 * REFINEMENTS)
    chosen: list[tuple[float, float]] = []
    with ThreadPoolExecutor() as pool:

        def cost(points: Sequence[tuple[float, float]], fold: int) -> list[float]:
            losses = []
            for error in pool.map(lambda point: errors(*point), points):
                loss = error.position + length * error.angle
                losses.append(float(loss[half == fold].mean()))
                progress.advance(task)
            return losses

        for fold in (0, 1):
            losses = cost(grid, fold)
            best = grid[int(np.argmin(losses))]
            steps = np.array([SPREADS[1] - SPREADS[0], FRICTIONS[1] - FRICTIONS[0]])
            for _ in range(REFINEMENTS):
                steps /= 2.0
                around = [
                    (
                        round(min(max(best[0] + i * steps[0], 0.1), most), 6),
                        round(max(best[1] + j * steps[1], 0.0), 6),
                    )
                    for i in (-1, 0, 1)
                    for j in (-1, 0, 1)
                ]
                best = around[int(np.argmin(cost(around, fold)))]
            chosen.append(best)
    progress.update(task, completed=progress.tasks[task].total)
    first, second = (errors(*point) for point in chosen)
    # What was fitted on the pushes of one half predicts the other.
    fitted = Errors(
        np.where(half == 0, second.position, first.position),
        np.where(half == 0, second.angle, first.angle),
    )
    numbers = [
        {
            'spread': spread,
            'c_mm': 1000.0 * Support.spread(pushes.outline, spread, POINTS).c,
            'mu_c': mu_c,
        }
        for spread, mu_c in chosen
    ]
    return fitted, numbers


def fit_known(
    pushes: Pushes, support: Support, tilts: npt.NDArray[np.float64]
) -> tuple[Errors, list[dict[str, float]]]:
    """Fit mu_c and the tilt on either half of the pushes and predict the other half."""
    most = ExactLimitSurface(support).largest_tilt
    tilts = tilts[tilts <= most]
    grid = [(float(mu_c), float(tilt)) for mu_c in KNOWN_FRICTIONS for tilt in tilts]
    with ThreadPoolExecutor() as pool:
        errors = list(pool.map(lambda point: predict(pushes, support, *point), grid))
    half = np.arange(len(pushes.ways)) % 2
    losses = np.array([error.position + support.c * error.angle for error in errors])
    best = [int(np.argmin(losses[:, half == fold].mean(axis=1))) for fold in (0, 1)]
    first, second = (errors[i] for i in best)
    fitted = Errors(
        np.where(half == 0, second.position, first.position),
        np.where(half == 0, second.angle, first.angle),
    )
    return fitted, [{'mu_c': grid[i][0], 'tilt_mm': 1000.0 * grid[i][1]} for i in best]


def main() -> int:
    """Run the benchmark."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('directory', metavar='DIR', type=Path, help='folder of JSON files')
    parser.add_argument('--json', action='store_true', help='print one JSON object')
    options = parser.parse_args()
    files = sorted(options.directory.glob('*.json'))
    if not files:
        print(
            f'real_pushes: DIR: expected JSON files in {options.directory}, got none',
            file=sys.stderr,
        )
        return 2
    results: dict[str, dict[str, Any]] = {}
    try:
        everything = [read_pushes(file) for file in files]
        with Progress(console=Console(stderr=True)) as progress:
            for pushes in everything:
                fitted, numbers = fit(pushes, progress)
                nominal = predict(pushes, Support.uniform(pushes.outline, POINTS), NOMINAL_MU_C)
                results[pushes.name] = {
                    'pushes': len(pushes.ways),
                    'fitted': fitted.figures() | {'halves': numbers},
                    'nominal': nominal.figures(),
                    'published': pushes.published,
                }
                if pushes.support is not None:
                    for name, tilts in (('known', TILTS[:1]), ('known_tilt', TILTS)):
                        fitted, numbers = fit_known(pushes, pushes.support, tilts)
                        results[pushes.name][name] = fitted.figures() | {'halves': numbers}
    except (OSError, ValueError) as error:
        print(f'real_pushes: {error}', file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        return 130
    if options.json:
        print(json.dumps({'files': results}, indent=2))
    else:
        show(results)
    return 0


def show(results: dict[str, dict[str, Any]]) -> None:
    """Print a table of all errors."""
    table = Table('file', 'model', 'mean mm', 'mean °', 'median mm', 'median °')
    means: dict[str, list[dict[str, float]]] = {}
    for name, result in results.items():
        models = {'fitted, two-fold': result['fitted'], 'nominal': result['nominal']}
        models |= {title: result[key] for key, title in KNOWN.items() if key in result}
        models |= {f'published: {model}': errors for model, errors in result['published'].items()}
        for model, errors in models.items():
            means.setdefault(model, []).append(errors)
            table.add_row(name, model, *_cells(errors))
        table.add_section()
    for model, rows in means.items():
        if len(rows) == len(results):
            keys = set.intersection(*(set(row) for row in rows)) - {'halves'}
            table.add_row(
                'mean',
                model,
                *_cells({key: sum(row[key] for row in rows) / len(rows) for key in keys}),
            )
    Console().print(table)
    for name, result in results.items():
        halves = '; '.join(
            f'spread = {half["spread"]:.2f}, c = {half["c_mm"]:.1f} mm, mu_c = {half["mu_c"]:.3f}'
            for half in result['fitted']['halves']
        )
        print(f'{name}: {result["pushes"]} pushes; fitted on either half: {halves}')
        if 'known_tilt' in result:
            halves = '; '.join(
                f'tilt = {half["tilt_mm"]:.0f} mm, mu_c = {half["mu_c"]:.2f}'
                for half in result['known_tilt']['halves']
            )
            print(f'{name}: on the known support, fitted on either half: {halves}')


def _cells(errors: dict[str, float]) -> list[str]:
    keys = ('mean_mm', 'mean_deg', 'median_mm', 'median_deg')
    return [f'{errors[key]:.3f}' if key in errors else '' for key in keys]


if __name__ == '__main__':
    sys.exit(main())
