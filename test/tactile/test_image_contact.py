# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import math
from contextlib import nullcontext as no_error
from dataclasses import replace

import numpy as np
import pytest

pytest.importorskip('cv2', reason="pip install 'tactile_push[camera]'")

from support.dome import CAMERA, HEIGHT, ON_DOME, SLOPE, WIDTH, DomePainter
from tactile_push.simulation.dome_image import DomeImages, DomeView
from tactile_push.tactile import NO_CONTACT, NotUntouchedError, Reading, ReadingRejectedError
from tactile_push.tactile.dome_camera import DomeCamera
from tactile_push.tactile.image_contact import (
    IMAGES_OF_REFERENCE,
    ImageContactFinder,
    ImageContactSettings,
)
from tactile_push.tactile.rim import Rim

SETTINGS = ImageContactSettings()


class Tip:
    """A finder and the images that it gets, 50 a second."""

    def __init__(self, settings=SETTINGS, seed=0, **how):
        self.finder = ImageContactFinder(CAMERA, settings, **how)
        self.painter = DomePainter(seed)
        self.now = 100.0

    def see(self, image=None, **touch):
        """Return what comes of an image: of a touch, or as it is given."""
        self.now += 0.02
        image = self.painter.image(**touch) if image is None else image
        return self.finder.contact(image, self.now)

    def refusal(self, image=None, **touch):
        with pytest.raises(ReadingRejectedError) as refused:
            self.see(image, **touch)
        return str(refused.value)

    def refer(self, **look):
        """Show images until they could be a reference, and take it."""
        for _ in range(IMAGES_OF_REFERENCE):
            try:
                self.see(**look)
            except ReadingRejectedError as refused:
                assert str(refused) == 'no reference'
        self.finder.take_reference()

    def no_reference(self, **look):
        with pytest.raises(NotUntouchedError) as refused:
            self.refer(**look)
        return str(refused.value)


@pytest.fixture
def tip():
    """Return a tip whose finder knows how it looks untouched."""
    tip = Tip()
    tip.refer()
    return tip


def test_contact_of_which_the_rim_hides_a_part_is_found_to_half_a_degree():
    dome = DomeImages(DomeView(width=320, height=240, focal_length=130.0, defocus=0.0))
    f = dome.view.focal_length
    camera = DomeCamera(
        *(320, 240, (159.5, 119.5), (math.pi, 0.0, 0.0)),
        *((f, -f / 24.0, f / 1920.0), (0.0, 0.0, -1.0)),  # of 2 f sin(alpha/2)
    )
    finder = ImageContactFinder(camera, SETTINGS, at_start=True)
    for number in range(IMAGES_OF_REFERENCE):
        with no_error() if number == 9 else pytest.raises(ReadingRejectedError):
            finder.contact(dome.image(NO_CONTACT), 0.02 * number)
    at = Reading(0.5, math.radians(4.0), 2.0)  # its radius is (2/250)^(1/3), 11.5°
    found = finder.contact(dome.image(at), 1.0).reading
    assert found.azimuth == pytest.approx(at.azimuth, abs=math.radians(0.2))
    assert found.elevation == pytest.approx(at.elevation, abs=math.radians(0.5))


@pytest.mark.parametrize(
    ('azimuth', 'elevation'), [(0.0, 0.9), (2.5, 0.5), (-1.3, 1.2), (1.0, math.pi / 2.0)]
)
def test_contact_is_found_where_the_tip_is_touched(tip, azimuth, elevation):
    reading = tip.see(azimuth=azimuth, elevation=elevation).reading
    # Half a pixel is 0.8 degrees of this small dome.
    apart = [
        math.cos(reading.elevation) * math.cos(reading.azimuth)
        - math.cos(elevation) * math.cos(azimuth),
        math.cos(reading.elevation) * math.sin(reading.azimuth)
        - math.cos(elevation) * math.sin(azimuth),
    ]
    assert math.hypot(*apart) < 0.5 / SLOPE
    assert math.isnan(reading.normal_force)


