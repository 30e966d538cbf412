# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""A force/torque sensor under the finger tip, and how it errs."""

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from tactile_push.tactile.wrench import axes_of_rpy

Vector = npt.NDArray[np.float64]
SIX_ZEROS = (0.0,) * 6


@dataclass(frozen=True)
class ForceSensor:
    """How the sensor errs; by default not at all.

    Raises
    ------
    ValueError
        If a number is out of its range or there are not six.
    """

    noise: float = 0.0  #: standard deviation of each component of the force [N]
    moment_noise: float = 0.0  #: standard deviation of each component of the moment [N m]
    offset: tuple[float, ...] = SIX_ZEROS  #: force and moment without a contact [N, N m]
    drift: tuple[float, ...] = SIX_ZEROS  #: how fast the offset changes [N/s, N m/s]

    def __post_init__(self) -> None:
        for name in ('noise', 'moment_noise'):
            value = getattr(self, name)
            if not (math.isfinite(value) and value >= 0.0):
                raise ValueError(f'{name}: expected a finite number of 0 or more, got {value}')
        for name in ('offset', 'drift'):
            value = getattr(self, name)
            if len(value) != 6 or not all(map(math.isfinite, value)):
                raise ValueError(f'{name}: expected six finite numbers, got {list(value)}')


@dataclass(frozen=True)
class Mount:
    """How a hemispherical tip sits on the sensor.

    Raises
    ------
    ValueError
        If there are not three finite numbers each.
    """

    radius: float  #: of the hemisphere [m]
    #: where the frame `fingertip` is in the sensor's: its origin, the hemisphere's centre [m]
    xyz: tuple[float, ...]
    rpy: tuple[float, ...]  #: its roll, pitch and yaw [rad]

    def __post_init__(self) -> None:
        for name in ('xyz', 'rpy'):
            value = getattr(self, name)
            if len(value) != 3 or not all(map(math.isfinite, value)):
                raise ValueError(f'{name}: expected three finite numbers, got {list(value)}')

    def wrench(self, force: tuple[float, float], theta: float, psi: float) -> Vector:
        """Compute what a perfect sensor measures while the tip pushes an upright edge.

        Parameters
        ----------
        force : tuple of float
            What the finger exerts on the object, x and y in `finger_base` [N].
        theta, psi : float
            Angles of the pushed edge and of the tip's pole in `finger_base` [rad].

        Returns
        -------
        ndarray, shape (6,)
            Force and moment on the tip in the sensor's axes and about its origin [N, N m].
        """
        on_tip = -np.array([*force, 0.0])
        normal = np.array([-math.sin(theta), math.cos(theta), 0.0])
        # In finger_base: x of the tip to the left of the pole, y up, z along the pole.
        tip = np.array(
            [
                [-math.sin(psi), math.cos(psi), 0.0],
                [0.0, 0.0, 1.0],
                [math.cos(psi), math.sin(psi), 0.0],
            ]
        )
        axes = axes_of_rpy(self.rpy)
        at_tip = axes @ tip @ on_tip
        contact = np.array(self.xyz) + self.radius * (axes @ tip @ normal)
        return np.array([*at_tip, *np.cross(contact, at_tip)])


class ForceReadout:
    """What the sensor sends. The same seed makes the same run, to the bit.

    Parameters
    ----------
    seed : int
        Seed of the random numbers, 0 or more.
    """

    def __init__(self, seed: int) -> None:
        self._noise = np.random.default_rng(seed)

    def read(self, sensor: ForceSensor, truth: Vector, now: float) -> Vector:
        """Return what a sensor measures that errs.

        Parameters
        ----------
        sensor : ForceSensor
            How it errs.
        truth : ndarray, shape (6,)
            What a perfect one measures [N, N m].
        now : float
            Time since the sensor was switched on [s].

        Returns
        -------
        ndarray, shape (6,)
            Force and moment [N, N m].
        """
        deviations = np.repeat([sensor.noise, sensor.moment_noise], 3)
        noise = deviations * self._noise.standard_normal(6)
        return truth + np.array(sensor.offset) + now * np.array(sensor.drift) + noise
