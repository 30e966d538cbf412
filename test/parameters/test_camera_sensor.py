# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The finder of contacts in images that the parameters of `camera_sensor` make."""

import math
from dataclasses import replace

import pytest

pytest.importorskip('cv2', reason="pip install 'tactile_push[camera]'")

from support.dome import CAMERA, parameters
from tactile_push.parameters import CameraSensorParameters
from tactile_push.parameters.camera_sensor import (
    calibrated_values,
    image_settings,
    make_image_finder,
)
from tactile_push.tactile.image_contact import ImageContactSettings
from tactile_push.tactile.rim import SECTORS, RimProfile

CALIBRATED = CameraSensorParameters(**parameters())
LIVE = {'threshold': 20.0, 'least_area': 0.01, 'follow_time': 5.0, 'force_scale': 3.0}


def test_camera_is_the_calibrated_one():
    assert make_image_finder(CALIBRATED).camera == CAMERA


def test_what_a_calibration_gives_makes_the_same_camera():
    rim = RimProfile(tuple(float(level) for level in range(SECTORS)))
    values = calibrated_values(CAMERA, 1.2, rim, 4.0)
    p = CameraSensorParameters.of(values)
    assert make_image_finder(p).camera == CAMERA
    assert (p.reach, p.force_scale, tuple(p.rim)) == (1.2, 4.0, rim.levels)


def test_usual_settings_are_those_of_the_finder():
    assert image_settings(CameraSensorParameters()) == ImageContactSettings()


@pytest.mark.parametrize('name', LIVE)
def test_each_number_that_may_change_arrives(name):
    changed = image_settings(replace(CALIBRATED, **{name: LIVE[name]}))
    assert getattr(changed, name) == LIVE[name]


def test_every_number_that_may_change_is_tested_here():
    changeable = {p.name for p in CameraSensorParameters.declared() if not p.read_only}
    assert changeable == {*LIVE, 'silence_timeout'}


@pytest.mark.parametrize(
    ('values', 'words'),
    [
        ({'image_width': 0}, 'image_width: expected the file that `tactile_push calibrate` writes'),
        ({'centre': [1.0]}, 'centre: expected 2 finite numbers'),
        ({'rotation': [0.0, 0.0]}, 'rotation: expected 3 finite numbers'),
        ({'eye': [math.nan, 0.0, 0.0]}, 'eye: expected 3 finite numbers'),
        ({'radial': [0.0, 1.0, 1.0]}, 'radial: expected a first number above 0'),
        ({'rim': [1.0, 2.0]}, f'rim: expected {SECTORS} finite numbers'),
        ({'centre': [9e9, 0.0]}, 'centre: expected a camera that sees the dome'),
    ],
)
def test_what_is_no_calibration_is_refused(values, words):
    with pytest.raises(ValueError, match=f'^{words}'):
        make_image_finder(CameraSensorParameters(**parameters(**values)))
