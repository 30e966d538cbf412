# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The law that places, made again from a bag to the bit."""

import pytest

from support.bag_copies import contents, copied, replayed
from support.placed_run import Line
from tactile_push.bags import BagReader
from tactile_push.cli import main
from tactile_push.control import NOTHING_TO_DO
from tactile_push.control.placing import STAGES
from tactile_push.control.placing.stages import REGRASPING, SETTLES, STEERS

GOAL, SECOND = (-0.02, -0.1), (-0.012, 0.05)
STRAIGHT = (0.0, 0.0, 0.0, 1.0)
STATE, COMMAND, ESTIMATES = '/place/state', '/finger/cmd_vel', '/active_sensing/state'


def eventful():
    """Return a line to which most things happen that can happen to a goal."""
    line = Line(late=1, age=0.03)
    line.period()
    line.placing.goal('map', 0.0, STRAIGHT)
    line.period()
    line.ask(*GOAL)
    line.until(lambda: line.placing.released == 1)
    line.ask(*SECOND)
    line.period()
    line.placing.goal('', 0.5, STRAIGHT)
    line.until(lambda: line.placing.stage == 'placing')
    line.ask(-0.01, 0.0)
    line.until(lambda: line.placing.stage == 'placing')
    line.placing.cancel()
    line.period()
    line.ask(*GOAL)
    for _ in range(20):
        line.period()
    line.feels = False
    line.until(lambda: line.placing.stage == 'object lost')
    line.ask(*GOAL)
    line.feels = True
    for _ in range(10):
        line.period()
    line.ask(0.09, 0.6)  # out of reach, so that the nearest goal is looked for
    for _ in range(20):
        line.period()
    line.deactivate()
    return line


@pytest.fixture(scope='module')
def run(tmp_path_factory):
    """Return the line and its bag."""
    line = eventful()
    return line, line.bag(tmp_path_factory.mktemp('placed') / 'bag')


def test_the_run_has_in_it_what_it_is_for(run):
    line, _ = run
    stages = {STAGES[int(values['stage'])] for values in line.states}
    assert stages >= {
        *('no goal', 'lifted', 'waiting for contact', 'learning', 'placing', 'letting go'),
        *('cancelled', 'object lost'),
    }
    last = line.states[-1]
    assert (last['goals'], last['refused'], last['released']) == (6.0, 2.0, 1.0)


def test_no_command_differs_from_that_of_the_nodes(run):
    line, bag = run
    (comparison,) = replayed(bag)
    assert comparison.kept == 0
    assert len(comparison.ticks) == len(line.ticks) + 1
    assert not comparison.different()
    assert NOTHING_TO_DO in {tick.stop_reason for tick in comparison.ticks}


def test_the_new_bag_has_what_the_nodes_said_to_the_last_digit(run, tmp_path):
    _, bag = run
    replayed(bag, out=tmp_path / 'out')
    assert contents(tmp_path / 'out') == contents(bag)
    assert main(['diff', str(bag), str(tmp_path / 'out')]) == 0


def test_estimates_and_states_of_goals_may_be_recorded_after_the_periods_that_used_them(
    run, tmp_path
):
    line, bag = run
    late = Line.__new__(Line)
    late.parameters = line.parameters
    slow = {'place/state': 3, 'active_sensing/state': 7, 'object_pose': 7}  # tenths of a second
    rows = [(topic, at + 10**8 * slow.get(topic, 0), fields) for topic, at, fields in line.heard]
    late.heard = sorted(rows, key=lambda row: row[1])
    late.bag(tmp_path / 'late')
    replayed(tmp_path / 'late', out=tmp_path / 'out')
    assert contents(tmp_path / 'out') == contents(bag)


def lasting(law):
    """Return a line with goals that do not end, and for a while without estimates."""
    line = Line(theta=0.2, d=-0.003, late=1, age=0.03, law=law)
    for _ in range(12):
        line.period()
    line.ask(0.005, 0.1)
    line.placing.goal('map', 0.0, STRAIGHT)
    for _ in range(12):
        line.period()
    line.senses = False
    for _ in range(12):
        line.period()
    line.senses = True
    for _ in range(6):
        line.period()
    line.placing.cancel()
    for _ in range(12):
        line.period()
    line.deactivate()
    return line


@pytest.mark.parametrize(('law', 'stages'), [('settle', SETTLES), ('steer', STEERS)])
def test_laws_whose_goals_do_not_end_are_made_again_to_the_last_digit(law, stages, tmp_path):
    line = lasting(law)
    assert {STAGES[int(values['stage'])] for values in line.states} == set(stages)
    bag = line.bag(tmp_path / 'bag')
    (comparison,) = replayed(bag, out=tmp_path / 'out')
    assert (comparison.kept, len(comparison.ticks)) == (0, len(line.ticks) + 1)
    assert not comparison.different()
    said = [STATE, COMMAND, '/push_controller/state']
    assert contents(tmp_path / 'out', said) == contents(bag, said)


def test_a_finger_that_touches_elsewhere_is_made_again_to_the_last_digit(tmp_path):
    line = Line(theta=0.35, d=0.012, late=1, age=0.03, axes=2)
    line.ask(0.015, 0.35)
    line.until(lambda: line.placing.stage == REGRASPING)
    line.until(lambda: line.placing.stage == 'placing')
    for _ in range(20):
        line.period()
    bag = line.bag(tmp_path / 'bag')
    (comparison,) = replayed(bag, out=tmp_path / 'out')
    assert (comparison.kept, len(comparison.ticks)) == (0, len(line.ticks))
    assert not comparison.different()
    assert min(tick.v_y for tick in comparison.ticks) == -0.02
    said = [STATE, COMMAND, '/push_controller/state']
    assert contents(tmp_path / 'out', said) == contents(bag, said)
    (comparison,) = replayed(bag, controller={'axes': 1})
    assert comparison.different()


def test_another_belt_ends_otherwise(run):
    _, bag = run
    (comparison,) = replayed(bag, controller={'belt_length': 0.02})
    assert comparison.different()


@pytest.mark.parametrize('lacking', [STATE, ESTIMATES])
def test_without_what_the_law_was_told_nothing_of_it_is_made_up(run, lacking, tmp_path):
    line, bag = run
    part = copied(bag, tmp_path / 'part', keep=lambda topic: topic != lacking)
    (comparison,) = replayed(part, out=tmp_path / 'out')
    recorded = [COMMAND] if lacking == STATE else [COMMAND, STATE]
    assert contents(tmp_path / 'out', recorded) == contents(bag, recorded)
    assert (comparison.ticks, comparison.kept) == ([], len(line.ticks) + 1)


def test_a_bag_that_begins_in_the_middle_keeps_what_was_recorded(run, tmp_path):
    line, _ = run
    begin = line.heard[0][1] + 3_000_000_000
    rest = Line.__new__(Line)
    rest.parameters = line.parameters
    rest.heard = [row for row in line.heard if row[1] > begin]
    rest.bag(tmp_path / 'rest')
    (comparison,) = replayed(tmp_path / 'rest', out=tmp_path / 'out')
    assert comparison.ticks == []
    assert contents(tmp_path / 'out') == contents(tmp_path / 'rest')


def test_the_bag_can_be_looked_at(run, capsys):
    _, bag = run
    assert main(['info', str(bag)]) == 0
    assert main(['estimate', str(bag)]) == 0
    assert STATE in capsys.readouterr().out
    with BagReader(bag) as reader:
        assert reader.counts['/place/goal'] == 6
