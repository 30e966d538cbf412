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
"""Support of an object and the ratio c = m_max / f_max, eqs. (1) and (2).

mu_s and the object's weight scale m_max and f_max alike, so c depends on where the support
lies and on nothing else: it is the mean distance of the support pressure from the centre of mass.
"""

import math

import numpy as np
import numpy.typing as npt


def c_points(points: npt.ArrayLike, weights: npt.ArrayLike | None = None) -> float:
    """Give c of an object that stands on points.

    Parameters
    ----------
    points : array_like, shape (N, 2)
        Support points relative to the centre of mass [m].
    weights : array_like, shape (N,), optional
        Share of the load that each point carries, in any unit; equal by default.

    Returns
    -------
    float
        c [m].

    Raises
    ------
    ValueError
        If the shapes do not fit, a number is not finite, a weight is negative or all are zero.
    """
    p = np.asarray(points, dtype=float)
    if p.ndim != 2 or p.shape[1] != 2 or len(p) == 0 or not np.isfinite(p).all():
        raise ValueError(f'points: expected finite points of shape (N, 2), got shape {p.shape}')
    w = np.ones(len(p)) if weights is None else np.asarray(weights, dtype=float)
    if w.shape != (len(p),) or not np.isfinite(w).all() or (w < 0.0).any() or not w.sum() > 0.0:
        raise ValueError(f'weights: expected {len(p)} weights of 0 or more, not all 0, got {w}')
    return float(w @ np.hypot(p[:, 0], p[:, 1]) / w.sum())


def c_uniform_circle(radius: float) -> float:
    """Give c of a load spread evenly over a circle about the centre of mass: 2/3 of its radius.

    Parameters
    ----------
    radius : float
        Radius of the circle [m], positive.

    Returns
    -------
    float
        c [m].

    Raises
    ------
    ValueError
        If the radius is not positive.
    """
    if not (math.isfinite(radius) and radius > 0.0):
        raise ValueError(f'radius: expected a positive length [m], got {radius}')
    return 2.0 * radius / 3.0


def c_uniform_rectangle(width: float, height: float) -> float:
    """Give c of a load spread evenly over a rectangle whose centre is the centre of mass.

    The centre divides the rectangle into right triangles with one leg h from the centre to a
    side and one leg w along the side. Over such a triangle the integral (1) of the distance is
    h^3/6 (tan sec + asinh tan) at the angle whose tangent is w/h.

    Parameters
    ----------
    width, height : float
        Sides of the rectangle [m], positive.

    Returns
    -------
    float
        c [m].

    Raises
    ------
    ValueError
        If a side is not positive.
    """
    for name, value in (('width', width), ('height', height)):
        if not (math.isfinite(value) and value > 0.0):
            raise ValueError(f'{name}: expected a positive length [m], got {value}')

    def triangle(h: float, w: float) -> float:
        tangent = w / h
        return h**3 / 6.0 * (tangent * math.hypot(1.0, tangent) + math.asinh(tangent))

    a, b = width / 2.0, height / 2.0
    return (triangle(a, b) + triangle(b, a)) / (a * b)
