# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Contacts at the rim, beside the same contacts on a tip whose skin goes on beyond it."""

import math
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

pytest.importorskip('cv2', reason="pip install 'tactile_push[camera]'")

from tactile_push.tactile.cut_region import CutRegions
from tactile_push.tactile.dome_camera import DomeCamera
from tactile_push.tactile.sphere import angles_between, directions_of
from tactile_push.tactile.touched_region import NOTHING, touched_region

WIDTH, HEIGHT = 480, 360
# One bends the image of a contact, the other one flattens it.
CAMERAS = {
    'centre': DomeCamera(
        *(WIDTH, HEIGHT, (240.0, 180.0), (math.pi, 0.0, 0.0), (80.0, 0.0, 0.0), (0.0, 0.0, 0.0))
    ),
    'below': DomeCamera(
        *(WIDTH, HEIGHT, (236.0, 184.0), (3.0, 0.05, 0.0), (170.0, 0.0, 0.0), (0.05, 0.0, -1.0))
    ),
}
REACH = math.radians(10.0)  # radius of the contact, by Hertz
ROWS, COLUMNS = np.mgrid[:HEIGHT, :WIDTH]
REFERENCE = np.full((HEIGHT, WIDTH), 50.0, np.float32)


@cache
def cutting(camera):
    return CutRegions(camera)


@cache
def skin(camera):
    return camera.directions(np.stack([COLUMNS, ROWS], axis=-1))


def pressed(camera, azimuth, elevation, noise=3.0):
    """Return an image of a skin that goes on beyond the rim."""
    along = skin(camera) @ directions_of(azimuth, elevation)
    square = np.nan_to_num(1.0 - (1.0 - along**2) / math.sin(REACH) ** 2) * (along > 0.0)
    levels = 50.0 + 100.0 * np.sqrt(np.maximum(square, 0.0))
    levels += noise * np.random.default_rng(1).standard_normal(levels.shape)
    return np.clip(np.rint(levels), 0, 255).astype(np.uint8)


@pytest.fixture(params=CAMERAS)
def camera(request):
    return CAMERAS[request.param]


@pytest.mark.parametrize('degrees', [2.0, 6.0, 9.0])
@pytest.mark.parametrize('azimuth', [0.3, 2.9])
def test_cut_contact_is_where_the_whole_one_would_be(camera, azimuth, degrees):
    image, cut = pressed(camera, azimuth, math.radians(degrees)), cutting(camera)
    whole = touched_region(image, REFERENCE, 12.0)
    left = touched_region(image, REFERENCE, 12.0, cut.dome)
    completed = cut.completed(left)

    def error(region):
        directions = camera.directions([(region.x, region.y), (whole.x, whole.y)])
        return math.degrees(angles_between(*directions))

    assert error(completed) < 0.5
    if degrees < 9.0:
        assert error(left) > 3.0 * error(completed)


def test_contact_away_from_the_rim_stays_as_it_is(camera):
    image, cut = pressed(camera, 0.3, math.radians(20.0)), cutting(camera)
    region = touched_region(image, REFERENCE, 12.0, cut.dome)
    assert cut.completed(region) is region


def test_contact_of_which_hardly_any_outline_is_left_stays_as_it_is(camera):
    image, cut = pressed(camera, 0.3, math.radians(-9.5)), cutting(camera)
    region = touched_region(image, REFERENCE, 12.0, cut.dome)
    assert region.area > 0
    assert cut.completed(region) is region


def test_no_contact_stays_none(camera):
    assert cutting(camera).completed(NOTHING) is NOTHING


def test_edge_of_the_image_cuts_like_a_rim():
    camera = CAMERAS['below']
    at = camera.pixels(directions_of(-1.6, math.radians(30.0)))
    rows = round(float(at[1]))  # of an image that ends in the middle of the contact
    short = replace(camera, height=rows)
    image, cut = pressed(camera, -1.6, math.radians(30.0)), CutRegions(short)
    left = touched_region(np.ascontiguousarray(image[:rows]), REFERENCE[:rows], 12.0, cut.dome)
    whole = touched_region(image, REFERENCE, 12.0)
    assert left.y < whole.y - 4.0
    completed = cut.completed(left)
    assert (completed.x, completed.y) == pytest.approx((whole.x, whole.y), abs=1.0)
