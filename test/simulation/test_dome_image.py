# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import math
from dataclasses import replace

import numpy as np
import pytest

pytest.importorskip('cv2', reason="pip install 'tactile_push[camera]'")

from tactile_push.simulation.dome_image import DomeImages, DomeView
from tactile_push.tactile import NO_CONTACT, Reading

CLEAN = DomeView(
    width=161,
    height=121,
    focal_length=70.0,
    skin=0.0,
    defocus=0.0,
    vignetting=0.0,
    noise=0.0,
)
FAR = DomeView(**{**CLEAN.__dict__, 'lens': 'pinhole', 'focal_length': 100.0})
MIDDLE = 80.0, 60.0


def centroid(view, azimuth, elevation, force=0.3):
    """Return where a contact brightens the image."""
    dome = DomeImages(view)
    image = dome.image(Reading(azimuth, elevation, force)).astype(float)
    image -= DomeImages(view).image(NO_CONTACT)
    rows, columns = np.mgrid[: view.height, : view.width]
    return (image * columns).sum() / image.sum(), (image * rows).sum() / image.sum()


@pytest.mark.parametrize(
    ('azimuth', 'sideways', 'down'),
    [(0.0, -1.0, 0.0), (math.pi / 2.0, 0.0, -1.0), (math.pi, 1.0, 0.0), (-math.pi / 2.0, 0.0, 1.0)],
)
def test_contact_lies_where_a_lens_of_closed_form_shows_it(azimuth, sideways, down):
    # From opposite the pole, 40 degrees at the centre are 20 at the eye.
    away = 2.0 * 70.0 * math.sin(math.radians(10.0))
    expected = MIDDLE[0] + away * sideways, MIDDLE[1] + away * down
    assert centroid(CLEAN, azimuth, math.radians(50.0)) == pytest.approx(expected, abs=0.3)


def test_pinhole_shows_the_tangent():
    away = 100.0 * math.tan(math.radians(20.0))
    found = centroid(FAR, 0.0, math.radians(50.0))
    assert found == pytest.approx((MIDDLE[0] - away, MIDDLE[1]), abs=0.3)


def test_camera_that_is_turned_about_the_pole_sees_the_tip_turned_the_other_way():
    # Turned by a right angle in the sense of the azimuth, its right is where its lower edge was.
    view = replace(CLEAN, turned=(math.pi / 2.0, 0.0, 0.0))
    upright, turned = (np.subtract(centroid(v, 0.3, 0.9), MIDDLE) for v in (CLEAN, view))
    assert turned == pytest.approx((upright[1], -upright[0]), abs=0.2)


def test_camera_that_is_aside_sees_the_pole_on_the_other_side():
    view = replace(CLEAN, eye=(0.1, 0.0, -1.0))
    away = 2.0 * 70.0 * math.sin(math.atan(0.1 / 2.0) / 2.0)
    found = centroid(view, 0.0, math.pi / 2.0)
    assert found == pytest.approx((MIDDLE[0] + away, MIDDLE[1]), abs=0.2)


def test_contact_is_as_wide_as_hertz_says():
    # Eight times the force makes a contact twice as wide.
    def pixels(force):
        image = DomeImages(CLEAN).image(Reading(0.0, math.pi / 2.0, force))
        return np.count_nonzero(image > 6)

    assert pixels(4.0) == pytest.approx(4.0 * pixels(0.5), rel=0.1)


@pytest.mark.parametrize('reading', [NO_CONTACT, Reading(0.0, 1.0), Reading(0.0, 1.0, 0.0)])
def test_without_a_force_the_tip_is_untouched(reading):
    assert DomeImages(CLEAN).image(reading).max() <= 6


def test_noise_is_as_large_as_asked_for_and_differs_from_image_to_image():
    dome = DomeImages(replace(CLEAN, skin=100.0, noise=0.02))
    one, other = (dome.image(NO_CONTACT).astype(float) for _ in range(2))
    lit = one > 50.0
    assert (one - other)[lit].std() == pytest.approx(math.sqrt(2.0) * 0.02 * 255.0, rel=0.05)


def test_the_same_seed_gives_the_same_images():
    view = replace(CLEAN, noise=0.02, dead=0.05)
    one, other = (DomeImages(view, seed=4).image(NO_CONTACT) for _ in range(2))
    assert (one == other).all()


def test_dead_pixels_stay_black_or_white():
    dome = DomeImages(replace(CLEAN, skin=100.0, dead=0.05), seed=1)
    one, other = dome.image(NO_CONTACT), dome.image(Reading(0.0, 1.2, 2.0))
    for level, share in ((255, 0.025), (0, 0.025)):
        dead = one == level
        assert dead.mean() == pytest.approx(share, rel=0.2)
        assert (other[dead] == level).all()


def test_vignetting_takes_light_from_the_corners():
    view = replace(CLEAN, skin=100.0)
    bright, dim = (DomeImages(v).image(NO_CONTACT) for v in (view, replace(view, vignetting=0.5)))
    assert dim[60, 80] == bright[60, 80]
    assert dim[0, 0] == round(bright[0, 0] * 0.5)


def test_defocus_spreads_a_spot_and_keeps_its_place_and_light():
    sharp, soft = CLEAN, replace(CLEAN, defocus=4.0)
    contact = Reading(0.5, 1.2, 0.3)
    one, other = (DomeImages(view).image(contact).astype(float) - 6.0 for view in (sharp, soft))
    assert other.max() < one.max()
    assert centroid(soft, 0.5, 1.2) == pytest.approx(centroid(sharp, 0.5, 1.2), abs=0.2)
