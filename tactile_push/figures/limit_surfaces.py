# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Figures 2 and 6 of the paper: limit surfaces (Section II.B)."""

import math
from typing import Any

import matplotlib.figure
import numpy as np
import numpy.typing as npt
from matplotlib.backend_bases import RendererBase
from matplotlib.patches import FancyArrowPatch
from mpl_toolkits.mplot3d import Axes3D  # type: ignore[import-untyped]
from mpl_toolkits.mplot3d.art3d import Poly3DCollection  # type: ignore[import-untyped]
from mpl_toolkits.mplot3d.proj3d import proj_transform  # type: ignore[import-untyped]

from tactile_push.figures.style import (
    BLACK,
    BLUE,
    CENTIMETRE,
    ONE_COLUMN,
    ORANGE,
    PALE,
    RED,
    new_figure,
    styled,
)
from tactile_push.mechanics import (
    EllipsoidalLimitSurface,
    ExactLimitSurface,
    LimitSurface,
    Outline,
    Support,
)
from tactile_push.mechanics.compiled import Array
from tactile_push.paper import BLOCK_DEPTH, BLOCK_EDGE

BLOCK = Outline.rectangle(BLOCK_EDGE, BLOCK_DEPTH)
ELEVATION, AZIMUTH = 20.0, 38.0  # where fig. 2 is seen from [deg]
LONGITUDE, LATITUDE = 1.35, 0.6  # of the wrench of fig. 2 on the unit sphere [rad]
SECTION_POINTS = 10_000  # that stand for the uniform pressure


class _Arrow(FancyArrowPatch):
    """An arrow in space, drawn as one in the plane of the picture."""

    def __init__(self, start: npt.ArrayLike, end: npt.ArrayLike, **style: Any) -> None:
        super().__init__(
            (0.0, 0.0), (0.0, 0.0), arrowstyle='-|>', shrinkA=0.0, shrinkB=0.0, **style
        )
        self.ends = np.array([start, end], dtype=float)

    def do_3d_projection(self, renderer: RendererBase | None = None) -> float:
        assert isinstance(self.axes, Axes3D)
        x, y, depth = proj_transform(*self.ends.T, self.axes.M)
        self.set_positions((x[0], y[0]), (x[1], y[1]))
        return float(np.min(depth))


@styled
def limit_surface_figure() -> matplotlib.figure.Figure:
    """Draw figure 2: an ellipsoidal limit surface with a wrench p and its unit twist q.

    The surface (3) is that of the paper's block under a uniform pressure, c = 1.87 cm, with forces
    in units of f_max and moments in units of f_max cm. With the same centimetre for the angular
    velocity, the space of velocities (v_x, v_y, omega cm) is aligned with that of forces, and the
    velocity q is normal to the surface at p: to the square, which lies in the tangent plane. Its
    horizontal part is parallel to the force f, the horizontal part of p, though q is not parallel
    to p. The bold circle of radius f_max is the section m = 0: pure translations. The pole at
    m_max = c f_max is a pure rotation.

    Returns
    -------
    matplotlib.figure.Figure
        The figure, one column wide.
    """
    surface = EllipsoidalLimitSurface(1.0, CENTIMETRE * Support.uniform(BLOCK).c)
    figure = new_figure(ONE_COLUMN, 3.3)
    axes: Axes3D = figure.add_subplot(projection='3d', computed_zorder=False)
    axes.set_proj_type('ortho')
    axes.view_init(ELEVATION, AZIMUTH)
    axes.set_axis_off()
    _draw_ellipsoid(axes, surface)
    _draw_axes(axes, surface)
    _draw_wrench(axes, surface)
    axes.set(xlim=(-1.7, 1.7), ylim=(-1.7, 1.7), zlim=(-1.9, 2.6))
    axes.set_box_aspect((3.4, 3.4, 4.5), zoom=1.43)
    return figure


def _draw_ellipsoid(axes: Axes3D, surface: EllipsoidalLimitSurface) -> None:
    """Draw outline, parallels and meridians; what is behind is dashed or left out."""
    half_axes = np.array([surface.f_max, surface.f_max, surface.m_max])
    view = _on_sphere(math.radians(AZIMUTH), math.radians(ELEVATION))
    # On the outline, the normal u / half_axes is at right angles to the view.
    across = np.cross(view / half_axes, (0.0, 0.0, 1.0))
    across /= np.linalg.norm(across)
    up = np.cross(across, view / half_axes)
    up /= np.linalg.norm(up)
    turn = np.linspace(0.0, 2.0 * math.pi, 361)
    outline = half_axes * (np.outer(np.cos(turn), across) + np.outer(np.sin(turn), up))
    axes.add_collection3d(Poly3DCollection([outline], facecolors='#E4EEF5', zorder=1))
    axes.plot(*outline.T, color=BLACK, linewidth=0.8, zorder=3.5)
    parallels = [_on_sphere(turn, math.radians(degrees)) for degrees in (-60, -30, 0, 30, 60)]
    meridians = [_on_sphere(math.radians(degrees), turn) for degrees in range(0, 180, 30)]
    for number, circle in enumerate(parallels + meridians):
        curve = half_axes * circle
        bold = number == 2
        front = curve @ (view / half_axes**2) >= 0.0
        style: dict[str, Any] = {
            'color': BLACK if bold else PALE,
            'linewidth': 1.1 if bold else 0.5,
        }
        axes.plot(*np.where(front[:, np.newaxis], curve, np.nan).T, zorder=3, **style)
        if bold:
            style['linestyle'] = (0, (3, 2))
            axes.plot(*np.where(front[:, np.newaxis], np.nan, curve).T, zorder=2, **style)


