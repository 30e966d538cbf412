# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Figure 3 of the paper: motion cones (Section II.C)."""

import math
from typing import Any

import matplotlib.figure
import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Patch, Wedge

from tactile_push.figures.style import (
    BLACK,
    BLUE,
    CENTIMETRE,
    ORANGE,
    PALE_BLUE,
    RED,
    TWO_COLUMNS,
    new_figure,
    styled,
)
from tactile_push.mechanics import Outline, Support, friction_cone, motion_cone

SIDE = 0.05  # of the square [m]
CONTACTS = np.linspace(-0.45, 0.45, 5) * SIDE  # d [m]
FRICTIONS = (0.0, 0.5, 2.0, math.inf)
LENGTH = 0.54  # of a cone's edges: directions count alone [cm]
RAY, PULL = 12.0, -14.0  # directions of the two notes' arrows [deg]
CONE: dict[str, Any] = {'facecolor': PALE_BLUE, 'linewidth': 0.0}
PULLING: dict[str, Any] = {
    'facecolor': '#FBE3B0',
    'edgecolor': ORANGE,
    'hatch': '////////',
    'linewidth': 0.0,
}


@styled
def motion_cone_figure() -> matplotlib.figure.Figure:
    """Draw figure 3: motion cones of a square for several coefficients of friction mu_c.

    The lower part of a square of side 5 cm on the ellipsoid of a uniform pressure, c = 1.91 cm,
    pushed at five contacts of its bottom edge; mu_c is 0, 0.5, 2 and infinite. A cone holds the
    velocities that a force inside the friction cone gives to the contact; their lengths mean
    nothing. Without friction it is a ray, which leans away from the centre of mass: the contact
    gives way. With mu_c it opens, up to a half-plane, 180 degrees, for infinite mu_c.

    Two effects are marked there. 1) The dashed ray of pushing lies outside the half-plane: the
    contact slips although the friction is infinite. 2) The hatched parts of cones, below the edge,
    move the contact against its normal: a finger with such a velocity pulls the object. They appear
    from mu_c = 2 c / l = 1.53 on.

    Returns
    -------
    matplotlib.figure.Figure
        The figure, two columns wide.
    """
    square = Outline.rectangle(SIDE, SIDE)
    c = Support.uniform(square).c
    figure = new_figure(TWO_COLUMNS, 4.2)
    panels = figure.subplots(2, 2, sharex=True, sharey=True)
    for axes, mu_c, letter in zip(panels.flat, FRICTIONS, 'abcd', strict=True):
        _draw_square(axes)
        for d in CONTACTS:
            _draw_cone(axes, d, mu_c, c)
        value = r'\infty' if math.isinf(mu_c) else f'{mu_c:g}'
        axes.text(-2.3, 0.35, rf'({letter})  $\mu_c = {value}$', va='top')
        axes.set(xlim=(-3.6, 3.6), ylim=(-3.2, 0.6), aspect='equal')
        axes.set(xticks=range(-3, 4), yticks=range(-3, 1))
    _draw_notes(panels[1, 1])
    panels[0, 1].legend(
        [Patch(**CONE), Patch(**PULLING)],
        ['motion cone', 'part against the normal'],
        loc='center',
        bbox_to_anchor=(0.5, 0.58),
    )
    for axes in panels[:, 0]:
        axes.set_ylabel('$y$ [cm]')
    for axes in panels[1]:
        axes.set_xlabel('$x$ [cm]')
    return figure


def _draw_square(axes: Axes) -> None:
    """Draw the square about its centre of mass; its upper part is cut off by the panel."""
    half = CENTIMETRE * SIDE / 2.0
    axes.fill(
        [-half, half, half, -half], [-half, -half, half, half], facecolor='0.95', edgecolor=BLACK
    )
    axes.plot(0.0, 0.0, marker='+', color=BLACK, markersize=6.0, label='_CM')
    axes.annotate('CM', (0.0, 0.0), xytext=(5.0, 3.0), textcoords='offset points')


def _draw_cone(axes: Axes, d: float, mu_c: float, c: float) -> None:
    """Draw the motion cone at a contact, with its edges."""
    l = SIDE / 2.0
    v_lx, v_ly, v_rx, v_ry = motion_cone(d, -l, *friction_cone(mu_c), c)
    right = math.degrees(math.atan2(v_ry, v_rx))
    left = right + math.degrees(math.atan2(v_rx * v_ly - v_ry * v_lx, v_rx * v_lx + v_ry * v_ly))
    contact = CENTIMETRE * d, -CENTIMETRE * l
    if left > right:
        axes.add_patch(Wedge(contact, LENGTH, right, left, **CONE))
    for start, end in ((right, 0.0), (180.0, left)):
        if end > start:  # against the normal
            axes.add_patch(Wedge(contact, LENGTH, start, end, **PULLING))
    for direction in (left, right):
        _draw_arrow(axes, contact, direction, LENGTH, color=BLUE)
    axes.plot(*contact, 'o', color=BLACK, markersize=2.5, zorder=4)


def _draw_arrow(
    axes: Axes, start: tuple[float, float], direction: float, length: float, **style: Any
) -> tuple[float, float]:
    """Draw an arrow into a direction [deg] and return its tip."""
    angle = math.radians(direction)
    tip = start[0] + length * math.cos(angle), start[1] + length * math.sin(angle)
    axes.annotate(
        '',
        tip,
        xytext=start,
        arrowprops={
            'arrowstyle': '-|>',
            'mutation_scale': 6.0,
            'linewidth': 1.0,
            'shrinkA': 0.0,
            'shrinkB': 0.0,
            **style,
        },
    )
    return tip


def _draw_notes(axes: Axes) -> None:
    """Mark the two unexpected effects."""
    y = -CENTIMETRE * SIDE / 2.0
    for number, d, direction, style in (
        ('1', CONTACTS[-1], RAY, {'linestyle': (0, (4, 2))}),
        ('2', CONTACTS[0], PULL, {}),
    ):
        x, y_tip = _draw_arrow(
            axes, (CENTIMETRE * d, y), direction, 0.95, color=RED, linewidth=1.3, **style
        )
        axes.annotate(
            number,
            (x, y_tip),
            xytext=(5.0, 0.0),
            textcoords='offset points',
            va='center',
            color=RED,
            fontweight='bold',
        )
    axes.text(-1.7, -0.8, '1  outside the cone: slips', va='center', color=RED)
    axes.text(-1.7, -1.2, '2  inside the cone: pulls', va='center', color=RED)
