# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Predict measured pushes from the outline and a few fitted numbers, without any force data.

    python benchmarks/real_pushes.py PATH ... [--json]

PATH is a JSON file of pushes or a folder of them: `outline` as `tactile_push simulate --object`
takes it, `tip_radius` [m], and `pushes`, each with `tip_start`, `tip_end` [x, y in m],
`object_start` and `object_end` [x, y in m, yaw in rad] in one fixed frame. `published` and
`object_did_not_move_baseline`, if they are there, are shown beside the errors.

The object slides on the exact limit surface of a load between the centroid and the corners: one
number says how far it is spread (`Support.spread`), and so its c. The other number is mu_c. Both
are fitted on one half of a file's pushes, every second one, and tried on the other half, and the
other way round: every push is predicted by numbers that do not know it. One more fit, in the same
way, has where the centre of friction is, as two more numbers: the pressure is tilted so that it
lies there (`Support.carrying`). A prior keeps it at the centroid, with a standard deviation of a
tenth of c. `nominal` has nothing fitted: uniform pressure and mu_c = 0.25. Files are read and
numbers are fitted as by `tactile_push identify`, but no record is left out.

A file may have the `support` on which the object rested, `points` [m] and `loads`. Without loads
they are those of statics, under `centre_of_mass` or else the outline's centroid. A further
prediction then has these loads and fits mu_c alone, and one more fits mu_c and the tilt of a push
above the support (`ExactLimitSurface`), both on one half for the other.

If every push has a `force`, the mean force on the object over the last 60 % of the contact [N], the
angle between it and the predicted one is shown. No force is used in a fit.

For each file the standard deviations of c, mu_c and the centre of friction are shown as the scatter
of the residuals gives them, and as they would be at least, by the bound of Cramér and Rao, if all
that is left were noise.

The measured poses at the start of a push overlap by up to 2 mm in places. There the finger's way is
moved out of the object along the contact normal: as if the offset were one of measurement, and
stayed.
"""

import argparse
import json
import reprlib
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from rich.console import Console
from rich.progress import Progress
from rich.table import Table

from tactile_push.identification.fitting import Fit, Fitter
from tactile_push.identification.identify import crosswise, halves_of
from tactile_push.identification.models import Model, known_support, nominal, unknown_support
from tactile_push.identification.predicting import errors_of, residuals
from tactile_push.identification.records import Pushes, pushes_of
from tactile_push.simulation.object_files import are_numbers, read_json

DEVIATIONS = '    {what}: c ±{c_mm:.1f} mm, mu_c ±{mu_c:.3f}, x ±{x_mm:.1f} mm, y ±{y_mm:.1f} mm'
WIDTH = 120  # of a table that is no terminal's
MODELS = {
    'fitted': 'c, mu_c',
    'centre': 'c, mu_c, centre',
    'nominal': 'nominal',
    'known': 'support known; mu_c',
    'known_tilt': 'support known; mu_c, tilt',
}
CELLS = (
    *('mean_mm', 'mean_deg', 'mean_force_deg'),
    *('median_mm', 'median_deg', 'median_force_deg'),
)
NUMBERS = {
    'spread': 'spread {:.2f}',
    'c_mm': 'c {:.1f} mm',
    'mu_c': 'mu_c {:.3f}',
    'x_mm': 'x {:+.1f} mm',
    'y_mm': 'y {:+.1f} mm',
    'tilt_mm': 'tilt {:.1f} mm',
}


class MeasuredFile(NamedTuple):
    """A file of pushes, and the errors that others published for it."""

    name: str
    pushes: Pushes
    published: dict[str, Any]


def main() -> int:
    """Run the benchmark."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('paths', metavar='PATH', nargs='+', type=Path, help='JSON file or folder')
    parser.add_argument('--json', action='store_true', help='print one JSON object')
    options = parser.parse_args()
    results: dict[str, dict[str, Any]] = {}
    try:
        everything = [read_measured(file) for file in _files(options.paths)]
        with Progress(console=Console(stderr=True)) as progress:
            for measured in everything:
                task = progress.add_task(measured.name, total=len(models_of(measured.pushes)))
                results[measured.name] = evaluated(
                    measured, lambda task=task: progress.advance(task)
                )
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


def _files(paths: list[Path]) -> list[Path]:
    """Return the files that paths name; files of one name would be one in the results."""
    files = []
    for path in paths:
        inside = sorted(path.glob('*.json')) if path.is_dir() else [path]
        if not inside:
            raise ValueError(f'PATH: expected JSON files in {path}, got none')
        files += inside
    names = [file.stem for file in files]
    for name in names:
        if names.count(name) > 1:
            raise ValueError(f'PATH: expected files of different names, got two of {name}')
    return files


