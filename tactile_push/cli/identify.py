# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""`tactile_push identify`: what measured pushes say of the object."""

import argparse
import json
import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

from tactile_push.cli.arguments import Commands, Refused, picture, topic
from tactile_push.interface import ACTIVE_SENSING, MUJOCO_PLANT, SIM_PLANT, TRUE_POSE

if TYPE_CHECKING:
    from tactile_push.identification.identify import Identified
    from tactile_push.identification.records import Pushes
    from tactile_push.simulation import ObjectFile


def add(commands: Commands) -> None:
    """Add the command."""
    identify = commands.add_parser(
        'identify',
        help='find support, friction and centre of friction of an object from measured pushes',
        description='Fits how far the load under an object is spread, where its centre of friction '
        'is and the friction at the finger to measured pushes. Says how well the pushes tell them, '
        'how well they predict pushes that they do not know, and which records are bad. Exit '
        'status: 0 done, 1 the pushes leave one of the numbers open, 2 bad input.',
    )
    option = identify.add_argument
    option(
        'data',
        nargs='+',
        type=Path,
        metavar='DATA',
        help='JSON files of pushes of one object, or bags with poses of it',
    )
    option(
        '--outline',
        type=Path,
        metavar='FILE',
        help='object file with the outline and perhaps the support; bags need it (default: as the '
        'first JSON file has them)',
    )
    option(
        '--pose',
        type=topic,
        metavar='TOPIC',
        help="topic of the object's poses in bags, in finger_disk or finger_base (default: "
        f'{TRUE_POSE}; of several fingers the one in its namespace counts)',
    )
    option(
        '-o',
        '--out',
        type=Path,
        metavar='FILE',
        help='object file to write, for simulate',
    )
    option(
        '--params',
        type=Path,
        metavar='FILE',
        help='parameter file to write, for active_sensing and the plants, mujoco_plant unless the '
        'support was known',
    )
    option(
        '--plot',
        type=picture,
        metavar='FILE',
        help='draw measured against predicted motions; the ending chooses the format',
    )
    option('--json', action='store_true', help='print the result as one JSON object in SI units')
    identify.set_defaults(run=_identify)


def _identify(options: argparse.Namespace) -> int:
    from tactile_push.needs_opencv import opencv_is_missing

    if opencv_is_missing('tactile_push identify', 'scipy'):
        return 2
    from rich.console import Console

    from tactile_push.bags.disk import write_whole
    from tactile_push.cli.output import naming, plain, warner
    from tactile_push.identification.identify import identify
    from tactile_push.identification.object_file import object_content

    outline, pushes = _read(options)
    with Console(stderr=True).status('fitting'):
        try:
            found = identify(pushes)
        except ValueError as error:
            raise Refused(error) from None
    warn = warner('identify')
    for bad in found.pushes.bad:
        warn(f'{bad.name} is left out: {bad.reason}')
    _check_told(found)
    if options.params is not None:
        _write_parameters(found, options.params)
    files = [file for file in (options.out, options.params, options.plot) if file is not None]
    if options.out is not None:
        with naming(options.out, '--out'):
            text = json.dumps(object_content(outline, found), indent=2)
            write_whole(options.out, f'{text}\n')
    if options.plot is not None:
        from tactile_push.identification.picture import draw_pushes  # which loads matplotlib

        with naming(options.plot, '--plot'):
            draw_pushes(found, options.plot)
    if options.json:
        print(json.dumps(plain({**_as_json(found), 'files': files})))
    else:
        print(*_lines(found), *files, sep='\n')
    return 0


def _read(options: argparse.Namespace) -> 'tuple[dict[str, Any], Pushes]':
    """Return the outline as its file has it, and all pushes."""
    from tactile_push.cli.output import naming
    from tactile_push.identification.records import merged, pushes_of
    from tactile_push.simulation import object_of, read_json

    try:
        known: ObjectFile | None = None
        outline: dict[str, Any] = {}
        with naming(options.outline, '--outline'):
            if options.outline is not None:
                outline = read_json(options.outline)
                known = object_of(outline, options.outline)
        parts = []
        for data in options.data:
            if _is_bag(data):
                parts.append(_in_bag(data, known, options.pose))
                continue
            with naming(data):
                content = read_json(data)
                parts.append(pushes_of(content, data, known))
                outline = outline or content
        return outline['outline'], merged(parts)
    except ValueError as error:
        raise Refused(error) from None


