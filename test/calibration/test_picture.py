# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import math

import numpy as np
import pytest

cv2 = pytest.importorskip('cv2', reason="pip install 'tactile_push[camera]'")
pytest.importorskip('scipy', reason="pip install 'tactile_push[camera]'")

from support.dome import CAMERA, DomePainter  # noqa: E402
from tactile_push.calibration.camera_calibration import CameraCalibration  # noqa: E402
from tactile_push.calibration.camera_fit import CameraFit  # noqa: E402
from tactile_push.calibration.picture import draw_camera  # noqa: E402
from tactile_push.calibration.touch_table import KnownTouch  # noqa: E402
from tactile_push.tactile.rim import RimProfile  # noqa: E402
from tactile_push.tactile.sphere import directions_of  # noqa: E402


@pytest.mark.slow
@pytest.mark.parametrize('off', [0.0, 0.02])
def test_picture_is_drawn_whatever_the_errors(tmp_path, off):
    at = [(0.0, 1.5), (2.0, 0.3)]
    touches = [KnownTouch(azimuth, elevation, math.nan, '') for azimuth, elevation in at]
    pixels = CAMERA.pixels(directions_of(*np.array(at).T)) + off
    fit = CameraFit(CAMERA, np.array([0.0, off]))
    rim = RimProfile((0.0,))
    calibration = CameraCalibration(fit, touches, ['a', 'b'], pixels, rim, 1.5, 0.0)
    reference = DomePainter().image().astype(np.float32)
    draw_camera(calibration, reference, tmp_path / 'a.png')
    picture = cv2.imread(str(tmp_path / 'a.png')).astype(int)
    red, green, blue = np.moveaxis(picture[..., ::-1], -1, 0)
    assert np.count_nonzero((red > 180) & (green < 130) & (blue < 60)) > 50  # crosses, arrows