def test_untouched_tip_is_no_contact(tip):
    seen = tip.see()
    assert not seen.reading.in_contact
    assert seen.area == 0.0


def test_area_is_that_of_the_touch_wherever_it_is(tip):
    # Nine pixels of 1/36 rad each; near the rim of a fisheye circles become ellipses.
    near_pole = tip.see(azimuth=1.0, elevation=1.4)
    assert near_pole.area == pytest.approx(math.pi * (9.0 / SLOPE) ** 2, rel=0.15)


def test_force_grows_with_the_three_halves_power_of_the_area():
    tip = Tip(replace(SETTINGS, force_scale=20.0))
    tip.refer()
    seen = tip.see(azimuth=1.0, elevation=1.2)
    assert seen.reading.normal_force == pytest.approx(20.0 * seen.area**1.5)


def test_speck_is_no_contact(tip):
    # 1.5 px are 0.04 rad, so 0.005 sr, of which the filters leave less than 0.002.
    assert not tip.see(azimuth=1.0, elevation=1.2, size=1.5).reading.in_contact


def test_contact_further_out_than_calibrated_is_refused():
    tip = Tip(replace(SETTINGS, reach=0.8))
    tip.refer()
    assert tip.see(azimuth=1.0, elevation=math.pi / 2.0 - 0.7).reading.in_contact
    out = {'azimuth': 1.0, 'elevation': math.pi / 2.0 - 0.9}
    assert tip.refusal(**out) == 'contact beyond the calibrated part'


def black():
    return np.zeros((HEIGHT, WIDTH), np.uint8)


@pytest.mark.parametrize(
    ('image', 'reason'),
    [
        (lambda tip: tip.painter.image()[:, :-1], 'another size than calibrated'),
        (lambda tip: tip.painter.image().T, 'another size than calibrated'),
        (lambda tip: black(), 'all pixels alike'),
        (lambda tip: black() + 255, 'all pixels alike'),
        (lambda tip: tip.painter.image(skin=2.0), 'dark'),
        (lambda tip: tip.painter.image(skin=300.0), 'saturated'),
        (lambda tip: tip.painter.image(skin=150.0), 'changed all over'),
        (lambda tip: tip.painter.image(skin=50.0), 'changed all over'),
    ],
)
def test_image_that_tells_nothing_is_refused_and_the_next_one_counts(tip, image, reason):
    assert tip.refusal(image(tip)) == reason
    assert tip.see(azimuth=1.0, elevation=1.2).reading.in_contact


def test_camera_that_hangs_is_noticed(tip):
    touched = tip.painter.image(azimuth=1.0, elevation=1.2)
    assert tip.see(touched).reading.in_contact
    for _ in range(3):
        assert tip.refusal(touched.copy()) == 'the same image again'


def test_without_a_reference_there_is_no_reading():
    assert Tip().refusal() == 'no reference'


def test_bright_spot_of_a_waveguide_may_be_saturated():
    tip = Tip()
    tip.refer(skin=5.0)
    assert tip.see(azimuth=1.0, elevation=1.2, skin=5.0, add=500.0).reading.in_contact


def test_reference_in_contact_is_refused_and_the_old_one_stays(tip):
    touch = {'azimuth': 1.0, 'elevation': 1.2}
    assert tip.no_reference(**touch).startswith('in contact; lift the finger')
    assert tip.see(**touch).reading.in_contact


def test_reference_of_too_few_images_is_refused():
    tip = Tip()
    tip.refusal()
    with pytest.raises(NotUntouchedError, match='expected 10 good images in a row, got 1'):
        tip.finder.take_reference()


def test_bad_image_begins_the_row_anew():
    tip = Tip()
    for _ in range(IMAGES_OF_REFERENCE - 1):
        tip.refusal()
    tip.refusal(black())
    tip.refusal()
    with pytest.raises(NotUntouchedError, match='got 1'):
        tip.finder.take_reference()