def _is_bag(data: Path) -> bool:
    return data.is_dir() or data.suffix in ('.mcap', '.yaml')


def _in_bag(bag: Path, known: 'ObjectFile | None', topic: str | None) -> 'Pushes':
    from tactile_push.cli.output import opened, warner
    from tactile_push.identification.bag_pushes import pushes_in_bag

    if known is None:
        raise Refused(f'{bag}: expected --outline FILE, as a bag has no outline')
    with opened(bag, warner('identify')) as reader:
        return pushes_in_bag(reader, known, topic)


def _write_parameters(found: 'Identified', file: Path) -> None:
    from tactile_push.bags.disk import write_whole
    from tactile_push.calibration.parameter_file import parameter_file
    from tactile_push.cli.output import naming
    from tactile_push.identification.object_file import (
        mujoco_plant_values,
        plant_values,
        sensing_values,
    )

    try:
        values = {SIM_PLANT: plant_values(found), ACTIVE_SENSING: sensing_values(found)}
        if not math.isnan(found.fit.physics.spread):
            values[MUJOCO_PLANT] = mujoco_plant_values(found)
    except ValueError as error:
        raise Refused(f'--params: {error}') from None
    remark = f'Written by `tactile_push identify` from {len(found.pushes.pushes)} pushes.'
    with naming(file, '--params'):
        texts = [parameter_file(node, values[node], []) for node in values]
        write_whole(file, ''.join([f'# {remark}\n', *texts]))


def _check_told(found: 'Identified') -> None:
    """Fail if the pushes leave open what the object rests on, or the only number."""
    values, open_ = found.fit.values, found.fit.open
    if len(open_) == len(values) or not set(open_) <= {'mu_c'}:
        raise Refused(
            f'pushes: expected some that tell {", ".join(values)}, got '
            f'{len(found.pushes.pushes)} that leave {", ".join(open_)} open',
            status=1,
        )


def _lines(found: 'Identified') -> list[str]:
    fit, deviations, pushes = found.fit, found.fit.deviations, found.pushes
    used = len(pushes.pushes)
    lines = [f'pushes   {used} of {used + len(pushes.bad)}']
    if 'c' in fit.values:
        c, of = 1e3 * fit.values['c'], 1e3 * deviations['c']
        lines.append(f'c        {c:.2f} ± {of:.2f} mm (spread {fit.physics.spread:.2f})')
    if fit.open:
        lines.append('mu_c     open, as no push slips')
    else:
        lines.append(f'mu_c     {fit.values["mu_c"]:.3f} ± {deviations["mu_c"]:.3f}')
    if 'x' in fit.values:
        x, y = (f'{1e3 * fit.values[axis]:+.2f} ± {1e3 * deviations[axis]:.2f} mm' for axis in 'xy')
        lines.append(f'centre   x {x}, y {y} from the centroid')
    for name, errors in (('errors', found.errors), ('nominal', found.nominal)):
        figures = errors.figures()
        force = ''
        if 'mean_force_deg' in figures:
            force = f', force {figures["mean_force_deg"]:.1f}°'
        lines.append(f'{name:9}{figures["mean_mm"]:.2f} mm, {figures["mean_deg"]:.2f}°{force}')
    return lines


def _as_json(found: 'Identified') -> dict[str, Any]:
    return {
        'pushes': len(found.pushes.pushes),
        'bad': [bad._asdict() for bad in found.pushes.bad],
        'values': found.fit.values,
        'standard_deviations': found.fit.deviations,
        'covariance': found.fit.covariance.tolist(),
        'with_noise_alone': found.fit.bound,
        'errors': found.errors.figures(),
        'nominal': found.nominal.figures(),
    }
