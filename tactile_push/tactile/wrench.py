# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Where a hemispherical tip is touched, from force and moment of a sensor under it.

A contact presses on the tip at one point and may twist about the normal there, as a soft one does.
Its force f and its moment about the tip's centre, m = R n × f + t n, tell the normal n, which leads
out of the tip, and the torsion t. From m · f = t (n · f) and |m|² = R² (|f|² - (n · f)²) + t²,

    t⁴ + (R² |f|² - |m|²) t² - R² (m · f)² = 0,

whose positive root is t². As the contact presses, s = n · f < 0; then n is the only solution of
m = t n - R f × n, which is linear.

References
----------
A. Bicchi, J. K. Salisbury and D. L. Brock, "Contact sensing from force measurements", The
International Journal of Robotics Research 12 (3), 249-262, 1993.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from tactile_push.tactile.reading import Reading
from tactile_push.tactile.sphere import angles_of

LEAST_FORCE, MOST_FORCE = 1e-9, 1e9  # far below and above what any sensor tells [N]

Vector = npt.NDArray[np.float64]


@dataclass(frozen=True)
class WrenchContact:
    """A contact that presses on the tip, in the tip's frame: z along the pole, azimuth from x."""

    normal: Vector  #: unit vector out of the tip at the contact, shape (3,)
    normal_force: float  #: by which the contact presses, positive [N]
    tangential_force: float  #: along the tip's surface, 0 or more [N]
    torsion: float  #: moment about `normal` that no force at the contact explains [N m]

    @property
    def reading(self) -> Reading:
        """Azimuth and elevation; below 0 for a contact on the rim's far side."""
        azimuth, elevation = map(float, angles_of(self.normal))
        return Reading(azimuth, elevation, self.normal_force)


def axes_of_rpy(rpy: Sequence[float]) -> Vector:
    """Return the axes of a frame that is turned by roll, pitch and yaw, as in a URDF.

    Parameters
    ----------
    rpy : sequence of float
        Angles about the fixed axes x, then y, then z [rad].

    Returns
    -------
    ndarray, shape (3, 3)
        The frame's axes as columns.
    """
    (sr, sp, sy), (cr, cp, cy) = np.sin(rpy), np.cos(rpy)
    return np.array(
        [
            [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
            [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
            [-sp, cp * sr, cp * cr],
        ]
    )


def contact_of_wrench(
    force: npt.ArrayLike, moment: npt.ArrayLike, centre: npt.ArrayLike, radius: float
) -> WrenchContact:
    """Find the contact that explains a wrench.

    Parameters
    ----------
    force : array_like, shape (3,)
        Force on the tip [N], in the tip's axes.
    moment : array_like, shape (3,)
        Its moment about the sensor's origin [N m].
    centre : array_like, shape (3,)
        Centre of the hemisphere from the sensor's origin [m].
    radius : float
        Radius of the hemisphere [m].

    Returns
    -------
    WrenchContact
        The contact. Its torsion is what a soft contact may add; a large one tells of something
        else, such as two contacts or one beside the hemisphere.

    Raises
    ------
    ValueError
        If a number is not finite, the radius not positive, or the force out of all proportion.
    """
    f, p = np.asarray(force, float), np.asarray(centre, float)
    m = np.asarray(moment, float) - np.cross(p, f)
    if not (math.isfinite(radius) and radius > 0.0):
        raise ValueError(f'radius: expected a positive length [m], got {radius}')
    if f.shape != (3,) or m.shape != (3,) or not (np.isfinite(f).all() and np.isfinite(m).all()):
        raise ValueError(f'expected force, moment and centre of three finite numbers, got {f}, {m}')
    if not LEAST_FORCE <= math.hypot(*f) <= MOST_FORCE:
        raise ValueError(f'force: expected {LEAST_FORCE:g} to {MOST_FORCE:g} N, got {f}')
    square = float(f @ f)
    along, excess = float(m @ f), radius**2 * square - float(m @ m)
    root = math.hypot(excess, 2.0 * radius * along)
    # The positive root, by the way without a difference of nearly equal numbers.
    if excess <= 0.0:
        t_squared = (root - excess) / 2.0
        s_squared = along**2 / t_squared if t_squared > 0.0 else 0.0
    else:
        s_squared = (root + excess) / (2.0 * radius**2)
        t_squared = along**2 / s_squared
    s, torsion = -math.sqrt(s_squared), -math.copysign(math.sqrt(t_squared), along)
    n = radius * np.cross(f, m) + torsion * m + radius**2 * s * f
    n /= t_squared + radius**2 * square
    tangential = math.sqrt(max(square - s_squared, 0.0))
    return WrenchContact(n, -s, tangential, torsion)


def angle_noise(
    normal: npt.ArrayLike,
    normal_force: float,
    centre: npt.ArrayLike,
    radius: float,
    force_noise: float,
    moment_noise: float,
) -> float:
    """Compute how noise of the sensor spreads the direction in which the contact is found.

    A change of force and moment moves the line on which the contact lies, and the contact by
    (moment about it)/(normal force), along the tip's surface.

    Parameters
    ----------
    normal : array_like, shape (3,)
        Unit vector out of the tip at the contact.
    normal_force : float
        By which the contact presses [N].
    centre : array_like, shape (3,)
        Centre of the hemisphere from the sensor's origin [m].
    radius : float
        Radius of the hemisphere [m].
    force_noise, moment_noise : float
        Standard deviations of each component [N, N m], independent.

    Returns
    -------
    float
        Root of the mean square of the angle in one direction along the surface [rad].
    """
    n = np.asarray(normal, float)
    contact = np.asarray(centre, float) + radius * n
    # Of the moment about the contact, only what is across the normal counts: of the two directions
    # across, n × f has the contact's height over the sensor as its lever in both, and what lies
    # beside the normal in one.
    height = float(contact @ n)
    beside = float(contact @ contact) - height**2
    lever_square = height**2 + beside / 2.0
    return math.sqrt(moment_noise**2 + lever_square * force_noise**2) / (radius * normal_force)
