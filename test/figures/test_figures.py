# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The paper's figures: what they show against the paper and against plain derivations."""

import math
import struct
import subprocess
import sys
from itertools import combinations
from xml.etree import ElementTree

import matplotlib
import numpy as np
import pytest
from matplotlib.path import Path as Polygon
from matplotlib.text import Text

from tactile_push.figures import (
    gain_figure,
    limit_surface_figure,
    motion_cone_figure,
    save_figures,
    section_figure,
    step_response_figure,
    trajectory_figure,
)

MAKERS = {
    2: limit_surface_figure,
    3: motion_cone_figure,
    6: section_figure,
    7: trajectory_figure,
    8: step_response_figure,
    'gains': gain_figure,
}
FILES = {figure: f'figure_{figure}' if figure != 'gains' else 'gains' for figure in MAKERS}
NAMES = [f'{FILES[figure]}.{ending}' for figure in MAKERS for ending in ('png', 'svg')]
BLOCK = 5.0, 4.75  # cm
L, R = 2.375, 1.35
C_UNI_SQUARE = 5.0 * (math.sqrt(2.0) + math.asinh(1.0)) / 6.0  # mean distance in a square [cm]
SVG = '{http://www.w3.org/2000/svg}'


def block_points(count=400):
    """Return the midpoints of a fine grid on the block [cm]."""
    x, y = (side * ((np.arange(count) + 0.5) / count - 0.5) for side in BLOCK)
    return [axis.ravel() for axis in np.meshgrid(x, y)]


C_UNI = np.hypot(*block_points()).mean()


@pytest.fixture(scope='module')
def figures():
    return {number: make() for number, make in MAKERS.items()}


@pytest.fixture(scope='module')
def saved(tmp_path_factory):
    """Return the folder, the list of files and what was told on the way."""
    folder = tmp_path_factory.mktemp('figures') / 'not' / 'there'
    told = []
    files = save_figures(folder, told.append)
    return folder, files, told


def lines_by_label(axes):
    return {line.get_label(): line for line in axes.get_lines()}


# Files


def test_every_figure_is_written_twice_and_told(saved):
    folder, files, told = saved
    assert [file.name for file in files] == told == NAMES
    assert sorted(folder.iterdir()) == sorted(files)


@pytest.mark.parametrize('number', MAKERS)
def test_png_has_300_dots_an_inch(saved, figures, number):
    data = (saved[0] / f'{FILES[number]}.png').read_bytes()
    assert data.startswith(b'\x89PNG\r\n\x1a\n')
    assert data.endswith(b'IEND\xaeB`\x82')
    inches = figures[number].get_size_inches()
    assert struct.unpack('>II', data[16:24]) == pytest.approx(300.0 * inches, abs=1.0)


@pytest.mark.parametrize('number', MAKERS)
def test_svg_is_xml_with_its_text_as_text_and_without_a_date(saved, number):
    data = (saved[0] / f'{FILES[number]}.svg').read_text()
    root = ElementTree.fromstring(data)
    assert root.tag == f'{SVG}svg'
    assert 'dc:date' not in data
    assert 'DejaVuSans-' not in data  # the outline of a glyph
    texts = {''.join(text.itertext()).strip() for text in root.iter(f'{SVG}text')}
    expected = {
        2: '1.87',
        3: 'motion cone',
        6: 'ellipsoid',
        7: '15',
        8: '400',
        'gains': 'lag 0.1 s',
    }
    assert expected[number] in texts


def test_second_run_gives_the_same_bytes_whatever_the_user_has_set(saved, tmp_path):
    with matplotlib.rc_context({'font.size': 20.0, 'axes.facecolor': 'red', 'svg.hashsalt': 'x'}):
        before = matplotlib.rcParams.copy()
        files = save_figures(tmp_path)
        assert matplotlib.rcParams.copy() == before
    for file in files:
        assert file.read_bytes() == (saved[0] / file.name).read_bytes(), file.name