def _draw_axes(axes: Axes3D, surface: EllipsoidalLimitSurface) -> None:
    """Draw the axes, dashed inside the surface, and where they leave it."""
    for k, (radius, reach, label, align) in enumerate(
        (
            (surface.f_max, 1.9, r'$f_x$ [$f_{\max}$]', 'right'),
            (surface.f_max, 1.9, r'$f_y$ [$f_{\max}$]', 'left'),
            (surface.m_max, 2.45, r'$m$ [$f_{\max}\,$cm]', 'left'),
        )
    ):
        direction = np.eye(3)[k]
        pole, end = radius * direction, reach * direction
        axes.plot(*zip((0.0, 0.0, 0.0), pole, strict=True), color=BLACK, lw=0.6, ls=(0, (4, 3)))
        axes.add_artist(_Arrow(pole, end, mutation_scale=7.0, linewidth=0.7, color=BLACK))
        axes.plot(*pole[:, np.newaxis], 'o', color=BLACK, markersize=2.5, zorder=5)
        space = '  ' if align == 'left' else ''
        axes.text(*end, space + label + space, ha=align, va='center')
        below = 'bottom' if k == 2 else 'top'
        axes.text(*pole, f' {radius:.3g}', ha='left', va=below, zorder=6)


def _draw_wrench(axes: Axes3D, surface: EllipsoidalLimitSurface) -> None:
    """Draw a wrench with its force, its twist and the tangent plane that the twist is normal to."""
    half_axes = np.array([surface.f_max, surface.f_max, surface.m_max])
    p = half_axes * _on_sphere(LONGITUDE, LATITUDE)
    q = surface.twist(p)
    q /= np.linalg.norm(q)
    f = p * (1.0, 1.0, 0.0)
    across = np.cross((0.0, 0.0, 1.0), q)
    across /= np.linalg.norm(across)
    up = np.cross(q, across)
    square = [p + 0.3 * (i * across + j * up) for i, j in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    axes.add_collection3d(
        Poly3DCollection([square], facecolors='white', edgecolors=BLACK, linewidths=0.6, zorder=4)
    )
    axes.plot(*zip((0.0, 0.0, 0.0), f, p, strict=True), color=BLUE, lw=0.8, ls=':', zorder=5)
    axes.text(*(0.55 * f), '$\\mathbf{f}$ ', color=BLUE, ha='right', va='top', zorder=6)
    bold = {'mutation_scale': 9.0, 'linewidth': 1.5, 'zorder': 6}
    axes.add_artist(_Arrow((0.0, 0.0, 0.0), p, color=BLUE, **bold))
    axes.add_artist(_Arrow(p, p + q, color=RED, **bold))
    axes.text(*(0.5 * p), '$\\mathbf{p}$  ', color=BLUE, ha='right', va='bottom', zorder=6)
    axes.text(*(p + q), r'  $\hat{\mathbf{q}}$', color=RED, ha='left', va='center', zorder=6)


def _on_sphere(longitude: npt.ArrayLike, latitude: npt.ArrayLike) -> Array:
    """Return points on the unit sphere, of shape (..., 3)."""
    return np.stack(
        np.broadcast_arrays(
            np.cos(latitude) * np.cos(longitude),
            np.cos(latitude) * np.sin(longitude),
            np.sin(latitude),
        ),
        axis=-1,
    )


@styled
def section_figure() -> matplotlib.figure.Figure:
    """Draw figure 6: the section f_x = 0 of the exact limit surface and of the ellipsoid.

    Both are those of the paper's block, 5 cm x 4.75 cm, under a uniform pressure, for which
    m_max = 1.87 cm f_max. They are symmetric about both axes, so a quadrant is enough. They meet
    on the axes, where (1) and (2) fix the ellipsoid: pure translations and pure rotations are
    exact. In between the exact surface lies inside the ellipsoid, which promises up to 7 % more
    friction than there is.

    Returns
    -------
    matplotlib.figure.Figure
        The figure, one column wide.
    """
    support = Support.uniform(BLOCK, SECTION_POINTS)
    ellipsoid = EllipsoidalLimitSurface(support.f_max, support.m_max)
    curves: list[tuple[LimitSurface, dict[str, Any]]] = [
        (ellipsoid, {'label': 'ellipsoid', 'color': ORANGE, 'linestyle': '--'}),
        (ExactLimitSurface(support), {'label': 'uniform pressure, exact', 'color': BLUE}),
    ]
    figure = new_figure(ONE_COLUMN, 3.1)
    axes = figure.add_subplot()
    for surface, style in curves:
        # Rotations about points on the x axis: v_x = 0.
        wrenches = np.array(
            [
                surface.wrench((0.0, support.c * math.cos(mix), math.sin(mix)))
                for mix in np.linspace(0.0, math.pi / 2.0, 91)
            ]
        )
        axes.plot(wrenches[:, 1] / support.f_max, wrenches[:, 2] / support.m_max, **style)
    axes.set_xlabel(r'force $f_y\;/\;f_{\max}$ [–]')
    axes.set_ylabel(r'moment $m\;/\;m_{\max}$ [–]')
    axes.set(xlim=(0.0, 1.05), ylim=(0.0, 1.05), aspect='equal')
    axes.legend(loc='lower left', bbox_to_anchor=(0.05, 0.3))
    c = CENTIMETRE * support.c
    axes.text(0.09, 0.26, rf'$f_x = 0$,  $m_{{\max}} = {c:.2f}\,$cm $f_{{\max}}$')
    return figure
