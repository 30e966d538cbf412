# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import math

import numpy as np
import pytest

pytest.importorskip('scipy', reason="pip install 'tactile_push[camera]'")

from tactile_push.calibration.camera_fit import fit_camera
from tactile_push.calibration.coverage import suggested_touches
from tactile_push.tactile.sphere import angles_between, directions_of

SIZE = 640, 480
TOUCHES = directions_of(*np.array(suggested_touches()).T)
# Where else the camera has to be right, as near to the rim as the touches are.
ELSEWHERE = directions_of(np.linspace(-3.0, 3.0, 40), np.tile(np.linspace(0.2, 1.5, 8), 5))


def equisolid(directions, eye=(0.05, -0.08, -1.1), roll=0.4, tilt=0.06):
    """Return where a fisheye sees directions; all is written out here, nothing is the package's.

    The camera's right is at the azimuth `roll`, and its axis is tilted by `tilt` towards there.
    """
    x, y, z = (np.asarray(directions) - eye).T
    right = x * math.cos(roll) + y * math.sin(roll)
    down = -x * math.sin(roll) + y * math.cos(roll)
    ahead = z * math.cos(tilt) + right * math.sin(tilt)
    right = right * math.cos(tilt) - z * math.sin(tilt)
    radius = 2.0 * 280.0 * np.sin(np.arctan2(np.hypot(right, down), ahead) / 2.0)
    around = np.arctan2(down, right)
    return np.stack([330.0 + radius * np.cos(around), 225.0 + radius * np.sin(around)], axis=-1)


def pinhole(directions):
    """Return where an upright camera without distortion sees directions."""
    x, y, z = (np.asarray(directions) - (0.0, 0.0, -2.0)).T
    return np.stack([319.5 - 450.0 * x / z, 239.5 - 450.0 * y / z], axis=-1)


def rms_elsewhere(fit, see):
    errors = angles_between(fit.camera.directions(see(ELSEWHERE)), ELSEWHERE)
    return math.degrees(np.sqrt(np.mean(errors**2)))


@pytest.mark.parametrize('see', [equisolid, pinhole])
def test_camera_of_another_kind_is_explained_beside_the_touches_too(see):
    fit = fit_camera(see(TOUCHES), TOUCHES, *SIZE)
    assert math.degrees(fit.rms) < 0.05
    assert rms_elsewhere(fit, see) < 0.1
    assert (fit.camera.width, fit.camera.height) == SIZE


def test_inexact_touches_are_averaged():
    random = np.random.default_rng(2)
    off = TOUCHES + math.radians(0.5) * random.standard_normal(TOUCHES.shape)
    off /= np.linalg.norm(off, axis=1)[:, None]
    fit = fit_camera(equisolid(TOUCHES), off, *SIZE)
    # Each is off by half a degree in two directions; 11 of 42 numbers go into the camera.
    expected = 0.5 * math.sqrt(2.0 * (1.0 - 11.0 / 42.0))
    assert math.degrees(fit.rms) == pytest.approx(expected, rel=0.35)
    assert rms_elsewhere(fit, equisolid) < 0.75


def test_touch_that_is_a_little_off_stands_out_and_hardly_moves_the_camera():
    off = TOUCHES.copy()
    off[4] = directions_of(*(np.array(suggested_touches()[4]) + math.radians(6.0)))
    fit = fit_camera(equisolid(TOUCHES), off, *SIZE)
    assert fit.largest == 4
    assert fit.errors[4] > 5.0 * np.median(fit.errors)


@pytest.mark.slow
def test_touch_in_a_wrong_place_is_named():
    wrong = TOUCHES.copy()
    wrong[5] = directions_of(0.3, 0.4)
    with pytest.raises(ValueError, match=r'^touches: expected .* without touch 6 it is 0\.\d+°$'):
        fit_camera(equisolid(TOUCHES), wrong, *SIZE)


def test_azimuths_of_the_opposite_sense_are_refused():
    with pytest.raises(ValueError, match='^touches: expected azimuths that grow from left over up'):
        fit_camera(equisolid(TOUCHES), TOUCHES * [1.0, -1.0, 1.0], *SIZE)


def test_touches_that_do_not_cover_the_tip_are_refused():
    with pytest.raises(ValueError, match='none at up, elevation 25° to 50°'):
        fit_camera(equisolid(TOUCHES)[:9], TOUCHES[:9], *SIZE)
