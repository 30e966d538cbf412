# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""When theta has settled."""

import numpy as np
import numpy.typing as npt


def settle_step(theta: npt.ArrayLike, theta_desired: float, band: float) -> int | None:
    """Find the step from which theta stays near its desired value.

    Parameters
    ----------
    theta : array_like, shape (K + 1,)
        Angle of the pushed edge [rad].
    theta_desired, band : float
        Desired angle, and how near to it counts [rad].

    Returns
    -------
    int or None
        The first such step; None if theta is not near at the end.
    """
    outside = np.flatnonzero(~(np.abs(np.asarray(theta) - theta_desired) <= band))
    first = int(outside[-1]) + 1 if len(outside) else 0
    return first if first < np.size(theta) else None
