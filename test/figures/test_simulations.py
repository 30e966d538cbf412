# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Figures 7 and 8 against the equations of motion (9)-(11), (16), in small steps."""

import math

import numpy as np
import pytest

from support.expected import FIGURE_8, FIGURE_8_SETTLE_STEP
from support.papers_figures import (
    BLOCK,
    cross,
    lines_by_label,
)

L, R = 2.375, 1.35


def rates(theta, d, phi, c, mu_c, speed=0.5):
    """Return the rates of theta and d for mu_c infinite (sticking) or 0 (slipping), in cm."""
    v_x, v_y = speed / math.tan(phi), speed
    v_t = math.cos(theta) * v_x + math.sin(theta) * v_y
    v_n = math.cos(theta) * v_y - math.sin(theta) * v_x
    if mu_c == 0.0:
        omega = d * v_n / (c**2 + d**2)
        return omega, v_t - omega * L - omega * R
    omega = (d * v_n + L * v_t) / (c**2 + d**2 + L**2)
    return omega, -omega * R


def pushed(theta, d, phi, c, mu_c, period=0.1, parts=4):
    """Return theta and d after a push, by the midpoint rule."""
    h = period / parts
    for _ in range(parts):
        omega, d_dot = rates(theta, d, phi, c, mu_c)
        omega, d_dot = rates(theta + h / 2 * omega, d + h / 2 * d_dot, phi, c, mu_c)
        theta, d = theta + h * omega, d + h * d_dot
    return theta, d


COMBINATIONS = [(3.45, math.inf), (1.87, math.inf), (0.67, math.inf), (1.87, 0.0)]


def snapshots(axes):
    """Return the blocks' corners, shape (5, 4, 2), and the fingers' centres, shape (5, 2)."""
    fingers = [patch for patch in axes.patches if hasattr(patch, 'get_radius')]
    blocks = [patch.get_xy()[:4] for patch in axes.patches if patch not in fingers]
    assert [finger.get_radius() for finger in fingers] == pytest.approx(5 * [R])
    return np.array(blocks), np.array([finger.get_center() for finger in fingers])


def angles_of(blocks):
    edge = blocks[:, 1] - blocks[:, 0]
    return np.unwrap(np.arctan2(edge[:, 1], edge[:, 0]))


@pytest.mark.parametrize('panel', range(4))
def test_panels_of_figure_7_say_what_they_combine(figures, panel):
    c, mu_c = COMBINATIONS[panel]
    title = figures[7].axes[panel].get_title()
    assert f'{c:.2f}' in title
    assert (r'\infty' in title) == math.isinf(mu_c)


@pytest.mark.parametrize('panel', range(4))
def test_snapshots_show_the_block_and_the_finger_every_50_pushes(figures, panel):
    blocks, fingers = snapshots(figures[7].axes[panel])
    assert fingers == pytest.approx(np.array([[0.0, 2.5 * k] for k in range(5)]))
    assert blocks.shape == (5, 4, 2)
    sides = np.linalg.norm(np.roll(blocks, -1, axis=1) - blocks, axis=2)
    assert sides == pytest.approx(np.tile([*BLOCK, *BLOCK], (5, 1)))
    # The finger's disk touches the pushed edge from outside.
    angle = angles_of(blocks)
    tangent, normal = (
        np.stack([np.cos(angle + turn), np.sin(angle + turn)], axis=-1) for turn in (0, math.pi / 2)
    )
    offset = fingers - blocks[:, 0]
    assert (offset * normal).sum(axis=1) == pytest.approx(np.full(5, -R), abs=1e-9)
    along = (offset * tangent).sum(axis=1)
    assert (along > 0.0).all() and (along < BLOCK[0]).all()


@pytest.mark.parametrize('panel', range(4))
def test_blocks_of_figure_7_turn_clockwise_as_the_votes_say(figures, panel):
    _, mu_c = COMBINATIONS[panel]
    blocks, _ = snapshots(figures[7].axes[panel])
    centre, contact = blocks[0].mean(axis=0), np.array([0.0, R])
    assert (contact - centre) == pytest.approx([-0.5, -L])
    alpha = math.atan(mu_c)
    rays = [(-math.sin(alpha), math.cos(alpha)), (math.sin(alpha), math.cos(alpha)), (0.0, 1.0)]
    # A ray to the left of the centre of mass votes for clockwise.
    votes = [np.sign(cross(contact - centre, ray)) for ray in rays]
    assert sum(votes) < 0.0
    assert (np.diff(angles_of(blocks)) < 0.0).all()


