# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""How well a calibrated camera finds contacts in rendered images, spoiled as real ones are.

Each row calibrates from the touches that `tactile_push calibrate` suggests, and then finds contacts
at random places with random forces.
"""

import argparse
import math
from dataclasses import replace

import numpy as np

from tactile_push.calibration.camera_calibration import calibrate_camera
from tactile_push.calibration.camera_images import TouchImages
from tactile_push.calibration.coverage import suggested_touches
from tactile_push.calibration.touch_table import KnownTouch
from tactile_push.simulation.dome_image import DomeImages, DomeView
from tactile_push.tactile import NO_CONTACT, Reading
from tactile_push.tactile.cut_region import CutRegions
from tactile_push.tactile.image_contact import IMAGES_OF_REFERENCE
from tactile_push.tactile.sphere import angles_between, angles_of, directions_of
from tactile_push.tactile.touched_region import mean_image, touched_region

THRESHOLD = 12.0
FORCES = (0.5, 2.0)  # [N]
LOWEST = math.radians(5.0)  # elevation of a contact; lower, the rim hides half of it
NEAR_RIM = math.radians(12.0)  # elevation of the outermost touches of the calibration

CLEAN = DomeView(focal_length=250.0, defocus=0.0, vignetting=0.0, noise=0.0)
ASIDE = {'eye': (0.1, 0.0, -1.0), 'turned': (0.3, 0.05, -0.03), 'principal_point': (12.0, -9.0)}
SPOILED = {'defocus': 4.0, 'vignetting': 0.6, 'noise': 0.02, 'dead': 0.05}
VIEWS = {
    'clean, on the axis': CLEAN,
    'defocus 4 px': replace(CLEAN, defocus=4.0),
    'vignetting 60 %': replace(CLEAN, vignetting=0.6),
    'noise 2 %': replace(CLEAN, noise=0.02),
    'noise 2 %, 5 % of the pixels dead': replace(CLEAN, noise=0.02, dead=0.05),
    'camera 10 % off the axis, tilted by 3°': replace(CLEAN, **ASIDE),
    'all of these': replace(CLEAN, **ASIDE, **SPOILED),
    'all of these, pinhole': replace(CLEAN, lens='pinhole', focal_length=180.0, **ASIDE, **SPOILED),
    'all of these, waveguide': replace(CLEAN, skin=0.0, **ASIDE, **SPOILED),
    'all of these, skin that darkens': replace(CLEAN, skin=150.0, touch=-60.0, **ASIDE, **SPOILED),
}


def study(view: DomeView, contacts: int, seed: int) -> tuple[float, np.ndarray, np.ndarray]:
    """Return the RMS of the calibration, the contacts' errors and their elevations [rad]."""
    dome = DomeImages(view, seed)
    reference = mean_image(dome.image(NO_CONTACT) for _ in range(IMAGES_OF_REFERENCE))
    known = [KnownTouch(azimuth, elevation, 1.0, '') for azimuth, elevation in suggested_touches()]
    images = [dome.image(Reading(*touch[:3])) for touch in known]
    names = [str(number) for number in range(len(known))]
    fit = calibrate_camera(TouchImages(reference, images, known, names), THRESHOLD).fit
    random = np.random.default_rng(seed)
    azimuth = random.uniform(-math.pi, math.pi, contacts)
    elevation = np.arcsin(random.uniform(math.sin(LOWEST), 1.0, contacts))
    true = directions_of(azimuth, elevation)
    cut = CutRegions(fit.camera)
    errors = []
    for a, e, direction in zip(azimuth, elevation, true, strict=True):
        image = dome.image(Reading(a, e, random.uniform(*FORCES)))
        region = cut.completed(touched_region(image, reference, THRESHOLD, cut.dome))
        errors.append(angles_between(fit.camera.directions((region.x, region.y)), direction))
    return fit.rms, np.array(errors), angles_of(true)[1]


def main() -> None:
    """Print a table of errors."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--contacts', type=int, default=200, help='a row')
    parser.add_argument('--seed', type=int, default=1)
    options = parser.parse_args()
    print('| images | calibration RMS | contacts RMS | largest | RMS below 12° of elevation |')
    print('|---|---|---|---|---|')
    for name, view in VIEWS.items():
        rms, errors, elevation = study(view, options.contacts, options.seed)
        outside = elevation < NEAR_RIM
        numbers = [
            rms,
            np.sqrt(np.mean(errors[~outside] ** 2)),
            np.max(errors[~outside]),
            np.sqrt(np.mean(errors[outside] ** 2)),
        ]
        print(f'| {name} | {" | ".join(f"{math.degrees(n):.2f}°" for n in numbers)} |', flush=True)


if __name__ == '__main__':
    main()
