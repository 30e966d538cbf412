# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What became of goals, against tables of which it is known."""

import numpy as np
import pytest

from support.placed_tables import BELT, GOALS, LAST, LIFTED, OFF, PLACED, V_Y, states, truth
from tactile_push.control.placing import STAGES
from tactile_push.report.data import Scene
from tactile_push.report.placings import GOAL_HEADS, goal_cells, placings, way_of

SCENE = Scene(0.0135, [(-0.02, -0.01), (0.02, -0.01), (0.0, 0.02)])


@pytest.fixture(scope='module')
def found():
    return placings(states(), truth()[0])


def test_every_goal_has_its_end(found):
    assert [one.stage for one in found] == ['released', 'missed', 'preempted', 'not ended']
    for one, (start, end, x, theta) in zip(found, (*GOALS, LAST), strict=True):
        assert (one.x, one.theta) == (x, theta)
        assert one.start == pytest.approx(start)
        assert one.end == pytest.approx(end, abs=0.11)


def test_what_was_reached_is_the_truth_when_the_finger_is_lifted(found):
    placed, *others = found
    assert placed.freed == pytest.approx(LIFTED[0])
    assert placed.error == pytest.approx(OFF)
    assert [one.reached for one in others] == [None] * 3
    assert [one.error for one in others] == [None] * 3


def test_belt_verdict_and_expected_error_are_the_controllers(found):
    assert [one.belt for one in found[:2]] == pytest.approx([0.0475, 0.0275])  # but for 0.5 s
    assert (found[0].verdict, found[0].reason) == ('with reserve', '')
    assert (found[1].verdict, found[1].reason) == ('out of reach', 'friction')
    assert found[1].miss == pytest.approx((2e-4, -1e-3))


def test_without_the_simulator_the_error_is_the_one_expected():
    one, *_ = placings(states(), {})
    assert one.reached is None
    assert one.miss == pytest.approx((1e-4, -1e-3))
    assert one.stage == 'released'
    cells = dict(zip(GOAL_HEADS, goal_cells([one])[0], strict=True))
    assert cells['let go at'] == ''
    assert cells['error'] == '0.10 mm, -0.06° (expected)'


def test_cells_are_for_people(found):
    rows = [dict(zip(GOAL_HEADS, row, strict=True)) for row in goal_cells(found)]
    assert rows[0] == {
        'goal': '-50.00 mm, 5.73°',
        'let go at': '-49.80 mm, 5.67°',
        'error': '0.20 mm, -0.06°',
        'belt': '47 mm',
        'in reach': 'with reserve',
        'end': 'released',
    }
    assert rows[1]['in reach'] == 'out of reach: friction'
    assert rows[1]['end'] == 'missed'


def test_bags_without_goals_or_of_other_versions_have_none():
    assert placings({}, {}) == []
    assert placings({'time': np.zeros(1), 'stage': np.zeros(1)}, {}) == []
    idle = {name: column[:10] for name, column in states().items()}
    assert placings(idle, {}) == []
    bare = ('time', 'stage', 'goals', 'goal_x', 'goal_theta')
    one, *_ = placings({name: states()[name] for name in bare}, {})
    assert (one.stage, one.verdict, one.belt, one.miss) == ('released', 'unknown', None, None)


def test_angles_to_settle_at_are_no_places():
    table = states()
    table['stage'] = np.full(len(table['time']), float(STAGES.index('settling')))
    assert placings(table, {}) == []


def test_goals_of_two_activations_are_told_apart():
    columns = states()
    again = {name: np.concatenate([column, column]) for name, column in columns.items()}
    again['time'] = np.arange(len(again['time'])) * 0.1
    assert [one.stage for one in placings(again, {})][:5] == [
        *('released', 'missed', 'preempted', 'preempted', 'released')
    ]


def test_the_way_is_that_on_the_belt_until_the_object_is_free(found):
    way = way_of(found[0], *truth(), SCENE)
    start = PLACED[0]
    assert way.finger[:, 0] == pytest.approx(np.full(len(way.finger), -0.06))
    assert way.finger[0, 1] == pytest.approx(V_Y * start)
    assert way.finger[-1, 1] == pytest.approx(V_Y * LIFTED[0], abs=V_Y * 0.02)
    assert way.moved[:, 0] == pytest.approx(np.full(len(way.moved), PLACED[2] + OFF[0]))
    # On the belt, where it stays.
    assert way.moved[-1, 1] == pytest.approx(way.finger[-1, 1] + 0.037, abs=V_Y * 0.021)
    assert way.moved[:, 2] == pytest.approx(np.full(len(way.moved), PLACED[3] + OFF[1]))
    assert way.edge == pytest.approx(0.5)
    assert (way.outline, way.radius) == (SCENE.outline, SCENE.radius)
    assert way.goal == PLACED[2:4]


def test_there_is_no_way_where_the_simulator_tells_none(found):
    state, pose = truth()
    assert way_of(found[0], {}, {}, SCENE) is None
    assert way_of(found[0], state, {}, SCENE) is None
    older = {name: column for name, column in state.items() if name != 'lifted'}
    assert way_of(found[0], older, pose, SCENE) is None
    up = state | {'lifted': np.ones(len(state['time']))}
    assert way_of(found[0], up, pose, SCENE) is None


def test_belt_is_unknown_where_nothing_is_left_to_tell():
    columns = states()
    columns['belt_left'] = np.full(len(columns['time']), np.nan)
    assert placings(columns, {})[0].belt is None
    assert BELT > 0.0


def test_touching_anew_is_counted_and_named():
    columns = states()
    stage, start = columns['stage'], round(10.0 * GOALS[0][0])
    for first, last in ((20, 30), (50, 52)):
        stage[start + first : start + last] = STAGES.index('regrasping')
    first, second, *_ = placings(columns, truth()[0])
    assert (first.regrasps, second.regrasps) == (2, 0)
    assert first.belt == pytest.approx(0.0475)
    rows = [dict(zip(GOAL_HEADS, row, strict=True)) for row in goal_cells([first, second])]
    assert [row['end'] for row in rows] == ['released, 2 regrasps', 'missed']
    stage[start + 50 : start + 52] = STAGES.index('placing')
    one, *_ = placings(columns, truth()[0])
    assert goal_cells([one])[0][-1] == 'released, 1 regrasp'


def test_a_finger_that_goes_back_along_the_belt_is_where_the_simulator_has_it(found):
    state, pose = truth()
    along = -0.001 * state['time']
    gone = state | {'along': along}, pose | {'y': pose['y'] - along}
    back = way_of(found[0], *gone, SCENE)
    way = way_of(found[0], state, pose, SCENE)
    assert back.finger[:, 1] - way.finger[:, 1] == pytest.approx(
        along[100 : 100 + len(along)][: len(way.finger)]
    )
    assert back.moved == pytest.approx(way.moved)
