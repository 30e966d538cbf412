# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Figures 2 and 6 against plain derivations."""

import math

import numpy as np
import pytest
from matplotlib.path import Path as Polygon

from support.papers_figures import (
    C_UNI,
    block_points,
    cross,
    lines_by_label,
)

# Figure 2


def level(points, c=C_UNI):
    """Evaluate the left side of (3), forces in f_max, moments in f_max cm."""
    f_x, f_y, m = np.moveaxis(np.asarray(points), -1, 0)
    return f_x**2 + f_y**2 + (m / c) ** 2


def sphere(count=60):
    longitude, z = np.meshgrid(
        np.linspace(0.0, 2.0 * math.pi, count), np.linspace(-1.0, 1.0, count)
    )
    rho = np.sqrt(1.0 - z**2)
    return np.stack([rho * np.cos(longitude), rho * np.sin(longitude), z], axis=-1).reshape(-1, 3)


def arrows_of(axes):
    return [artist for artist in axes.get_children() if hasattr(artist, 'ends')]


@pytest.fixture(scope='module')
def wrench_and_twist(figures):
    """Return p and q: the two bold arrows, one from the origin and one from the other's tip."""
    bold = [a for a in arrows_of(figures[2].axes[0]) if a.get_linewidth() > 1.0]
    (_, p), (start, end) = (arrow.ends for arrow in bold)
    assert bold[0].ends[0] == pytest.approx([0.0, 0.0, 0.0])
    assert start == pytest.approx(p)
    return p, end - start


def test_wrench_of_figure_2_is_on_the_ellipsoid(wrench_and_twist):
    p, _ = wrench_and_twist
    assert level(p) == pytest.approx(1.0, abs=1e-4)
    assert np.abs(p).min() > 0.1  # nothing special


def test_twist_of_figure_2_is_the_unit_normal(wrench_and_twist):
    p, q = wrench_and_twist
    assert np.linalg.norm(q) == pytest.approx(1.0)
    # No wrench on the surface is further out along q: p supplies the greatest power.
    surface = sphere(400) * (1.0, 1.0, C_UNI)
    assert (surface @ q).max() == pytest.approx(p @ q, rel=1e-3)
    assert (surface @ q).max() <= p @ q * (1.0 + 1e-4)
    assert p[0] * q[1] == pytest.approx(p[1] * q[0])  # v is parallel to f
    assert np.degrees(np.arccos(p @ q / np.linalg.norm(p))) > 15.0  # but q not to p


def test_square_of_figure_2_touches_at_the_wrench_at_right_angles_to_the_twist(
    figures, wrench_and_twist
):
    p, q = wrench_and_twist
    square = next(c for c in figures[2].axes[0].collections if c.get_zorder() == 4)
    corners = np.array(square._faces[0])
    assert corners.mean(axis=0) == pytest.approx(p)
    assert (corners - p) @ q == pytest.approx(np.zeros(4), abs=1e-12)


def test_lines_of_figure_2_lie_on_the_ellipsoid_and_its_outline_holds_it(figures):
    axes = figures[2].axes[0]
    long = [np.array(line.get_data_3d()).T for line in axes.get_lines()]
    long = [points[~np.isnan(points).any(axis=1)] for points in long if len(points) > 100]
    assert len(long) >= 10
    for points in long:
        assert level(points) == pytest.approx(np.ones(len(points)), abs=1e-4)
    circle = [points for points in long if np.abs(points[:, 2]).max() < 1e-9]
    assert len(circle) == 2  # in front and, dashed, behind
    # Outline: nothing of the surface is drawn outside of it, and some of it right beside it.
    outline = next(line for line in axes.get_lines() if line.get_zorder() == 3.5)
    figures[2].canvas.draw()
    drawn = Polygon(axes.transData.transform(outline.get_xydata()))
    surface = sphere() * (1.0, 1.0, C_UNI)
    ones = np.ones((len(surface), 1))
    projected = np.hstack([surface, ones]) @ axes.get_proj().T
    at = axes.transData.transform(projected[:, :2] / projected[:, 3:])
    middle = at.mean(axis=0)
    assert drawn.contains_points(middle + 0.999 * (at - middle)).all()
    assert not drawn.contains_points(middle + 1.02 * (at - middle)).all()


def test_axes_of_figure_2_say_where_the_surface_ends(figures):
    texts = [text.get_text().strip() for text in figures[2].axes[0].texts]
    assert texts.count('1') == 2
    assert '1.87' in texts
    assert sum('[' in text for text in texts) == 3


# Figure 6


def sections(figures):
    """Return the ellipsoid's and the exact section as arrays of shape (2, N)."""
    lines = lines_by_label(figures[6].axes[0])
    return np.array(lines['ellipsoid'].get_data()), np.array(
        lines['uniform pressure, exact'].get_data()
    )


def test_sections_meet_on_the_axes(figures):
    for f_y, m in sections(figures):
        assert (f_y[0], m[0]) == pytest.approx((1.0, 0.0), abs=1e-9)
        assert (f_y[-1], m[-1]) == pytest.approx((0.0, 1.0), abs=1e-4)


def test_ellipsoid_is_a_circle_when_normalised(figures):
    (f_y, m), _ = sections(figures)
    assert np.hypot(f_y, m) == pytest.approx(np.ones(len(m)))


def test_exact_section_is_convex_and_inside_the_ellipsoid(figures):
    _, (f_y, m) = sections(figures)
    radius = np.hypot(f_y, m)
    assert radius.max() < 1.0 + 1e-4
    assert radius[5:-5].max() < 1.0
    assert 0.06 < 1.0 / radius.min() - 1.0 < 0.07
    # Not inside the straight line between the ends, for it is convex.
    assert (f_y + m)[1:-1].min() > 1.0
    turning = cross(np.diff([f_y, m])[:, :-1], np.diff([f_y, m])[:, 1:])
    assert turning.min() > -1e-7


@pytest.mark.parametrize('centre', [0.3, 1.0, 2.0, 4.0, 15.0])
def test_exact_section_holds_the_friction_of_rotations(figures, centre):
    # Turning about a point on the x axis, left of the centre: every element resists.
    x, y = block_points()
    u_x, u_y = -y, x + centre
    speed = np.hypot(u_x, u_y)
    force, moment = (u_y / speed).mean(), ((x * u_y - y * u_x) / speed).mean() / C_UNI
    assert (u_x / speed).mean() == pytest.approx(0.0, abs=1e-12)
    _, (f_y, m) = sections(figures)
    angle = np.arctan2(m, f_y)
    drawn = np.interp(math.atan2(moment, force), angle, np.hypot(f_y, m))
    assert drawn == pytest.approx(math.hypot(force, moment), abs=3e-4)


def test_figure_6_gives_the_length_that_scales_its_moments(figures):
    assert any(f'{C_UNI:.2f}' in text.get_text() for text in figures[6].axes[0].texts)
