# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""How far a fit is from the touches that it was made of."""

import numpy as np

from tactile_push.tactile.sphere import Array


def rms(errors: Array) -> float:
    """Compute the root of the mean square of errors.

    Parameters
    ----------
    errors : ndarray, shape (n,)
        One for each touch.

    Returns
    -------
    float
        In their unit.
    """
    return float(np.sqrt(np.mean(errors**2)))
