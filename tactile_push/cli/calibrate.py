# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""`tactile_push calibrate`: touches at known places make the parameters of a sensor's node."""

import argparse
import json
import math
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from tactile_push.cli.arguments import Commands, Refused, number, picture
from tactile_push.interface import CAMERA, CAMERA_SENSOR, FORCE_TORQUE, WRENCH_SENSOR

if TYPE_CHECKING:
    from tactile_push.calibration.camera_images import TouchImages
    from tactile_push.calibration.touch_table import KnownTouch
    from tactile_push.tactile.sphere import Array

SENSORS = (CAMERA, FORCE_TORQUE)
THRESHOLD = 12.0  # as the node has it


def add(commands: Commands) -> None:
    """Add the command."""
    calibrate = commands.add_parser(
        'calibrate',
        help='calibrate the sensor in a finger tip from touches at known places',
        description='Fits the model of the camera in a hemispherical finger tip, or centre and '
        'radius of a tip on a force/torque sensor, to touches at known places. Prints how well it '
        'explains them, draws that, and writes the parameter file that camera_sensor or '
        'wrench_sensor loads. Exit status: 0 done, 1 the touches are too few or badly spread, or '
        'nothing explains them, 2 bad input.',
    )
    option = calibrate.add_argument
    option('sensor', choices=SENSORS, help='what is in the tip or under it')
    option(
        'source',
        type=Path,
        nargs='?',
        metavar='FOLDER|BAG',
        help='folder of images with a table touches.csv, or a bag of images or wrenches: first of '
        'the untouched tip, then of one touch after the other (default: ask on the terminal for '
        'one touch after the other, and keep them in the bag touches_ and the date)',
    )
    option(
        '--topic',
        metavar='NAME',
        help='topic on which the sensor publishes while touches are asked for (default: image or '
        'wrench)',
    )
    option(
        '--touches',
        type=Path,
        metavar='FILE',
        help='table of the touches in a bag, in their order: CSV with the columns azimuth_deg, '
        'elevation_deg and perhaps normal_force (default: touches.csv in the folder of the bag)',
    )
    option(
        '--threshold',
        type=number('1 to 255', 1.0, 255.0),
        default=THRESHOLD,
        metavar='N',
        help=f'change of brightness that counts, of 255 (default: {THRESHOLD:g})',
    )
    degrees = number('degrees from -360 to 360', -360.0, 360.0)
    option(
        '--tip-rpy-deg',
        type=degrees,
        nargs=3,
        default=(0.0, 0.0, 0.0),
        metavar=('R', 'P', 'Y'),
        help="roll, pitch and yaw of the tip in the force/torque sensor's frame (default: 0 0 0)",
    )
    option(
        '-o',
        '--out',
        type=Path,
        metavar='FILE',
        help='parameter file to write, in place of an older one (default: camera_sensor.yaml or '
        'wrench_sensor.yaml)',
    )
    option(
        '--plot',
        type=picture,
        metavar='FILE',
        help='draw the touches and their errors; the ending chooses the format (default: the name '
        'of the parameter file with .png)',
    )
    option('--json', action='store_true', help='print the result as one JSON object in SI units')
    calibrate.set_defaults(run=_calibrate)


class _Calibrated(NamedTuple):
    """What a calibration gave."""

    node: str  # that loads it
    values: dict[str, object]  # of its parameters
    touches: 'list[KnownTouch]'
    names: list[str]  # of the touches
    errors: 'Array'  # of each [rad]
    draw: Callable[[Path], None]
    remarks: list[str]


def _calibrate(options: argparse.Namespace) -> int:
    from tactile_push.needs_opencv import opencv_is_missing

    if options.sensor == CAMERA and opencv_is_missing('tactile_push calibrate', 'cv2', 'scipy'):
        return 2
    from tactile_push.bags.disk import write_whole
    from tactile_push.calibration.parameter_file import parameter_file
    from tactile_push.cli.output import naming

    if options.source is None:
        from tactile_push.cli.ask_touches import ask_touches

        options.source = ask_touches(options.sensor, options.topic, options.threshold)
    elif options.topic is not None:
        raise Refused('--topic: expected no FOLDER|BAG beside it')
    done = (_camera if options.sensor == CAMERA else _wrench)(options)
    out = options.out or Path(f'{done.node}.yaml')
    plot = options.plot or out.with_suffix('.png')
    remarks = [_residuals(done), *done.remarks]
    source = f'Written by `tactile_push calibrate` from {len(done.names)} touches.'
    write_whole(out, parameter_file(done.node, done.values, [source, *remarks]))
    with naming(plot, '--plot'):
        done.draw(plot)
    if options.json:
        print(json.dumps(_as_json(done, [out, plot])))
    else:
        print(*remarks, out, plot, sep='\n')
    return 0


