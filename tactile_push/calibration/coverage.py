# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Which regions of the tip touches have to cover before they say how the whole of it looks."""

import math

import numpy as np
import numpy.typing as npt

from tactile_push.tactile.sphere import angles_of

# Bands of elevation [degrees]; one touch near the pole is enough, the others need one a quarter.
# Three bands tell how a lens bends; thirteen touches give 26 numbers for the 11 of a camera.
POLE, BANDS = (75.0, 90.0), ((50.0, 75.0), (25.0, 50.0), (0.0, 25.0))
# Where to touch [degrees of elevation], and how often around; lower, the rim would hide a part of
# the contact.
SUGGESTED = {62.0: 4, 38.0: 8, 12.0: 8}
# Quarters of the azimuth by the direction in their middle [degrees], as seen along the pole.
QUARTERS = {'left': 0.0, 'up': 90.0, 'right': 180.0, 'down': -90.0}


def missing_regions(directions: npt.ArrayLike) -> list[str]:
    """Return the regions in which no touch lies, in words.

    Parameters
    ----------
    directions : array_like, shape (n, 3)
        Unit vectors to the touches, in the axes of the tip.

    Returns
    -------
    list of str
        Such as ``'left, elevation 0° to 25°'``; empty if the touches cover the tip.
    """
    azimuth, elevation = (np.degrees(angle) for angle in angles_of(directions))
    missing = []
    if not np.any(elevation >= POLE[0]):
        missing.append(f'pole, elevation {POLE[0]:g}° to {POLE[1]:g}°')
    for low, high in BANDS:
        in_band = (low <= elevation) & (elevation < high)
        for name, middle in QUARTERS.items():
            if not np.any(in_band & (abs((azimuth - middle + 180.0) % 360.0 - 180.0) <= 45.0)):
                missing.append(f'{name}, elevation {low:g}° to {high:g}°')
    return missing


def check_coverage(directions: npt.ArrayLike) -> None:
    """Refuse touches that are too few or badly spread.

    Parameters
    ----------
    directions : array_like, shape (n, 3)
        Unit vectors to the touches, in the axes of the tip.

    Raises
    ------
    ValueError
        The message says which are missing.
    """
    missing = missing_regions(np.reshape(directions, (-1, 3)))
    if missing:
        raise ValueError(
            f'touches: expected one in each region of the tip, got none at {"; ".join(missing)}'
        )


def suggested_touches() -> list[tuple[float, float]]:
    """Return places to touch that cover the tip.

    Returns
    -------
    list of tuple of float
        Azimuth and elevation [rad]: the pole, and places around it at each elevation.
    """
    return [(0.0, math.pi / 2.0)] + [
        (math.radians(360.0 * number / count - 180.0), math.radians(elevation))
        for elevation, count in SUGGESTED.items()
        for number in range(1, count + 1)
    ]


def in_words(azimuth: float, elevation: float) -> str:
    """Describe a place of the tip for people.

    Parameters
    ----------
    azimuth, elevation : float
        The place [rad].

    Returns
    -------
    str
        Such as ``'left and up, azimuth 45°, elevation 62°'``, as seen along the pole.
    """
    degrees = math.degrees(azimuth)
    numbers = f'azimuth {degrees:.0f}°, elevation {math.degrees(elevation):.0f}°'
    if math.degrees(elevation) >= POLE[0]:
        return f'pole, {numbers}'
    near = [
        name
        for name, middle in QUARTERS.items()
        if abs(math.remainder(degrees - middle, 360.0)) < 67.5
    ]
    return f'{" and ".join(near)}, {numbers}'