@pytest.mark.parametrize('panel', range(4))
def test_snapshots_are_those_of_the_equations_of_motion(figures, panel):
    c, mu_c = COMBINATIONS[panel]
    blocks, _ = snapshots(figures[7].axes[panel])
    theta, d = 0.0, -0.5
    expected = [theta]
    for k in range(1, 201):
        theta, d = pushed(theta, d, math.pi / 2.0, c, mu_c)
        if k % 50 == 0:
            expected.append(theta)
    assert angles_of(blocks) == pytest.approx(np.array(expected), abs=2e-5)


def test_path_of_the_centre_runs_through_the_blocks_of_figure_7(figures):
    for axes in figures[7].axes:
        blocks, _ = snapshots(axes)
        path, points = (line.get_xydata() for line in axes.get_lines())
        assert len(path) == 201
        assert path[::50] == pytest.approx(blocks.mean(axis=1))
        assert points == pytest.approx(blocks.mean(axis=1))


def test_what_the_docstring_of_figure_7_says_is_so(figures):
    panels = [snapshots(axes) for axes in figures[7].axes]
    turned = [-math.degrees(angles_of(blocks)[-1]) for blocks, _ in panels]
    assert turned == pytest.approx([22.0, 55.0, 103.0, 44.0], abs=0.5)
    finals = []
    for blocks, fingers in panels:
        angle = angles_of(blocks)[-1]
        offset = fingers[-1] - blocks[-1].mean(axis=0)
        finals.append(offset @ (math.cos(angle), math.sin(angle)))
    assert (finals[1], finals[3]) == pytest.approx((0.8, -0.8), abs=0.05)
    assert math.cos(math.radians(turned[2])) < 0.0  # the finger moves against the normal


GAINS = [(0.02, 2.0), (0.05, 5.0), (0.2, 10.0)]


def responses(figures):
    """Return theta and phi - 90 degrees by label."""
    upper, lower = figures[8].axes
    theta, phi = lines_by_label(upper), lines_by_label(lower)
    return {label: (theta[label].get_data(), phi[label].get_data()) for label in phi}


def label_of(kp, kd):
    return f'$k_p = {kp:g}$, $k_d = {kd:g}$'


def test_figure_8_has_three_responses_one_of_them_with_the_paper_s_gains(figures):
    assert list(responses(figures)) == [label_of(*gains) for gains in GAINS]
    legend = figures[8].axes[0].get_legend()
    assert [text.get_text() for text in legend.get_texts()] == [label_of(*g) for g in GAINS]
    (desired,) = (
        line
        for line in figures[8].axes[0].get_lines()
        if line.get_label() not in responses(figures)
    )
    assert list(desired.get_ydata()) == pytest.approx([-10.0, -10.0])


def test_responses_pass_through_the_reference(figures):
    (step, theta), (_, phi) = responses(figures)[label_of(0.05, 5.0)]
    assert list(step) == list(range(401))
    steps, thetas, phis = np.array(FIGURE_8).T
    assert theta[steps.astype(int)] == pytest.approx(thetas, abs=6e-3)
    assert phi[steps.astype(int)] + 90.0 == pytest.approx(phis, abs=0.06)
    assert abs(theta[FIGURE_8_SETTLE_STEP - 1] + 10.0) > 3.0
    assert (np.abs(theta[FIGURE_8_SETTLE_STEP:] + 10.0) <= 3.0).all()


@pytest.mark.parametrize(('kp', 'kd'), GAINS)
def test_responses_are_those_of_the_law_and_the_equations_of_motion(figures, kp, kd):
    (_, drawn_theta), (_, drawn_phi) = responses(figures)[label_of(kp, kd)]
    theta, d, phi, before = math.radians(20.0), -0.6, math.pi / 2.0, None
    for k in range(401):
        if before is not None:
            phi += kp * (theta + math.radians(10.0)) + kd * (theta - before)
        before = theta
        assert drawn_theta[k] == pytest.approx(math.degrees(theta), abs=1e-3)
        assert drawn_phi[k] == pytest.approx(math.degrees(phi) - 90.0, abs=1e-2)
        theta, d = pushed(theta, d, phi, 1.87, math.inf)


def test_what_the_docstring_of_figure_8_says_is_so(figures):
    thetas = {gains: responses(figures)[label_of(*gains)][0][1] for gains in GAINS}
    assert thetas[0.05, 5.0].min() > -10.0
    assert thetas[0.02, 2.0].min() == pytest.approx(-12.0, abs=0.3)
    assert thetas[0.2, 10.0].min() > -10.01
    outside = np.flatnonzero(np.abs(thetas[0.2, 10.0] + 10.0) > 3.0)
    assert outside[-1] + 1 == 102
    greatest = [responses(figures)[label_of(*gains)][1][1].max() for gains in GAINS]
    assert greatest == sorted(greatest)