def _camera(options: argparse.Namespace) -> _Calibrated:
    from tactile_push.calibration.camera_calibration import calibrate_camera
    from tactile_push.calibration.picture import draw_camera
    from tactile_push.parameters.camera_sensor import calibrated_values

    images = _images(options)
    try:
        found = calibrate_camera(images, options.threshold)
    except ValueError as error:
        raise Refused(error, status=1) from None
    values = calibrated_values(found.fit.camera, found.reach, found.rim, found.force_scale)
    return _Calibrated(
        CAMERA_SENSOR,
        {**values, 'threshold': options.threshold, **_frame(images.frame)},
        *(found.touches, found.names, found.fit.errors),
        lambda plot: draw_camera(found, images.reference, plot),
        [],
    )


def _images(options: argparse.Namespace) -> 'TouchImages':
    from tactile_push.calibration.bag_images import images_in_bag
    from tactile_push.calibration.camera_images import images_in_folder
    from tactile_push.calibration.touch_table import TABLE
    from tactile_push.cli.output import naming, opened, warner

    folder = options.source
    if options.touches is None and (folder / TABLE).exists() and not any(folder.glob('*.mcap')):
        with naming(folder):
            try:
                return images_in_folder(folder)
            except ValueError as error:
                raise Refused(error) from None
    table = _table(options, f'a folder with {TABLE}, or a bag')
    with opened(folder, warner('calibrate')) as bag, naming(table, '--touches'):
        return images_in_bag(bag, table, options.threshold)


def _wrench(options: argparse.Namespace) -> _Calibrated:
    from tactile_push.calibration.bag_wrenches import wrenches_in_bag
    from tactile_push.calibration.picture import draw_tip
    from tactile_push.calibration.wrench_fit import fit_tip
    from tactile_push.cli.output import naming, opened, warner
    from tactile_push.tactile import WrenchSensing
    from tactile_push.tactile.sphere import directions_of

    table = _table(options, 'a bag')
    with opened(options.source, warner('calibrate')) as bag, naming(table, '--touches'):
        found = wrenches_in_bag(bag, table)
    rpy = tuple(math.radians(angle) for angle in options.tip_rpy_deg)
    axes = WrenchSensing(1.0, (0.0, 0.0, 0.0), rpy).axes
    known = directions_of(
        [touch.azimuth for touch in found.touches], [touch.elevation for touch in found.touches]
    )
    try:
        fit = fit_tip(found.forces, found.moments, known, axes)
    except ValueError as error:
        raise Refused(error, status=1) from None
    return _Calibrated(
        WRENCH_SENSOR,
        {
            'tip_radius': fit.radius,
            'tip_xyz': fit.centre.tolist(),
            'tip_rpy': list(rpy),
            'reaction': fit.reaction,
            **_frame(found.frame),
        },
        *(found.touches, [f'touch {1 + k}' for k in range(len(known))], fit.errors),
        lambda plot: draw_tip(fit, found.touches, plot),
        [f'radius {1e3 * fit.radius:.2f} ± {1e3 * fit.radius_deviation:.2f} mm'],
    )


def _frame(frame: str) -> dict[str, str]:
    """Return the parameter by which a node knows its sensor, if there is something to know."""
    return {'calibrated_frame': frame} if frame else {}


def _table(options: argparse.Namespace, source: str) -> Path:
    """Return the table of the touches in a bag."""
    from tactile_push.calibration.touch_table import TABLE

    table: Path = options.touches or options.source / TABLE
    if options.touches is None and not table.exists():
        raise Refused(f'{options.source}: expected {source} and --touches')
    return table


def _residuals(done: _Calibrated) -> str:
    from tactile_push.calibration.residuals import rms

    worst = int(done.errors.argmax())
    largest = f'{math.degrees(done.errors[worst]):.2f}° ({done.names[worst]})'
    return f'RMS {math.degrees(rms(done.errors)):.2f}°, largest residual {largest}'


def _as_json(done: _Calibrated, files: list[Path]) -> dict[str, Any]:
    from tactile_push.calibration.residuals import rms

    return {
        'rms': rms(done.errors),
        'largest': float(done.errors.max()),
        'touches': [
            {'name': name, 'azimuth': touch.azimuth, 'elevation': touch.elevation, 'error': error}
            for name, touch, error in zip(
                done.names, done.touches, done.errors.tolist(), strict=True
            )
        ],
        'parameters': done.values,
        'files': [str(file) for file in files],
    }