def test_folder_that_cannot_be_made_is_an_os_error(tmp_path):
    (tmp_path / 'file').write_text('')
    with pytest.raises(OSError, match='file'):
        save_figures(tmp_path / 'file')


def test_figures_need_no_display_and_no_pyplot():
    program = (
        'import sys\n'
        'from tactile_push.figures import limit_surface_figure\n'
        'limit_surface_figure().canvas.draw()\n'
        "assert 'matplotlib.pyplot' not in sys.modules\n"
    )
    subprocess.run([sys.executable, '-c', program], check=True, timeout=120)


# Looks


@pytest.mark.parametrize('number', MAKERS)
def test_figure_is_one_or_two_columns_wide(figures, number):
    assert figures[number].get_size_inches()[0] in (3.5, 7.16)


def shown_texts(axes):
    """Return the texts of a panel that are to be seen; those in space come to the plane."""
    texts = [*axes.texts, axes.title]
    if axes.get_legend():
        texts += axes.get_legend().get_texts()
    if axes.axison:
        for axis in (axes.xaxis, axes.yaxis):
            lower, upper = sorted(axis.get_view_interval())
            texts.append(axis.label)
            texts += [
                tick.label1 for tick in axis.get_major_ticks() if lower <= tick.get_loc() <= upper
            ]
    else:
        for text in axes.texts:
            x, y, _, w = axes.get_proj() @ [*text.get_position_3d(), 1.0]
            text.set_position((x / w, y / w))
    return [text for text in texts if text.get_visible() and text.get_text().strip()]


@pytest.mark.parametrize('number', MAKERS)
def test_no_text_is_small_cut_off_or_on_another(number):
    figure = MAKERS[number]()
    figure.canvas.draw()
    boxes = [
        (text, Text.get_window_extent(text)) for axes in figure.axes for text in shown_texts(axes)
    ]
    assert len(boxes) >= 8
    for text, box in boxes:
        assert text.get_fontsize() >= 8.0, text
        assert figure.bbox.x0 <= box.x0 < box.x1 <= figure.bbox.x1, text
        assert figure.bbox.y0 <= box.y0 < box.y1 <= figure.bbox.y1, text
    for (one, box), (other, box_of_other) in combinations(boxes, 2):
        assert not box.overlaps(box_of_other), (one, other)


@pytest.mark.parametrize('number', [6, 8])
def test_legend_hides_no_data(figures, number):
    figure = figures[number]
    figure.canvas.draw()
    for axes in figure.axes:
        if axes.get_legend() is None:
            continue
        box = axes.get_legend().get_window_extent()
        for line in axes.get_lines():
            assert not line.get_transform().transform_path(line.get_path()).intersects_bbox(box)


@pytest.mark.parametrize('number', [3, 6, 7, 8])
def test_every_axis_has_a_name_and_a_unit(figures, number):
    for axes in figures[number].axes:
        place = axes.get_subplotspec()
        if place.is_last_row():
            assert axes.get_xlabel()
            assert '[' in axes.get_xlabel() or '0.1 s' in axes.get_xlabel()
        if place.is_first_col():
            assert '[' in axes.get_ylabel()


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


# Figure 3

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


def cross(a, b):
    return a[0] * b[1] - a[1] * b[0]


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


# Figures 7 and 8: the equations of motion (9)-(11), (16) once more, in small steps


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
    assert theta[[0, 20, 50, 100, 173]] == pytest.approx(
        [20.0, 18.19, 10.73, 0.83, -6.10], abs=6e-3
    )
    assert phi[[0, 20, 50, 100, 173]] == pytest.approx([0.0, 20.5, 19.8, 8.5, -1.5], abs=0.06)
    assert abs(theta[191] + 10.0) > 3.0
    assert (np.abs(theta[192:] + 10.0) <= 3.0).all()


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
