# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The parameters of `camera_sensor`, and the finder of contacts in images that they make."""

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from tactile_push.parameters import shared
from tactile_push.parameters.parameter import NodeParameters, parameter
from tactile_push.tactile.dome_camera import DomeCamera
from tactile_push.tactile.rim import SECTORS, RimProfile

if TYPE_CHECKING:
    from tactile_push.tactile.image_contact import ImageContactFinder, ImageContactSettings

RAW, COMPRESSED = TRANSPORTS = ('raw', 'compressed')  # the names of ROS' image_transport
NO_RIM = [0.0]


@dataclass(frozen=True)
class CameraSensorParameters(NodeParameters):
    """The calibrated camera, what counts as a contact, and how long it may be silent."""

    # fmt: off
    image_width: int = parameter(0, 'px',
        'width of the calibrated images; 0 is a camera that is not calibrated', 0, 20000,
        read_only=True)
    image_height: int = parameter(0, 'px',
        'height of the calibrated images', 0, 20000, read_only=True)
    centre: list[float] = parameter([0.0, 0.0], 'px',
        'column and row where the optical axis meets the image', read_only=True)
    rotation: list[float] = parameter([math.pi, 0.0, 0.0], 'rad',
        "azimuth of the image's right, then the tilts about its right and its lower edge",
        read_only=True)
    radial: list[float] = parameter([0.0, 0.0, 0.0], 'px',
        'distance from the centre over the angle off the optical axis, its third and its fifth '
        'power', read_only=True)
    eye: list[float] = parameter([0.0, 0.0, -1.0], 'radii',
        "where the camera looks from, in the axes of the tip, from the dome's centre",
        read_only=True)
    reach: float = parameter(math.pi / 2.0, 'rad',
        'largest angle between the pole and a calibrated touch; contacts further out are refused',
        0.01, 1.6, read_only=True)
    rim: list[float] = parameter(NO_RIM, 'levels',
        f'brightness along the rim when calibrated, in {SECTORS} sectors of azimuth from -pi on; '
        'a single 0 if it is not known', read_only=True)
    rim_elevations: list[float] = parameter(NO_RIM, 'rad',
        'where the tip ended in the image when calibrated, in the same sectors: elevations, '
        'pi/2 where nothing was seen; a single 0 if it is not known', read_only=True)
    force_scale: float = parameter(0.0, 'N/sr^1.5',
        "normal force over the 3/2 power of the contact's area; 0 measures no force", 0.0, 1e9)
    threshold: float = parameter(12.0, 'levels',
        'change of brightness that counts; there are 256', 1.0, 255.0)
    least_area: float = parameter(0.002, 'sr',
        "smallest contact, as an area seen from the dome's centre", 1e-5, 1.0)
    follow_time: float = parameter(60.0, 's',
        'time in which the reference follows a change of the untouched tip; 0 never follows',
        0.0, 1e6)
    reference_at_start: bool = parameter(False, '',
        'take the first images after activation for those of the untouched tip', read_only=True)
    image_transport: str = parameter(RAW, '',
        'which images to take: image, or image/compressed', choices=TRANSPORTS, read_only=True)
    calibrated_frame: str = shared.calibrated_frame
    silence_timeout: float = parameter(0.3, 's',
        'this long without an image is an error, by the steady clock', 0.01, 60.0)
    autostart: bool = shared.autostart
    # fmt: on


def make_image_finder(p: CameraSensorParameters) -> 'ImageContactFinder':
    """Make a finder that has no reference yet.

    Raises
    ------
    ValueError
        If the camera is not calibrated, or the calibration is none.
    """
    from tactile_push.tactile.image_contact import ImageContactFinder  # needs OpenCV

    if not (p.image_width and p.image_height):
        raise ValueError(
            'image_width: expected the file that `tactile_push calibrate` writes, got no '
            'calibration'
        )
    for name, count in (('centre', 2), ('rotation', 3), ('radial', 3), ('eye', 3)):
        values = getattr(p, name)
        if not (len(values) == count and all(map(math.isfinite, values))):
            raise ValueError(f'{name}: expected {count} finite numbers, got {values}')
    if not p.radial[0] > 0.0:
        raise ValueError(f'radial: expected a first number above 0, got {p.radial}')
    camera = DomeCamera(
        p.image_width,
        p.image_height,
        (p.centre[0], p.centre[1]),
        (p.rotation[0], p.rotation[1], p.rotation[2]),
        (p.radial[0], p.radial[1], p.radial[2]),
        (p.eye[0], p.eye[1], p.eye[2]),
    )
    if not camera.dome().any():
        raise ValueError('centre: expected a camera that sees the dome')
    for name in ('rim', 'rim_elevations'):
        values = getattr(p, name)
        if values != NO_RIM and not (len(values) == SECTORS and all(map(math.isfinite, values))):
            raise ValueError(f'{name}: expected {SECTORS} finite numbers, got {values}')
    places = tuple(p.rim_elevations) if p.rim_elevations != NO_RIM else ()
    rim = RimProfile(tuple(p.rim), places) if p.rim != NO_RIM else None
    return ImageContactFinder(camera, image_settings(p), rim, at_start=p.reference_at_start)


def image_settings(p: CameraSensorParameters) -> 'ImageContactSettings':
    """Return what counts as a contact, which may change while the node runs."""
    from tactile_push.tactile.image_contact import ImageContactSettings

    return ImageContactSettings(p.threshold, p.least_area, p.reach, p.follow_time, p.force_scale)


def calibrated_values(
    camera: DomeCamera, reach: float, rim: RimProfile, force_scale: float = 0.0
) -> dict[str, object]:
    """Return the parameters that a calibration gives.

    Parameters
    ----------
    camera : DomeCamera
        The fitted camera.
    reach : float
        Largest angle between the pole and a touch [rad].
    rim : RimProfile
        Brightness along the rim.
    force_scale : float, optional
        Force over area^(3/2) [N/sr^(3/2)]; 0 if it is not known.

    Returns
    -------
    dict of str to object
        Values by name.
    """
    return {
        'image_width': camera.width,
        'image_height': camera.height,
        'centre': list(camera.centre),
        'rotation': list(camera.rotation),
        'radial': list(camera.radial),
        'eye': list(camera.eye),
        'reach': reach,
        'rim': [round(level, 1) for level in rim.levels],
        'rim_elevations': [round(elevation, 4) for elevation in rim.elevations] or NO_RIM,
        'force_scale': force_scale,
    }
