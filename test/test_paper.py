# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The paper's figures belong to its experiments alone, and its objects are known by their shape."""

import math

import numpy as np
import pytest

from tactile_push.paper import (
    BLOCK,
    BLOCK_CORNERS,
    BLOCK_DEPTH,
    BLOCK_EDGE,
    DISK,
    DISK_RADIUS,
    OTHER,
    object_with,
    paper_figures,
)


# docs/numbers.md: figures 9 and 10 of the paper.
def test_paper_is_beside_what_it_tells_of():
    block = paper_figures(math.radians(-10.0), 'block')
    assert (block.figure, block.settle_step) == ('9', 173)
    assert np.degrees(block.theta_range) == pytest.approx([-10.4, -8.9])
    assert np.degrees(block.phi_range) == pytest.approx([80.2, 85.8])
    assert block.d_range == (0.0003, 0.0021)
    assert math.degrees(block.band) == pytest.approx(3.0)
    disk = paper_figures(0.0, 'disk')
    assert (disk.figure, disk.settle_step) == ('10', 110)
    assert math.degrees(disk.band) == pytest.approx(1.0)
    assert paper_figures(math.radians(-10.0), None) is block
    assert paper_figures(0.0, None) is disk
    assert paper_figures(0.0, 'block') is None
    assert paper_figures(math.radians(-10.0), 'disk') is None
    assert paper_figures(math.radians(20.0), None) is None
    assert paper_figures(math.radians(-10.0), OTHER) is None


@pytest.mark.parametrize(
    ('corners', 'radius', 'expected'),
    [
        (BLOCK_CORNERS, 0.0, BLOCK),
        (BLOCK_CORNERS[2:] + BLOCK_CORNERS[:2], 0.0, BLOCK),  # from another corner on
        ([(x, 1.01 * y) for x, y in BLOCK_CORNERS], 0.0, OTHER),
        (BLOCK_CORNERS[:3], 0.0, OTHER),
        ((), DISK_RADIUS, DISK),
        (BLOCK_CORNERS, DISK_RADIUS, DISK),  # a disk has no corners, whatever they are set to
        ((), 1.01 * DISK_RADIUS, OTHER),
    ],
)
def test_object_is_known_by_its_shape(corners, radius, expected):
    assert object_with(corners, radius) == expected


def test_corners_of_the_block_go_counterclockwise_about_its_centre_from_the_pushed_edge():
    x, y = np.array(BLOCK_CORNERS).T
    assert (x.mean(), y.mean()) == (0.0, 0.0)
    area = 0.5 * (x * np.roll(y, -1) - np.roll(x, -1) * y).sum()
    assert area == pytest.approx(BLOCK_EDGE * BLOCK_DEPTH)
    assert y[0] == y[1] == min(y)  # the finger pushes along +y