def test_reference_of_a_tip_that_is_just_touched_is_refused():
    tip = Tip()
    for number in range(IMAGES_OF_REFERENCE):
        tip.refusal(**({'azimuth': 1.0, 'elevation': 1.2} if number > 6 else {}))
    with pytest.raises(NotUntouchedError, match='the image changes'):
        tip.finder.take_reference()


def calibrated_rim():
    return Rim(CAMERA).profile(DomePainter(5).image().astype(np.float32))


@pytest.mark.parametrize(
    ('look', 'words'),
    [
        ({'turned': math.pi / 2.0}, 'the image is turned by 90° against the calibration'),
        ({'skin': 1.0}, 'the rim does not look as calibrated'),
    ],
)
def test_reference_of_a_tip_that_was_not_calibrated_is_refused(look, words):
    assert Tip(rim=calibrated_rim()).no_reference(**look).startswith(words)


def test_reference_of_a_camera_that_moved_is_refused():
    tip = Tip(rim=calibrated_rim())
    for _ in range(IMAGES_OF_REFERENCE):
        tip.refusal(np.roll(tip.painter.image(), 2, axis=1))  # 3 degrees
    with pytest.raises(NotUntouchedError, match=r'the rim is \d\.\d° off its place'):
        tip.finder.take_reference()


def test_reference_of_the_calibrated_tip_is_taken_though_its_lamps_have_aged():
    tip = Tip(rim=calibrated_rim())
    tip.refer(skin=60.0)
    assert tip.see(azimuth=1.0, elevation=1.2, skin=60.0).reading.in_contact


def test_first_images_are_the_reference_if_that_is_asked_for():
    tip = Tip(at_start=True)
    for _ in range(IMAGES_OF_REFERENCE - 1):
        assert tip.refusal() == 'no reference'
    assert not tip.see().reading.in_contact
    assert tip.finder.has_reference


def test_first_images_that_are_no_reference_are_told_and_later_ones_tried():
    tip = Tip(at_start=True, rim=calibrated_rim())
    for _ in range(IMAGES_OF_REFERENCE):
        tip.refusal(turned=math.pi)
    assert tip.finder.trouble == 'the image is turned by 180° against the calibration'
    for _ in range(IMAGES_OF_REFERENCE - 1):
        tip.refusal()
    assert not tip.see().reading.in_contact


def brighten(tip, rate, seconds, **touch):
    """Show images whose brightness grows by so many levels a second, and return the last."""
    for _ in range(round(seconds / 0.02)):
        tip.skin += 0.02 * rate
        seen = tip.see(skin=tip.skin, **touch)
    return seen


@pytest.mark.parametrize(('follow_time', 'follows'), [(2.0, True), (0.0, False)])
def test_reference_follows_what_changes_slowly(follow_time, follows):
    tip = Tip(replace(SETTINGS, follow_time=follow_time))
    tip.refer()
    tip.skin = 90.0
    # With a lag of 2 s and 3 levels a second the reference stays 6 behind, 12 count.
    with pytest.raises(ReadingRejectedError) if not follows else no_error():
        assert not brighten(tip, 3.0, 10.0).reading.in_contact


def test_reference_stands_still_in_contact():
    tip = Tip(replace(SETTINGS, follow_time=0.5))
    tip.refer()
    for _ in range(200):  # 4 s
        seen = tip.see(azimuth=1.0, elevation=1.2)
    assert seen.reading.in_contact


def test_forgotten_reference_is_gone(tip):
    tip.finder.forget()
    assert tip.refusal() == 'no reference'


def test_dome_is_the_half_that_the_camera_was_calibrated_for():
    found = CAMERA.dome()
    assert np.count_nonzero(found != ON_DOME) < 0.01 * np.count_nonzero(ON_DOME)
