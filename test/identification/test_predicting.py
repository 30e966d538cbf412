# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import cmath
import json
import math

import numpy as np
import pytest

from support.measured_pushes import (
    OUTLINE,
    RADIUS,
    VERTICES,
    content,
    deviation,
    measured,
    placed,
    pushes_in,
    translation,
    ways,
)
from tactile_push.identification.predicting import Physics, errors_of, residuals
from tactile_push.mechanics import Outline, Slider, Support

FEET = {'points': [[0.005, 0.005], [0.05, 0.005], [0.01, 0.04]], 'loads': [1.0, 2.0, 1.5]}


@pytest.fixture
def read(tmp_path):
    """Return a function that writes a file of pushes and reads it."""

    def written(made):
        file = tmp_path / 'block.json'
        file.write_text(json.dumps(made))
        return pushes_in(file)

    return written


def predicted(pushes, physics):
    return errors_of(residuals(pushes, physics))


def test_a_prediction_with_the_true_numbers_has_no_error(read):
    pushes = [measured(Support.spread(OUTLINE, 1.4, 40), 0.25, *way) for way in ways(12)]
    # They are pushes: the object moves and turns.
    moved, turned = deviation(pushes, [{'object_end': push['object_start']} for push in pushes])
    assert np.median(moved) > 0.005
    assert np.median(turned) > 0.05

    found = read(content(pushes))
    errors = predicted(found, Physics(Support.spread(found.outline, 1.4, 40), 0.25))

    assert errors.position == pytest.approx(0.0, abs=1e-9)
    assert errors.angle == pytest.approx(0.0, abs=1e-9)
    wrong = predicted(found, Physics(Support.spread(found.outline, 2.4, 40), 0.05))
    assert wrong.position.mean() > 1e-4


def test_errors_are_distances_of_the_origin_and_angles_the_short_way_around(read):
    pushes = [measured(Support.spread(OUTLINE, 1.4, 40), 0.25, *way) for way in ways(3)]
    pushes[0]['object_end'][0] += 0.003
    pushes[0]['object_end'][1] -= 0.004
    pushes[1]['object_end'][2] += 0.25
    pushes[2]['object_end'][2] += 2.0 * math.pi - 0.125
    found = read(content(pushes))

    errors = predicted(found, Physics(Support.spread(found.outline, 1.4, 40), 0.25))

    assert errors.position == pytest.approx([0.005, 0.0, 0.0], abs=1e-9)
    assert errors.angle == pytest.approx([0.0, 0.25, 0.125], abs=1e-9)
    assert errors.figures() == pytest.approx(
        {
            'mean_mm': 5.0 / 3.0,
            'median_mm': 0.0,
            'mean_deg': math.degrees(0.125),
            'median_deg': math.degrees(0.125),
        },
        abs=1e-6,
    )


@pytest.mark.parametrize('mu_c', [0.0, 0.3, math.inf])
def test_a_head_on_push_moves_the_object_by_the_rest_of_the_way(read, mu_c):
    # Symmetry allows nothing else; after the gap, and from the contact where poses overlap.
    square = [[-0.02, -0.02], [0.02, -0.02], [0.02, 0.02], [-0.02, 0.02]]
    pushes = [
        translation(overlap, length, yaw)
        for overlap, length, yaw in [
            (-0.004, 0.015, 0.0),
            (-0.004, 0.003, 1.0),
            (0.0, 0.01, -2.0),
            (0.001, 0.01, 0.5),
            (0.002, 0.0125, 3.0),
        ]
    ]
    made = content(pushes, outline={'kind': 'polygon', 'vertices': square})
    found = read(made)

    errors = predicted(found, Physics(Support.corners(found.outline), mu_c))

    assert errors.position == pytest.approx(0.0, abs=1e-9)
    assert errors.angle == pytest.approx(0.0, abs=1e-8)


