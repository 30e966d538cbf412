# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Draws the pictures of the pages: `python docs/pictures.py`.

Sensors and the person who touches them are simulated; the same seeds give the same pictures.
"""

import math
from collections.abc import Callable
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Circle

from tactile_push.calibration.camera_calibration import CameraCalibration, calibrate_camera
from tactile_push.calibration.camera_images import TouchImages
from tactile_push.calibration.coverage import QUARTERS, suggested_touches
from tactile_push.calibration.picture import draw_camera, draw_tip
from tactile_push.calibration.touch_table import KnownTouch
from tactile_push.calibration.wrench_fit import fit_tip
from tactile_push.figures import settling_figure
from tactile_push.figures.style import BLUE, GREY, ORANGE, RED, TWO_COLUMNS, new_figure, styled
from tactile_push.parameters.camera_sensor import CameraSensorParameters
from tactile_push.simulation.dome_image import DomeImages, DomeView
from tactile_push.tactile import NO_CONTACT, Reading
from tactile_push.tactile.cut_region import CutRegions
from tactile_push.tactile.image_contact import IMAGES_OF_REFERENCE
from tactile_push.tactile.sphere import angles_of, directions_of
from tactile_push.tactile.touched_region import Image, Reference, mean_image, touched_region

FOLDER = Path(__file__).parent / 'pictures'
VIEW = DomeView(
    width=320,
    height=240,
    focal_length=125.0,
    principal_point=(6.0, -4.0),
    eye=(0.1, 0.0, -1.0),
    turned=(0.3, 0.05, -0.03),
    defocus=2.0,
    noise=0.01,
)
THRESHOLD = CameraSensorParameters().threshold
HAND = math.radians(0.7)  # by which the person misses a place, in each direction
TOUCH = Reading(math.radians(150.0), math.radians(35.0), 2.0)  # of the picture of a contact
TIP_RADIUS, TIP_CENTRE = 0.0135, np.array([0.0005, -0.001, 0.035])  # on the sensor [m]
FORCE_NOISE, MOMENT_NOISE = 0.01, 0.0001  # of the mean of a touch's wrenches [N, N m]
PLATE = {'facecolor': 'white', 'edgecolor': 'none', 'pad': 0.5}  # behind a number on a line
DOTS = 150  # an inch; the noise of images is no better for more
HALO = 108.0  # from the pole to the names of the directions [degrees]


@styled
def draw_touches(file: Path) -> None:
    """Draw where `tactile_push calibrate` asks for touches."""
    figure = new_figure(0.6 * TWO_COLUMNS, 0.6 * TWO_COLUMNS)
    axes = figure.subplots()
    for elevation in (0, 30, 60):
        axes.add_patch(Circle((0, 0), 90 - elevation, fill=False, color=GREY, linewidth=0.5))
        how = {'ha': 'center', 'va': 'center', 'bbox': PLATE}
        axes.text(*_at(157.5, elevation), f'{elevation}°', color=GREY, **how)
    for number, (azimuth, elevation) in enumerate(suggested_touches(), 1):
        x, y = _at(math.degrees(azimuth), math.degrees(elevation))
        axes.plot(x, y, 'o', color=BLUE, markersize=3)
        how = {'textcoords': 'offset points', 'ha': 'center', 'bbox': PLATE}
        axes.annotate(str(number), (x, y), (0, 5), **how)
    for name, azimuth in QUARTERS.items():
        x, y = _at(azimuth, 90.0 - HALO)
        axes.text(x, y, f'{name}\n{azimuth:.0f}°', ha='center', va='center')
    axes.set_aspect('equal')
    axes.set_xlim(125.0, -125.0)  # left is to the left, as seen along the pole
    axes.set_ylim(-125.0, 125.0)
    axes.axis('off')
    figure.savefig(file, dpi=DOTS)


def _at(azimuth: float, elevation: float) -> tuple[float, float]:
    """Return a place on the map with the pole in its middle [degrees]."""
    away, turn = 90.0 - elevation, math.radians(azimuth)
    return away * math.cos(turn), away * math.sin(turn)


def draw_cameras(contact: Path, calibration: Path) -> None:
    """Draw a contact in an image, and the calibration of the camera."""
    dome, random = DomeImages(VIEW, seed=1), np.random.default_rng(1)
    reference = mean_image(dome.image(NO_CONTACT) for _ in range(IMAGES_OF_REFERENCE))
    known = [KnownTouch(*at, 1.0, '') for at in suggested_touches()]
    images = [dome.image(Reading(*_missed(touch, random), 1.0)) for touch in known]
    names = [f'touch {number}' for number in range(1, len(known) + 1)]
    found = calibrate_camera(TouchImages(reference, images, known, names), THRESHOLD)
    draw_camera(found, reference, calibration)
    _draw_contact(contact, found, reference, dome.image(TOUCH))


def _missed(touch: KnownTouch, random: np.random.Generator) -> tuple[float, float]:
    """Return where a person touches who aims at a place."""
    aim = directions_of(touch.azimuth, touch.elevation)
    hit = aim + random.normal(0.0, HAND, 3)
    azimuth, elevation = map(float, angles_of(hit / np.linalg.norm(hit)))
    return azimuth, elevation


@styled
def _draw_contact(
    file: Path, calibration: CameraCalibration, reference: Reference, touched: Image
) -> None:
    figure = new_figure(TWO_COLUMNS, 0.29 * TWO_COLUMNS)
    camera = calibration.fit.camera
    cut = CutRegions(camera)
    region = cut.completed(touched_region(touched, reference, THRESHOLD, cut.dome))
    azimuth, elevation = map(float, np.degrees(angles_of(camera.directions((region.x, region.y)))))
    free, image, change = figure.subplots(1, 3)
    free.imshow(reference, cmap='gray', vmin=0.0, vmax=180.0)
    free.set_title('reference')
    image.imshow(touched, cmap='gray', vmin=0.0, vmax=180.0)
    image.set_title('image of a contact')
    change.imshow(np.abs(touched - reference), cmap='gray_r', vmin=0.0, vmax=100.0)
    change.plot(*region.outline.T, '.', color=BLUE, markersize=1)
    change.plot(region.x, region.y, '+', color=RED, markersize=8)
    change.set_title(f'change: azimuth {azimuth:.0f}°, elevation {elevation:.0f}°')
    around = np.linspace(-math.pi, math.pi, 181)
    rim = camera.pixels(directions_of(around, np.zeros_like(around)))
    for axes in (free, image, change):
        _draw_rim(axes, rim)
    figure.savefig(file, dpi=DOTS)


def _draw_rim(axes: Axes, rim: np.ndarray) -> None:
    axes.plot(*rim.T, color=ORANGE, linewidth=0.6)
    axes.set_xlim(0, VIEW.width)
    axes.set_ylim(VIEW.height, 0)
    axes.set_xticks([])
    axes.set_yticks([])


def draw_wrenches(file: Path) -> None:
    """Draw the calibration of a tip on a force/torque sensor."""
    random = np.random.default_rng(2)
    known = [KnownTouch(*at, math.nan, '') for at in suggested_touches()]
    normals = np.array([directions_of(*_missed(touch, random)) for touch in known])
    # Each press of 2 N leans by up to 0.6 N along the surface.
    sideways = random.uniform(-0.6, 0.6, normals.shape)
    sideways -= np.sum(sideways * normals, axis=1)[:, None] * normals
    forces = sideways - 2.0 * normals
    moments = np.cross(TIP_CENTRE + TIP_RADIUS * normals, forces)
    forces += random.normal(0.0, FORCE_NOISE, forces.shape)
    moments += random.normal(0.0, MOMENT_NOISE, moments.shape)
    directions = directions_of([t.azimuth for t in known], [t.elevation for t in known])
    draw_tip(fit_tip(forces, moments, directions, np.eye(3)), known, file)


def draw_settling(file: Path) -> None:
    """Draw how soon theta is at its angle."""
    settling_figure().savefig(file, dpi=DOTS)


PICTURES: dict[tuple[str, ...], Callable[..., None]] = {
    ('touches.png',): draw_touches,
    ('camera_contact.png', 'camera_calibration.png'): draw_cameras,
    ('wrench_calibration.png',): draw_wrenches,
    ('settling.png',): draw_settling,
}


def draw(folder: Path) -> None:
    """Draw all pictures into a folder."""
    folder.mkdir(exist_ok=True)
    for names, draw_them in PICTURES.items():
        draw_them(*(folder / name for name in names))


if __name__ == '__main__':
    draw(FOLDER)
