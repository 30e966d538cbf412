# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Figure 3 against plain derivations."""

import math

import numpy as np
import pytest

from support.papers_figures import (
    C_UNI_SQUARE,
    cross,
)

FRICTIONS = {'0': 0.0, '0.5': 0.5, '2': 2.0, r'\infty': math.inf}


def panels_of_figure_3(figures):
    """Return the panels by mu_c, as they say it."""
    panels = {}
    for axes in figures[3].axes:
        name = next(t.get_text() for t in axes.texts if r'\mu_c' in t.get_text())
        panels[FRICTIONS[name.split('= ')[1].rstrip('$')]] = axes
    assert list(panels) == [0.0, 0.5, 2.0, math.inf]
    return panels


def arrows_of_panel(axes, thick):
    """Return (start, unit vector) of the arrows of the cones or of the notes."""
    found = []
    for text in axes.texts:
        if getattr(text, 'arrowprops', None) and (text.arrowprops['linewidth'] > 1.1) == thick:
            start = np.array(text.xyann)
            along = np.array(text.xy) - start
            found.append((start, along / np.linalg.norm(along)))
    return found


def contact_direction(force, d, l=2.5, c=C_UNI_SQUARE):
    """Return the unit velocity of the contact (d, -l) under a force there, by (4), (5)."""
    contact = np.array([d, -l])
    omega = (contact[0] * force[1] - contact[1] * force[0]) / c**2
    velocity = force + omega * np.array([-contact[1], contact[0]])
    return velocity / np.linalg.norm(velocity)


@pytest.mark.parametrize('mu_c', FRICTIONS.values())
def test_edges_of_the_motion_cones_belong_to_those_of_the_friction_cone(figures, mu_c):
    axes = panels_of_figure_3(figures)[mu_c]
    arrows = arrows_of_panel(axes, thick=False)
    assert len(arrows) == 10
    alpha = math.atan(mu_c)
    for i, d in enumerate((-2.25, -1.125, 0.0, 1.125, 2.25)):
        for (start, along), sign in zip(arrows[2 * i : 2 * i + 2], (-1.0, 1.0), strict=True):
            assert start == pytest.approx([d, -2.5])
            force = np.array([sign * math.sin(alpha), math.cos(alpha)])
            assert along == pytest.approx(contact_direction(force, d), abs=1e-12)


@pytest.mark.parametrize('mu_c', FRICTIONS.values())
def test_every_velocity_under_a_force_of_the_friction_cone_is_in_the_filled_cone(figures, mu_c):
    axes = panels_of_figure_3(figures)[mu_c]
    cones = {}
    for wedge in (patch for patch in axes.patches if hasattr(patch, 'theta1')):
        cones.setdefault(round(wedge.center[0], 6), []).append(wedge)
    if mu_c == 0.0:
        assert not cones
        return
    assert list(cones) == pytest.approx([-2.25, -1.125, 0.0, 1.125, 2.25])
    for d, (whole, *against) in cones.items():
        spread = math.radians(whole.theta2 - whole.theta1)
        if math.isinf(mu_c):
            assert spread == pytest.approx(math.pi)
        assert not whole.get_hatch()
        angles = []
        for tangent in np.linspace(-1.0, 1.0, 101) * math.atan(mu_c):
            along = contact_direction(np.array([-math.sin(tangent), math.cos(tangent)]), d)
            angle = math.degrees(math.atan2(along[1], along[0]))
            angles.append(angle + 360.0 if angle < whole.theta1 - 1e-6 else angle)
        assert min(angles) == pytest.approx(whole.theta1, abs=1e-6)
        assert max(angles) == pytest.approx(whole.theta2, abs=1e-6)
        # "Pulling": an edge of the friction cone moves the contact against the normal.
        pulls = abs(d) * 2.5 * mu_c > C_UNI_SQUARE**2 + d**2 if d else False
        assert len(against) == pulls
        for part in against:
            assert part.get_hatch()
            outer = sorted((part.theta1, part.theta2), key=lambda a: abs(a - 90.0))
            assert abs(outer[0] - 90.0) == pytest.approx(90.0)
            assert outer[1] in (whole.theta1, whole.theta2)


def test_pulling_shows_with_high_friction_alone(figures):
    hatched = [
        sum(bool(patch.get_hatch()) for patch in axes.patches)
        for axes in panels_of_figure_3(figures).values()
    ]
    assert hatched == [0, 0, 4, 4]


def test_notes_of_figure_3_are_true_and_stand_where_friction_is_infinite(figures):
    panels = panels_of_figure_3(figures)
    assert all(not arrows_of_panel(panels[mu_c], thick=True) for mu_c in (0.0, 0.5, 2.0))
    (contact, ray), (pulled, pull) = arrows_of_panel(panels[math.inf], thick=True)
    left, right = (contact_direction(np.array([s, 0.0]), contact[0]) for s in (-1.0, 1.0))
    assert cross(left, right) == pytest.approx(0.0, abs=1e-12)  # half a plane
    assert ray[1] > 0.0  # a push
    assert cross(right, ray) < 0.0  # to the right of the cone
    right = contact_direction(np.array([1.0, 0.0]), pulled[0])
    assert pull[1] < 0.0  # against the normal
    assert cross(right, pull) > 0.0  # and in the cone
