# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""From images of touches at known places to a calibrated camera."""

import math
from dataclasses import dataclass

import numpy as np

from tactile_push.calibration.camera_fit import CameraFit, fit_camera
from tactile_push.calibration.camera_images import TouchImages
from tactile_push.calibration.touch_table import KnownTouch
from tactile_push.tactile.cut_region import CutRegions
from tactile_push.tactile.rim import Rim, RimProfile
from tactile_push.tactile.sphere import Array, directions_of
from tactile_push.tactile.touched_region import LEAST_PIXELS, touched_region


@dataclass(frozen=True)
class CameraCalibration:
    """A camera, and what else the node needs to know of the tip."""

    fit: CameraFit  #: the camera and its errors
    touches: list[KnownTouch]  #: where the tip was touched
    names: list[str]  #: of the touches, for people
    pixels: Array  #: where each appears, column and row, shape (n, 2) [px]
    rim: RimProfile  #: brightness along the rim of the untouched tip
    reach: float  #: largest angle between the pole and a touch [rad]
    force_scale: float  #: force over area^(3/2) [N/sr^(3/2)]; 0 if no touch has a force


def calibrate_camera(images: TouchImages, threshold: float) -> CameraCalibration:
    """Calibrate a camera.

    Where the rim of the tip is in the image, and hence which changes lie outside, follows from the
    camera. So the touches are found twice: anywhere, and on the tip that the first camera sees.

    Parameters
    ----------
    images : TouchImages
        Images of touches and of the untouched tip.
    threshold : float
        Change of a pixel's brightness that counts [levels].

    Returns
    -------
    CameraCalibration
        The camera and its errors.

    Raises
    ------
    ValueError
        If an image shows no touch, or the touches do not fit a camera; the message says which, or
        which are missing.
    """
    height, width = images.reference.shape
    azimuths = [touch.azimuth for touch in images.touches]
    directions = directions_of(azimuths, [touch.elevation for touch in images.touches])
    pixels, _ = _found(images, threshold, None)
    first = fit_camera(pixels, directions, width, height)
    pixels, areas = _found(images, threshold, CutRegions(first.camera))
    fit = fit_camera(pixels, directions, width, height)
    seen = np.array([fit.camera.solid_angle(x, y) for x, y in pixels])
    return CameraCalibration(
        fit,
        images.touches,
        images.names,
        pixels,
        Rim(fit.camera).profile(images.reference),
        math.pi / 2.0 - min(touch.elevation for touch in images.touches),
        _force_scale(np.array([touch.normal_force for touch in images.touches]), areas * seen),
    )


def _found(images: TouchImages, threshold: float, cut: CutRegions | None) -> tuple[Array, Array]:
    """Return where the touches appear [px], and their areas [px]."""
    pixels, areas = [], []
    for image, name in zip(images.images, images.names, strict=True):
        where = None if cut is None else cut.dome
        region = touched_region(image, images.reference, threshold, where)
        if region.area < LEAST_PIXELS:
            raise ValueError(
                f'{name}: expected a touch, got an image like that of the untouched tip'
            )
        if cut is not None:
            region = cut.completed(region)
        pixels.append((region.x, region.y))
        areas.append(region.area)
    return np.array(pixels).reshape(-1, 2), np.array(areas, float)


def _force_scale(forces: Array, areas: Array) -> float:
    """Return the factor of area^(3/2) that explains the known forces best, 0 without any."""
    known = np.isfinite(forces)
    base = areas[known] ** 1.5
    return float(forces[known] @ base / (base @ base)) if known.any() else 0.0
