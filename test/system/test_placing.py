# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""One goal through real nodes: taken, let go at its place, recorded, replayed and reported."""

import math
from pathlib import Path

import numpy as np
import pytest

from tactile_push.bags import BagReader
from tactile_push.interface import (
    ACTIVE_SENSING,
    CONTACT_GEOMETRY,
    EXPERIMENT,
    PLACE,
    PLACE_STATE,
    PUSH_CONTROLLER,
    SENSOR_DRIVER,
    SIM_PLANT,
    TRUE_STATE,
)
from tactile_push.parameters import config_file
from tactile_push.replay import replay
from tactile_push.report import read_run
from tactile_push.report.columns import read_tables, topics_of
from tactile_push.report.placings import placings
from tactile_push.testing import NodeProcesses
from tactile_push.testing.observer import PATIENCE
from tactile_push.testing.rig import TIMING

GOAL = -0.065, 0.2  # near where the block comes, so that it takes little belt
FAST = {'belt_speed': 0.01}  # twice the usual one, so that there are few control periods [m/s]


@pytest.fixture(scope='module')
def bag(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the bag of an experiment that gives the goal."""
    folder = tmp_path_factory.mktemp('placing')
    device, simulated = {'device': str(folder / 'sensor')}, {'use_sim_time': True}
    known = {'l_share': 0.01, 'tilt_max': 0.0, 'noise': 0.002}
    config = config_file('block.yaml')
    goals = {'goals': [f'{GOAL[0]} {GOAL[1]}'], 'steps': 700}
    with NodeProcesses(folder) as nodes:
        nodes.start(SIM_PLANT, {**device, **TIMING, **FAST}, config=config)
        nodes.start(SENSOR_DRIVER, {**device, **simulated})
        nodes.start(CONTACT_GEOMETRY, simulated, config=config)
        law = {'law': PLACE, 'autostart': False}
        nodes.start(PUSH_CONTROLLER, {**law, **FAST, **simulated}, config=config)
        nodes.start(ACTIVE_SENSING, {**known, **FAST, **simulated}, config=config)
        experiment = nodes.start(EXPERIMENT, {'bag': str(folder / 'bag'), **goals, **simulated})
        assert experiment.wait(2.0 * PATIENCE) == 0, nodes.log(EXPERIMENT).read_text()
    return folder / 'bag'


def test_the_object_is_let_go_at_its_place_and_goes_on_as_it_lies(bag: Path):
    with BagReader(bag) as reader:
        tables, _ = read_tables(reader, topics_of(reader, ''))
    truth = tables[TRUE_STATE]
    (placed,) = placings(tables[PLACE_STATE], truth)
    assert placed.stage == 'released'
    assert (placed.x, placed.theta) == pytest.approx(GOAL)
    assert placed.error is not None
    # A sensor without noise and a finger without a lag: what is left is what was learned.
    assert abs(placed.error[0]) < 5e-4
    assert abs(placed.error[1]) < math.radians(0.5)
    free = truth['lifted'] == 1.0
    assert free.sum() > 5
    for name in ('object_x', 'edge_angle'):
        assert np.ptp(truth[name][free]) < 1e-12  # but for rounding
    assert truth['v_x'][free][-1] == 0.0


def test_replay_commands_the_same_to_the_bit(bag: Path):
    with BagReader(bag) as reader:
        (comparison,) = replay(reader)
    assert len(comparison.ticks) > 100
    assert not comparison.different()


def test_report_shows_goal_and_way(bag: Path):
    with BagReader(bag) as reader:
        run = read_run(reader)
    ((goal, _, _, _, _, end),) = run.goals
    assert (goal, end) == ('-65.00 mm, 11.46°', 'released')
    ((title, drawing),) = run.drawings
    assert title == 'Goal 1: released'
    assert 'finger-way' in drawing
    assert 'believed' in drawing
    assert {'learning', 'placing'} <= {one.text for one in run.episodes if one.lane == 'goal'}
