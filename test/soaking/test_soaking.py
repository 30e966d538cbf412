# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import importlib
import itertools
import json
import math
import random
import sys

import pytest

from soaking.episodes import DESIRED, HOME, MOST, episodes, next_desired
from soaking.report import Report
from soaking.run import Soak
from tactile_push.parameters.sim_plant import FAULTS


@pytest.fixture
def script():
    """Load the command as a module."""
    module = importlib.import_module('soaking.__main__')
    return module


@pytest.fixture
def main(script, monkeypatch, capsys):
    """Return a function that runs the command: exit status, standard output, error."""
    monkeypatch.setattr(script, 'interrupt_once', lambda: None)

    def command(*arguments):
        monkeypatch.setattr(sys, 'argv', ['soaking', *map(str, arguments)])
        try:
            status = script.main()
        except SystemExit as end:
            status = end.code
        return status, *capsys.readouterr()

    return command


def growing(rate, hours=10.0, noise=0.3):
    """Return memory that grows at a rate after it has settled, with noise."""
    draw = random.Random(1)
    times = [0.01 * k for k in range(int(100 * hours) + 1)]
    return [
        (t, 70.0 + 3.0 * min(t, 0.05 * hours) + rate * t + draw.uniform(-noise, noise))
        for t in times
    ]


@pytest.mark.parametrize(('rate', 'flat'), [(0.0, True), (0.8, True), (1.2, False)])
def test_memory_may_grow_by_less_than_a_megabyte_an_hour(rate, flat):
    report = Report(1, hours=10.0, memory={'driver': growing(rate)})
    assert report.growth('driver') == pytest.approx(rate, abs=0.05)
    complaints = report.complaints()
    assert complaints == [] if flat else complaints[0].startswith('driver: memory grows by 1.2')


def test_growth_of_a_short_run_is_noise_unless_it_is_much():
    short = Report(1, hours=0.1, memory={'driver': growing(3.0, hours=0.1, noise=0.0)})
    assert short.complaints() == []
    much = Report(1, hours=0.1, memory={'driver': growing(30.0, hours=0.1, noise=0.0)})
    assert len(much.complaints()) == 1


def test_memory_seen_too_rarely_says_nothing():
    assert Report(1, hours=1.0, memory={'driver': [(0.0, 70.0), (0.9, 90.0)]}).growth('driver') == 0


def test_ticks_may_get_lost_in_faults_alone():
    assert Report(1, ticks_lost_in_faults=3).complaints() == []
    assert Report(1, ticks_lost=3).complaints() == ['3 ticks lost outside faults']


def test_object_settles_or_the_controller_says_why_not():
    report = Report(
        1,
        outcomes=[
            ('servo_delay', 'settled'),
            ('sensor_dropout', 'stopped: contact silent'),
            ('belt_stopped', 'not settled, theta = 40.0 degrees'),
        ],
    )
    assert report.complaints() == ['belt_stopped: not settled, theta = 40.0 degrees']


def test_what_ended_the_run_is_a_complaint():
    assert Report(1, broken=['sim_plant ended with status 1']).complaints() == [
        'sim_plant ended with status 1'
    ]


def test_every_fault_of_the_plant_that_goes_away_comes_in_every_round():
    lasting = {'workspace_min', 'workspace_max', 'sensor_detectable_range'}
    shapes = {'belt_ripple_frequency', 'mu_c_ripple_length'}
    faults = {parameter.name for parameter in FAULTS}
    unfelt = {name for name in faults if name.startswith('wrench_')}  # by a sensor of sentences
    unfelt.add('lift_delay')  # nothing is let go of
    assert set(MOST) == faults - lasting - shapes - unfelt
    stream = episodes(random.Random(1))
    for _ in range(2):
        assert {e.fault for e in itertools.islice(stream, len(MOST))} == set(MOST)


def test_same_seed_gives_the_same_episodes_within_their_bounds():
    first = list(itertools.islice(episodes(random.Random(7)), 100))
    assert first == list(itertools.islice(episodes(random.Random(7)), 100))
    declared = {parameter.name: parameter for parameter in FAULTS}
    for episode in first:
        parameter = declared[episode.fault]
        assert type(episode.value) is type(parameter.default)
        assert episode.value != parameter.default == episode.default
        assert parameter.lower <= episode.value <= parameter.upper
        assert 0.0 < episode.duration <= 20.0


def test_object_is_turned_to_either_side_until_the_finger_has_to_come_back():
    assert next_desired(DESIRED, HOME) == -DESIRED
    assert next_desired(-DESIRED, HOME) == DESIRED
    # Where theta settles at a positive angle the finger pushes to the left, towards -x.
    for desired in (DESIRED, -DESIRED):
        assert next_desired(desired, HOME + 0.03) == DESIRED
        assert next_desired(desired, HOME - 0.03) == -DESIRED


def test_real_nodes_go_through_some_episodes(main, tmp_path):
    file = tmp_path / 'soak.json'
    status, out, _ = main('--hours', '0.015', '--json', file)
    assert status == 0, out
    report = json.loads(file.read_text())
    assert report['hours'] >= 0.015
    assert report['ticks'] >= 0.015 * 36000 - 10
    assert report['ticks_lost'] == 0
    assert len(report['outcomes']) >= 1
    assert len(report['memory']) == 4
    assert all(math.isfinite(m['growth_mb_per_h']) for m in report['memory'].values())


def test_broken_report_ends_the_command_with_1(script, main, monkeypatch):
    class Broken:
        def __init__(self, *arguments):
            pass

        def run(self):
            return Report(1, ticks_lost=1)

    monkeypatch.setattr(script, 'Soak', Broken)
    status, out, _ = main()
    assert status == 1
    assert 'BROKEN            1 ticks lost outside faults' in out


@pytest.mark.parametrize(
    'arguments', [('--hours', '0'), ('--hours', 'nan'), ('--json', '/nowhere/x'), ('--nonsense',)]
)
def test_bad_usage_ends_the_command_with_2(main, arguments):
    assert main(*arguments)[0] == 2


class Clumsy(Soak):
    """A run in which the object is lost once."""

    def _outcome(self, episode):
        outcome = super()._outcome(episode)
        if self._plants == 1:
            self._go_on('contact silent')
        return outcome


@pytest.mark.first
def test_lost_object_is_put_back_and_the_run_goes_on():
    report = Clumsy(0.035, 1).run()
    assert report.complaints() == []
    assert report.ticks_lost == 0
    assert report.hours >= 0.035
    assert set(report.memory) >= {'sim_plant 1', 'sim_plant 2'}
    times = [time for time, _ in report.memory['push_controller']]
    assert times == sorted(times)
