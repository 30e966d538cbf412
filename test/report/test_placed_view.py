# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Drawings of placed objects: that they are SVG, and where things lie in them."""

import re
from xml.etree import ElementTree

import numpy as np
import pytest

from support.placed_tables import OFF, PLACED, V_Y, R, states, truth
from tactile_push.interface import PLACE_STATE, SENSING_STATE, TRUE_POSE, TRUE_STATE
from tactile_push.report.data import Scene
from tactile_push.report.placed_view import drawings
from tactile_push.report.placings import placings

BLOCK = [(-0.025, -0.02375), (0.025, -0.02375), (0.025, 0.02375), (-0.025, 0.02375)]
SCENE = Scene(R, BLOCK, 0.3)


@pytest.fixture(scope='module')
def tables():
    state, pose = truth()
    time = 0.1 * np.arange(250)
    sensed = {'time': time, 'd_lower': np.full(250, 5e-4), 'd_upper': np.full(250, 1.5e-3)}
    return {PLACE_STATE: states(), TRUE_STATE: state, TRUE_POSE: pose, SENSING_STATE: sensed}


@pytest.fixture(scope='module')
def drawn(tables):
    return drawings(placings(tables[PLACE_STATE], tables[TRUE_STATE]), tables, SCENE)


def pictures(drawing):
    """Return the SVG elements of a drawing."""
    return list(ElementTree.fromstring(f'<div>{drawing}</div>'))


def points(picture, name):
    """Return the points of a path of a class, and its class's number of paths."""
    paths = [path.get('d') for path in picture.iter('path') if path.get('class') == name]
    return np.reshape([float(number) for number in re.findall(r'-?\d+\.\d+', paths[0])], (-1, 2))


def test_every_goal_is_drawn_from_above_and_with_its_d(drawn):
    ends = 'released', 'missed', 'preempted', 'not ended'
    assert [title for title, _ in drawn] == [f'Goal {k}: {end}' for k, end in enumerate(ends, 1)]
    for _, drawing in drawn:
        above, d = pictures(drawing)
        assert above.get('aria-label') == 'Finger and object from above'
        assert d.get('aria-label').startswith('d as believed')


def test_the_finger_goes_to_the_right_and_the_object_lies_at_its_end(drawn):
    above, _ = pictures(drawn[0][1])
    finger = points(above, 'finger-way')
    assert finger[0] == pytest.approx([0.0, -60.0], abs=0.01)
    assert finger[-1, 0] == pytest.approx(1e3 * V_Y * 10.04, abs=0.2)
    free = points(above, 'free')
    centre = points(above, 'centre-way')[-1]
    assert centre[1] == pytest.approx(1e3 * (PLACED[2] + OFF[0]), abs=0.01)
    # The middle of the first edge is 23.75 mm from the centre of mass, against n.
    edge = free[:2].mean(axis=0) - centre
    angle = PLACED[3] + OFF[1] - 0.5  # of the object, whose edge is at 0.5 rad in it
    assert edge == pytest.approx([-23.75 * np.cos(angle), 23.75 * np.sin(angle)], abs=0.02)
    wanted = points(above, 'wanted')
    assert wanted[:4].mean(axis=0)[1] == pytest.approx(1e3 * PLACED[2], abs=0.01)


def test_the_box_holds_everything(drawn):
    for _, drawing in drawn:
        for picture in pictures(drawing):
            left, top, width, height = map(float, picture.get('viewBox').split())
            for path in picture.iter('path'):
                if path.get('class') in ('scale', 'goal-line'):
                    continue
                for x, y in points(picture, path.get('class')):
                    assert left <= x <= left + width
                    assert top <= y <= top + height


def test_d_is_drawn_upwards_within_what_it_was(drawn):
    _, d = pictures(drawn[0][1])
    believed, true = points(d, 'believed'), points(d, 'true')
    # 1 mm is believed and 1.2 mm true.
    assert believed[:, 1].min() == pytest.approx(believed[:, 1].max())
    assert true[0, 1] < believed[0, 1]
    assert believed[-1, 0] == pytest.approx(160.0, abs=2.0)
    words = [text.text for text in d.iter('text')]
    assert words == ['2.2 mm', '0.0 mm']


def test_without_the_simulator_only_what_was_believed_is_drawn(tables):
    told = {PLACE_STATE: tables[PLACE_STATE]}
    drawn = drawings(placings(told[PLACE_STATE], {}), told, Scene(R))
    ((d,),) = [pictures(drawing) for _, drawing in drawn[:1]]
    assert {path.get('class') for path in d.iter('path')} == {'believed'}


def test_an_unknown_object_leaves_the_ways(tables):
    found = placings(tables[PLACE_STATE], tables[TRUE_STATE])
    above, _ = pictures(drawings(found[:1], tables, Scene(R))[0][1])
    assert len(points(above, 'centre-way')) > 10


def test_nothing_is_drawn_of_nothing():
    assert drawings([], {}, SCENE) == []
