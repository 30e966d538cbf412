# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import math

import numpy as np
import pytest

from tactile_push.estimation import edges_of
from tactile_push.estimation.prior import Prior
from tactile_push.mechanics import Outline
from tactile_push.mechanics.contact import piece_at

RECTANGLE = [(-0.025, -0.02375), (0.025, -0.02375), (0.025, 0.02375), (-0.025, 0.02375)]
TRIANGLE = [(-0.03, -0.015), (0.04, -0.02), (-0.01, 0.035)]


def test_a_rectangle_has_two_pairs_of_edges():
    edges = edges_of(RECTANGLE)

    assert [edge.number for edge in edges] == [0, 1, 2, 3]
    for edge, length, l in zip(edges, (0.05, 0.0475) * 2, (0.02375, 0.025) * 2, strict=True):
        assert edge.d == pytest.approx((-length / 2.0, length / 2.0))
        assert edge.length == pytest.approx(length)
        assert edge.l == pytest.approx(l)
    assert [edge.angle for edge in edges] == pytest.approx([i * math.pi / 2.0 for i in range(4)])
    assert edges[0].same_place(edges[2], 1e-9)
    assert not edges[0].same_place(edges[1], 1e-9)


def test_moments_are_those_of_the_area_in_the_frame_of_the_edge():
    # Of a rectangle as its sides squared; of a triangle as those of its corners.
    ratio = 5.0 / 4.75
    assert edges_of(RECTANGLE)[0].moments == pytest.approx((ratio, 0.0, 1.0 / ratio))
    assert edges_of(RECTANGLE)[1].moments == pytest.approx((1.0 / ratio, 0.0, ratio))
    covariance = np.cov(np.array(TRIANGLE).T)
    for edge in edges_of(TRIANGLE):
        t = np.array([math.cos(edge.angle), math.sin(edge.angle)])
        n = np.array([-t[1], t[0]])
        expected = np.array([t @ covariance @ t, t @ covariance @ n, n @ covariance @ n])
        expected /= math.sqrt(np.linalg.det(covariance))
        assert edge.moments == pytest.approx(expected)
        principal = np.linalg.eigvalsh(covariance)
        prior = Prior(edge.d, edge.l, moments=edge.moments)
        assert prior.slenderness == pytest.approx(principal[1] / principal[0])


def test_ends_of_edges_are_the_corners():
    # In the object's frame the contact is d t - l n from the centre of mass.
    for edge, start, end in zip(
        edges_of(TRIANGLE), TRIANGLE, TRIANGLE[1:] + TRIANGLE[:1], strict=True
    ):
        t = np.array([math.cos(edge.angle), math.sin(edge.angle)])
        n = np.array([-t[1], t[0]])
        assert edge.d[0] * t - edge.l * n == pytest.approx(np.array(start), abs=1e-15)
        assert edge.d[1] * t - edge.l * n == pytest.approx(np.array(end), abs=1e-15)


def test_the_edges_are_those_of_the_outline():
    r = 0.0135
    path = Outline.polygon(TRIANGLE).path(r)
    for edge in edges_of(TRIANGLE):
        sigma = Outline.polygon(TRIANGLE).sigma(r, edge.angle, sum(edge.d) / 2.0)
        assert piece_at(sigma, path) == 2 * edge.number  # edges and corners by turns


@pytest.mark.parametrize(
    'vertices',
    [
        RECTANGLE[::-1],
        RECTANGLE[:2],
        [(-0.02, -0.02), (0.0, -0.02), (0.02, -0.02), (0.0, 0.02)],
        [(-0.02, -0.02), (0.02, -0.02), (0.0, 0.0), (0.02, 0.02), (-0.02, 0.02)],
        [(x + 0.1, y) for x, y in RECTANGLE],
        [(math.nan, 0.0), (0.1, 0.0), (0.0, 0.1)],
    ],
)
def test_vertices_that_are_none_are_refused(vertices):
    with pytest.raises(ValueError, match='vertices'):
        edges_of(vertices)