def test_an_overlap_moves_the_way_of_the_tip_out_along_the_normal(read):
    overlap = 0.0015
    pushes = []
    for start, begin, end in ways(6):
        # The contact's normal, from the place of the tip over the nearest side.
        there = (complex(*begin) - complex(*start[:2])) * cmath.exp(-1j * start[2])
        normals = []
        for a, b in zip(VERTICES, VERTICES[1:] + VERTICES[:1], strict=True):
            edge = complex(*b) - complex(*a)
            inward = 1j * edge / abs(edge)
            outside = -((there - complex(*a)) * inward.conjugate()).real
            normals.append((outside, inward))
        outside, inward = max(normals, key=lambda pair: pair[0])
        inward *= cmath.exp(1j * start[2])
        # Begin in contact instead of 3 mm before it; write it down too deep by the overlap.
        contact = complex(*begin) + (outside - RADIUS) * inward
        finish = complex(*end) + (outside - RADIUS) * inward
        push = measured(
            Support.spread(Outline.polygon(VERTICES), 1.4, 40),
            0.2,
            start,
            (contact.real, contact.imag),
            (finish.real, finish.imag),
        )
        for key in ('tip_start', 'tip_end'):
            deep = complex(*push[key]) + overlap * inward
            push[key] = [deep.real, deep.imag]
        pushes.append(push)
    found = read(content(pushes))

    errors = predicted(found, Physics(Support.spread(found.outline, 1.4, 40), 0.2))

    assert errors.position == pytest.approx(0.0, abs=1e-8)
    assert errors.angle == pytest.approx(0.0, abs=1e-7)


def test_the_angle_of_the_force_is_that_between_measured_and_predicted(read):
    # A head-on push at the middle of a square: the force is along the way.
    pushes = [translation(-0.002, 0.01, yaw) for yaw in (0.0, 1.0)]
    for push, beside in zip(pushes, (0.1, -0.2), strict=True):
        way = complex(*push['tip_end']) - complex(*push['tip_start'])
        force = 3.0 * way * cmath.exp(1j * beside)
        push['force'] = [force.real, force.imag]
    square = [[-0.02, -0.02], [0.02, -0.02], [0.02, 0.02], [-0.02, 0.02]]
    made = content(pushes, outline={'kind': 'polygon', 'vertices': square})
    found = read(made)

    errors = predicted(found, Physics(Support.corners(found.outline), 0.3)).force

    assert errors == pytest.approx([0.1, 0.2], abs=1e-9)


def test_without_friction_the_force_turns_with_the_edge(read):
    # It begins along the edge's normal, and its mean over the last 60 % lies between what the edge
    # has turned by before and at the end.
    pushes = []
    for start, begin, far in ways(6):
        end = tuple(np.add(begin, np.subtract(far, begin) * 0.4))  # it stays on the edge
        push = measured(Support.uniform(Outline.polygon(VERTICES), 40), 0.0, start, begin, end)
        there = (complex(*begin) - complex(*start[:2])) * cmath.exp(-1j * start[2])
        edges = [
            (complex(*b) - complex(*a), complex(*a))
            for a, b in zip(VERTICES, VERTICES[1:] + VERTICES[:1], strict=True)
        ]
        _, normal = max(
            (((there - a) * (-1j * edge).conjugate()).real / abs(edge), 1j * edge)
            for edge, a in edges
        )
        force = normal * cmath.exp(1j * start[2])
        pushes.append(push | {'force': [force.real, force.imag]})
    found = read(content(pushes))

    errors = predicted(found, Physics(Support.uniform(found.outline, 40), 0.0)).force

    turned = np.array([abs(push['object_end'][2] - push['object_start'][2]) for push in pushes])
    assert (errors < turned).all()
    much = turned > 0.02  # and in one sense
    assert much.sum() >= 4
    assert (errors > 0.2 * turned)[much].all()


def test_a_force_within_the_friction_cone_is_what_the_support_resists_with(read):
    # With endless friction the contact sticks, and the force is the sum of the feet's frictions.
    outline = Outline.polygon(VERTICES)
    support = Support.at_points(FEET['points'], FEET['loads'])
    start = (0.0, 0.0, 0.4)
    x, y = support.centre
    ends = [placed(start, *point) for point in ((x + 0.003, -RADIUS), (x + 0.0032, 0.0))]
    push = measured(support, math.inf, start, *((end.real, end.imag) for end in ends))
    slider = Slider.on(outline, support, exact=True)
    way = (ends[1] - ends[0]) / abs(ends[1] - ends[0])
    before = placed(start, x, y)
    after = placed(push['object_end'], x, y)
    turn = push['object_end'][2] - start[2]
    moved = (after - before) * cmath.exp(-0.5j * (start[2] + push['object_end'][2]))
    f_x, f_y, _ = slider.wrench((moved.real, moved.imag, turn))
    force = complex(f_x, f_y) * cmath.exp(1j * push['object_end'][2])
    assert abs(cmath.phase(force / way)) > 0.01
    push['force'] = [force.real, force.imag]
    found = read(content([push, push]))

    errors = predicted(found, Physics(support, math.inf)).force

    assert errors == pytest.approx([0.0, 0.0], abs=0.02)
