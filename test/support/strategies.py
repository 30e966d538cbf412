# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Hypothesis strategies that several tests draw from."""

import math

import numpy as np
from hypothesis import strategies as st


def frictions(most=5.0):
    """Return a strategy for mu_c: none, infinite, or up to `most`."""
    return st.sampled_from([0.0, math.inf]) | st.floats(1e-3, most)


@st.composite
def loaded_polygons(draw, most_corners=7, least_stretch=0.3, least_load=0.05):
    """Draw a convex polygon's corners and a load on each, with the loads' centre at the origin."""
    shares = np.array(draw(st.lists(st.floats(0.2, 1.0), min_size=3, max_size=most_corners)))
    around = 2.0 * math.pi * np.cumsum(shares) / shares.sum()
    # Points on a circle, stretched and turned.
    turn, stretch = draw(st.floats(-7.0, 7.0)), draw(st.floats(least_stretch, 1.0))
    x, y = 0.04 * np.cos(around), 0.04 * stretch * np.sin(around)
    cos, sin = math.cos(turn), math.sin(turn)
    corners = np.stack([cos * x - sin * y, sin * x + cos * y], axis=1)
    loads = np.array([draw(st.floats(least_load, 1.0)) for _ in shares])
    return corners - loads @ corners / loads.sum(), loads


def convex_polygons():
    """Return a strategy for corners of convex polygons around the origin."""
    return loaded_polygons().map(lambda polygon: polygon[0])


@st.composite
def corners_on_ellipses(draw, most_corners, least_axis):
    """Draw a convex polygon's corners, unevenly around an ellipse about the origin."""
    count = draw(st.integers(3, most_corners))
    jitter = draw(st.lists(st.floats(-0.3, 0.3), min_size=count, max_size=count))
    a, b = draw(st.floats(least_axis, 0.04)), draw(st.floats(least_axis, 0.04))
    angle = (np.arange(count) + jitter) * 2.0 * math.pi / count
    return np.stack([a * np.cos(angle), b * np.sin(angle)], axis=1)
