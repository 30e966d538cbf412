# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What touches at known places say about the signs of azimuth and elevation."""

import math
from collections.abc import Iterator, Mapping, Sequence
from statistics import median

from tactile_push.doctor.finding import MISSING, RIGHT, WRONG, Finding
from tactile_push.interface import CAMERA_SENSOR, SENSOR_DRIVER, TACTILE, WRENCH_SENSOR

LEFT, RIGHT_OF_POLE, ABOVE, NOTHING = 'left', 'right', 'above', 'nothing'
TOUCHES = {
    LEFT: 'touch the tip near its pole, a little to the left of it, seen from above',
    RIGHT_OF_POLE: 'touch it a little to the right of the pole',
    ABOVE: 'touch it a little above the pole',
    NOTHING: 'touch nothing',
}
"""What to do for each touch; the pole is the foremost point of the tip."""

DIRECTIONS = {LEFT: 0.0, RIGHT_OF_POLE: math.pi, ABOVE: math.pi / 2.0}  # azimuths [rad]
COARSE = math.radians(30.0)  # by so much a finger misses the place that it is to touch; picked
HALF_WAY = math.radians(45.0)  # elevation between the equator and the pole
BEYOND = 0.1  # angle by which a reading in radians cannot leave its range [rad]

# What to do in each sensor node about an azimuth that counts from another direction, and about one
# that counts the other way round or an elevation from the other end.
TURNED = {
    WRENCH_SENSOR: 'turn tip_rpy of wrench_sensor by {} about z_tip (the yaw if roll and pitch are '
    '0)',
    CAMERA_SENSOR: 'calibrate the camera anew (tactile_push calibrate camera), with the directions '
    'of the touches as docs/conventions.md has them',
}
OTHERWISE = {
    SENSOR_DRIVER: 'let the microcontroller send {}',
    WRENCH_SENSOR: 'let the driver of the force/torque sensor give right-handed axes, and check '
    'tip_rpy and reaction of wrench_sensor; needed is {}',
    CAMERA_SENSOR: 'calibrate the camera anew (tactile_push calibrate camera), unmirrored; needed '
    'is {}',
}
FOREIGN = 'let the sensor publish {}'
UNTOUCHED = {
    SENSOR_DRIVER: "raise the microcontroller's threshold of a contact",
    WRENCH_SENSOR: 'call wrench_sensor/tare, or raise contact_force of wrench_sensor',
    CAMERA_SENSOR: 'call camera_sensor/take_reference, or raise threshold of camera_sensor',
}
UNFELT = {
    WRENCH_SENSOR: 'touch harder, or lower contact_force of wrench_sensor',
    CAMERA_SENSOR: 'touch harder, or lower threshold of camera_sensor',
}


def touch_findings(
    touches: Mapping[str, Sequence[tuple[float, float]]], sensor: str
) -> Iterator[Finding]:
    """Judge the signs of a sensor by four touches.

    Parameters
    ----------
    touches : mapping of str to sequence of tuple
        Azimuth and elevation of the readings during each of `TOUCHES` [rad], NaN without a contact.
    sensor : str
        Node that publishes them, '' if nobody does.

    Yields
    ------
    Finding
        What is right or wrong, and where to mend it.
    """
    silent = [name for name in TOUCHES if not touches[name]]
    if silent:
        yield Finding(
            *(MISSING, TACTILE, f'no readings at the touch {", ".join(silent)}'),
            f'start {sensor or "the sensor"}, and ask the doctor without --touches',
        )
        return
    felt = {name: _felt(touches[name]) for name in TOUCHES}
    if felt[NOTHING] is None:
        yield Finding(RIGHT, TACTILE, 'tells of no contact while nothing touches the tip')
    else:
        remedy = UNTOUCHED.get(sensor, 'publish NaN without a contact')
        yield Finding(WRONG, TACTILE, 'tells of a contact while nothing touches the tip', remedy)
    unfelt = [name for name in DIRECTIONS if felt[name] is None]
    if unfelt:
        remedy = UNFELT.get(sensor, 'touch harder, or let the sensor feel less')
        words = f'tells of no contact at the touch {", ".join(unfelt)}'
        yield Finding(WRONG, TACTILE, words, remedy)
        return
    places = [felt[name] for name in DIRECTIONS]
    yield from _judged([place for place in places if place is not None], sensor)