def read_measured(file: Path) -> MeasuredFile:
    """Read a file, all of whose records must be pushes, and two or more."""
    content = read_json(file)
    pushes = pushes_of(content, file)
    if pushes.bad:
        raise ValueError(': '.join(pushes.bad[0]))
    if len(pushes.pushes) < 2:
        raise ValueError(f'{file}: pushes: expected two or more, got {len(pushes.pushes)}')
    published = content.get('published', {})
    if 'object_did_not_move_baseline' in content and isinstance(published, dict):
        published = published | {'object did not move': content['object_did_not_move_baseline']}
    if not isinstance(published, dict) or not all(map(_are_errors, published.values())):
        raise ValueError(
            f'{file}: published: expected an object of errors for every model, got '
            f'{reprlib.repr(published)}'
        )
    return MeasuredFile(file.stem, pushes, published)


def _are_errors(errors: Any) -> bool:
    return isinstance(errors, dict) and are_numbers(list(errors.values()))


def models_of(pushes: Pushes) -> dict[str, Model]:
    """Return what is fitted, by the names of `MODELS`."""
    models = {
        'fitted': unknown_support(pushes.outline, centre=False),
        'centre': unknown_support(pushes.outline),
    }
    if pushes.support is not None:
        models |= {
            'known': known_support(pushes.support),
            'known_tilt': known_support(pushes.support, tilt=True),
        }
    return models


def evaluated(measured: MeasuredFile, advance: Callable[[], None]) -> dict[str, Any]:
    """Return the errors of all models for a file of pushes, with what was fitted on its halves."""
    pushes = measured.pushes
    result: dict[str, Any] = {'pushes': len(pushes.pushes), 'published': measured.published}
    result['nominal'] = errors_of(residuals(pushes, nominal(pushes.outline))).figures()
    for name, model in models_of(pushes).items():
        fitter = Fitter(model, pushes, forces=False)
        first, second = (fitter.fit(half) for half in halves_of(pushes))
        result[name] = errors_of(crosswise(pushes, (first, second))).figures()
        result[name]['halves'] = [_numbers(fit) for fit in (first, second)]
        if name == 'centre':
            everything = fitter.judged(first.numbers, range(len(pushes.pushes)))
            result['standard_deviations'] = _in_mm(everything.deviations)
            result['with_noise_alone'] = _in_mm(everything.bound)
        advance()
    return result


def _numbers(fit: Fit) -> dict[str, float]:
    """Return what was fitted, and the spread if it was."""
    spread = {} if np.isnan(fit.physics.spread) else {'spread': fit.physics.spread}
    return {**_in_mm(fit.values), **spread}


def _in_mm(values: dict[str, float]) -> dict[str, float]:
    """Return values with lengths in millimetres."""
    return {
        name if name == 'mu_c' else f'{name}_mm': value if name == 'mu_c' else 1000.0 * value
        for name, value in values.items()
    }


def show(results: dict[str, dict[str, Any]]) -> None:
    """Print a table of all errors, their means over files, and what was fitted."""
    table = Table('file', 'fitted', 'mean mm', '°', 'force °', 'median mm', '°', 'force °')
    of_model: dict[str, list[dict[str, float]]] = {}
    for name, result in results.items():
        models = {title: result[key] for key, title in MODELS.items() if key in result}
        models |= {f'published: {model}': errors for model, errors in result['published'].items()}
        for model, errors in models.items():
            of_model.setdefault(model, []).append(errors)
            table.add_row(name, model, *_cells(errors))
        table.add_section()
    for model, rows in of_model.items():
        means = {
            key: sum(row[key] for row in rows) / len(rows)
            for key in CELLS
            if all(key in row for row in rows)
        }
        table.add_row(f'mean of {len(rows)}', model, *_cells(means))
    Console(width=None if sys.stdout.isatty() else WIDTH).print(table)
    for name, result in results.items():
        print(f'{name}: {result["pushes"]} pushes')
        for key, title in MODELS.items():
            for half in result.get(key, {}).get('halves', ()):
                numbers = (form.format(half[k]) for k, form in NUMBERS.items() if k in half)
                print(f'    {title}, on one half: {", ".join(numbers)}')
        for key, what in (
            ('standard_deviations', 'standard deviations'),
            ('with_noise_alone', 'with noise alone'),
        ):
            print(DEVIATIONS.format(what=what, **result[key]))


def _cells(errors: dict[str, float]) -> list[str]:
    return [f'{errors[key]:.3f}' if key in errors else '' for key in CELLS]


if __name__ == '__main__':
    sys.exit(main())
