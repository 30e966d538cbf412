# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What the demonstration asks of the nodes and makes of a bag of goals."""

import json

import pytest

pytest.importorskip('rclpy')

from support.placed_bag import placed_bag
from support.placed_tables import OFF
from tactile_push.control.placing.stages import RELEASED
from tactile_push.demo import placing
from tactile_push.parameters import PARAMETERS
from tactile_push.parameters.experiment import ExperimentParameters, goals


@pytest.fixture
def asked(monkeypatch):
    """Return the experiments that are asked for, whose bag is one that is known."""
    experiments = []

    def run(what, bag, page, follow):
        experiments.append(what)
        placed_bag(bag)
        return 12.5

    monkeypatch.setattr(placing, 'run_experiment', run)
    monkeypatch.setattr(placing, 'page_port', lambda: None)
    return experiments


def test_goals_and_errors_are_told_and_drawn(asked, tmp_path):
    out = tmp_path / 'not' / 'there'
    result = placing.run_placing(out, pytest.fail)
    assert [one.stage for one in result.goals] == ['released', 'missed', 'preempted', 'not ended']
    assert not result.all_released
    told = json.loads(json.dumps(result.as_json()))
    assert told['wall_seconds'] == 12.5
    assert told['goals'][0]['error'] == pytest.approx(OFF)
    assert told['goals'][1]['error'] is None
    assert (out / 'placed.png').read_bytes().startswith(b'\x89PNG')
    assert (out / 'placed' / 'metadata.yaml').exists()


@pytest.mark.parametrize(
    ('plant', 'sensor'),
    [('sim_plant', 'sentence'), ('mujoco_plant', 'wrench'), ('mujoco_plant', 'camera')],
)
def test_nodes_take_what_they_are_asked(asked, tmp_path, plant, sensor):
    placing.run_placing(tmp_path, pytest.fail, plant, sensor)
    (what,) = asked
    assert (what.plant, what.sensor) == (plant, sensor)
    assert plant in what.more
    for node, values in what.more.items():
        kind = PARAMETERS[node]
        assert set(values) <= {known.name for known in kind.declared()}, node
        kind.of(values)
    assert goals(ExperimentParameters.of(what.more['experiment'])) == list(placing.GOALS)
    sensing = what.more['active_sensing']
    assert ('noise' in sensing) == (sensor == 'sentence')  # other sensors have their own
    assert ('tilt_max' in sensing) == (plant == 'sim_plant')  # the other pushes above the belt


def test_an_object_for_every_goal_has_to_be_let_go(asked, tmp_path):
    released = placing.run_placing(tmp_path, pytest.fail).goals[:1]
    assert released[0].stage == RELEASED
    assert placing.PlacedResult(released * 3, 1.0).all_released
    assert not placing.PlacedResult(released * 2, 1.0).all_released