def _felt(readings: Sequence[tuple[float, float]]) -> tuple[float, float] | None:
    """Return mean azimuth and elevation, None if most readings tell of no contact."""
    contacts = [(a, e) for a, e in readings if math.isfinite(a) and math.isfinite(e)]
    if 2 * len(contacts) < len(readings):
        return None
    if max(abs(a) for a, _ in contacts) > math.pi + BEYOND:
        azimuth = median(a for a, _ in contacts)
    else:
        x = sum(math.cos(a) for a, _ in contacts)
        azimuth = math.atan2(sum(math.sin(a) for a, _ in contacts), x)
    return azimuth, median(e for _, e in contacts)


def _judged(places: Sequence[tuple[float, float]], sensor: str) -> Iterator[Finding]:
    """Judge what was felt on the left, on the right and above."""
    azimuths, elevations = [a for a, _ in places], [e for _, e in places]
    otherwise = OTHERWISE.get(sensor, FOREIGN)
    if max(map(abs, azimuths)) > math.pi + BEYOND or not all(
        -BEYOND <= e <= math.pi / 2.0 + BEYOND for e in elevations
    ):
        words = f'azimuth {azimuths[0]:.3g} and elevation {elevations[0]:.3g} are no radians of a '
        needed = 'radians: azimuth from -pi to pi, elevation from 0 to pi/2'
        yield Finding(WRONG, TACTILE, f'{words}hemisphere', otherwise.format(needed))
        return
    yield _azimuth(azimuths, sensor)
    shown = ', '.join(f'{math.degrees(e):.0f}°' for e in elevations)
    if all(e > HALF_WAY for e in elevations):
        yield Finding(RIGHT, 'elevation', f'{shown} near the pole, whose elevation is 90°')
    elif all(e < HALF_WAY for e in elevations):
        needed = '90° less this elevation'
        words = f'{shown} near the pole: it counts from the wrong end'
        yield Finding(WRONG, 'elevation', words, otherwise.format(needed))
    else:
        yield Finding(
            *(WRONG, 'elevation', f'{shown}: not all touches were near the pole'),
            'touch the tip again, nearer to its foremost point',
        )


def _azimuth(azimuths: Sequence[float], sensor: str) -> Finding:
    """Judge azimuths on the left, on the right and above."""
    shown = ', '.join(
        f'{math.degrees(a):.0f}° {n}' for n, a in zip(DIRECTIONS, azimuths, strict=True)
    )
    for sign in (1.0, -1.0):
        # The azimuth is sign (true azimuth) + offset.
        offsets = [a - sign * d for a, d in zip(azimuths, DIRECTIONS.values(), strict=True)]
        offset = math.atan2(sum(map(math.sin, offsets)), sum(map(math.cos, offsets)))
        if max(abs(math.remainder(o - offset, 2.0 * math.pi)) for o in offsets) < COARSE:
            break
    else:
        words = f'{shown}: no three such touches have these'
        return Finding(WRONG, 'azimuth', words, 'touch the tip again, as it was asked for')
    degrees = round(math.degrees(offset))
    if sign > 0.0 and abs(offset) < COARSE:
        return Finding(RIGHT, 'azimuth', shown)
    if sign > 0.0:
        remedy = TURNED.get(sensor, OTHERWISE.get(sensor, FOREIGN))
        needed = f'{degrees}°' if sensor in TURNED else f'this azimuth less {degrees}°'
        return Finding(WRONG, 'azimuth', f'{shown}: it is off by {degrees}°', remedy.format(needed))
    exchanged = abs(math.remainder(offset - math.pi, 2.0 * math.pi)) < COARSE
    fault = 'left and right are exchanged' if exchanged else 'it counts the wrong way round'
    needed = f'{180 if exchanged else degrees}° less this azimuth'
    if abs(offset) < COARSE:
        needed = 'the azimuth with the other sign'
    remedy = OTHERWISE.get(sensor, FOREIGN).format(needed)
    return Finding(WRONG, 'azimuth', f'{shown}: {fault}', remedy)
