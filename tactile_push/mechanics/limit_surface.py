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
"""The ellipsoidal limit surface of a sliding object (Section II.B)."""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt


@dataclass(frozen=True)
class EllipsoidalLimitSurface:
    """The ellipsoid (3) that stands for the limit surface.

    Parameters
    ----------
    f_max : float
        Greatest frictional force, in pure translation [N], eq. (2).
    m_max : float
        Greatest frictional moment about the centre of mass, in pure rotation [N m], eq. (1).

    Raises
    ------
    ValueError
        If one of them is not positive and finite.
    """

    f_max: float
    m_max: float

    def __post_init__(self) -> None:
        for name in ('f_max', 'm_max'):
            value = getattr(self, name)
            if not (np.isfinite(value) and value > 0.0):
                raise ValueError(f'{name}: expected a positive finite number, got {value}')

    @property
    def c(self) -> float:
        """The ratio m_max / f_max [m] of eqs. (4) and (5)."""
        return self.m_max / self.f_max

    def level(self, wrench: npt.ArrayLike) -> float:
        """Evaluate the left side of (3): below 1 the object rests, at 1 it slides.

        Parameters
        ----------
        wrench : array_like, shape (3,)
            Applied force and moment (f_x, f_y, m) [N, N, N m] about the centre of mass.

        Returns
        -------
        float
            Value of the quadratic form, without unit.
        """
        f_x, f_y, m = np.asarray(wrench, dtype=float)
        return float((f_x**2 + f_y**2) / self.f_max**2 + m**2 / self.m_max**2)

    def twist(self, wrench: npt.ArrayLike) -> npt.NDArray[np.float64]:
        """Give the direction of motion under a wrench on the surface, eqs. (4) and (5).

        Parameters
        ----------
        wrench : array_like, shape (3,)
            Applied force and moment (f_x, f_y, m) [N, N, N m] about the centre of mass.

        Returns
        -------
        ndarray, shape (3,)
            Outward normal of the ellipsoid, scaled to (f_x, f_y, m / c**2): the velocity
            (v_x, v_y, omega) up to a positive factor.
        """
        f_x, f_y, m = np.asarray(wrench, dtype=float)
        return np.array([f_x, f_y, m / self.c**2])

    def wrench(self, twist: npt.ArrayLike) -> npt.NDArray[np.float64]:
        """Give the wrench on the surface that keeps a motion going.

        Parameters
        ----------
        twist : array_like, shape (3,)
            Velocity (v_x, v_y, omega) [m/s, m/s, rad/s] of the centre of mass, not zero.

        Returns
        -------
        ndarray, shape (3,)
            Force and moment (f_x, f_y, m) [N, N, N m] whose level is 1.

        Raises
        ------
        ValueError
            If the twist is zero: a resting object does not tell its wrench.
        """
        v_x, v_y, omega = np.asarray(twist, dtype=float)
        direction = np.array([v_x, v_y, self.c**2 * omega])
        level = self.level(direction)
        if not level > 0.0:
            raise ValueError(f'twist: expected a motion that is not zero, got {twist!r}')
        return direction / np.sqrt(level)
