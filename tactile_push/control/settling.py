# Copyright 2026 The tactile_push authors
#
# Licensed under the Apache License, Version 2.0 (the "License");
# you may not use this file except in compliance with the License.
# You may obtain a copy of the License at
#
#     http://www.apache.org/licenses/LICENSE-2.0
#
# Unless required by applicable law or agreed to in writing, software
# distributed under the License is distributed on an "AS IS" BASIS,
# WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
# See the License for the specific language governing permissions and
# limitations under the License.
"""How long the law takes."""

import numpy as np
import numpy.typing as npt


def settle_step(theta: npt.ArrayLike, theta_desired: float, band: float) -> int | None:
    """Find the step from which theta stays near its desired value.

    Parameters
    ----------
    theta : array_like, shape (K + 1,)
        Angle of the pushed edge [rad].
    theta_desired : float
        Desired angle [rad].
    band : float
        How near [rad].

    Returns
    -------
    int or None
        The first such step; None if theta is not near at the end.
    """
    outside = np.flatnonzero(~(np.abs(np.asarray(theta) - theta_desired) <= band))
    first = int(outside[-1]) + 1 if len(outside) else 0
    return first if first < np.size(theta) else None
