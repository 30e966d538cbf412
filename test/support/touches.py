# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Wrenches of contacts on a hemispherical tip, by the definition of a moment."""

import math

import numpy as np

RADIUS = 0.0135


def unit(azimuth, elevation):
    across = math.cos(elevation)
    return np.array([across * math.cos(azimuth), across * math.sin(azimuth), math.sin(elevation)])


def tangents(normal):
    """Return two unit vectors along the surface."""
    one = np.cross(normal, [1.0, 0.0, 0.0] if abs(normal[0]) < 0.7 else [0.0, 1.0, 0.0])
    one /= np.linalg.norm(one)
    return one, np.cross(normal, one)


def wrench(normal, pressing, sideways, torsion, centre):
    """Return force and moment about the sensor of a contact that presses, shears and twists."""
    one, other = tangents(normal)
    force = -pressing * normal + sideways[0] * one + sideways[1] * other
    return force, np.cross(centre + RADIUS * normal, force) + torsion * normal
