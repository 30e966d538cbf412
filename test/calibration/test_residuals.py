# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
import math

import numpy as np
import pytest

from tactile_push.calibration.residuals import rms


def test_rms_is_the_root_of_the_mean_square():
    assert rms(np.array([3.0, -4.0])) == pytest.approx(math.sqrt(12.5))
