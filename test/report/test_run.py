# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What is made of a bag for its report: series, episodes, scene, outcome, from what is there."""

import math

import numpy as np
import pytest

from support.bag_copies import copied
from support.pushed_bag import (
    DURATION,
    HOSTILE,
    JOINTS,
    PARAMETERS,
    POSE,
    SILENT,
    D,
    centre,
    phi,
    pose,
    run_of,
    sensing_bag,
    theta,
    write_bag,
    written,
)
from tactile_push.bags import BagReader
from tactile_push.estimation import CONTRADICTIONS
from tactile_push.report import messages_shown, read_run


@pytest.mark.parametrize('namespace', ['', '/left'])
def test_topics_without_a_leading_slash_are_reported_as_with_one(tmp_path, namespace):
    with_one = write_bag(tmp_path / 'a', namespace, parameters={})
    without = copied(with_one, tmp_path / 'b', rename=lambda topic: topic[1:])
    run, expected = run_of(without), run_of(with_one)
    assert set(run.series) == set(expected.series)
    assert run.series['phi'].values.tolist() == expected.series['phi'].values.tolist()
    assert [e.text for e in run.episodes] == [e.text for e in expected.episodes]
    assert (run.tables, run.warnings) == (expected.tables, [])


def test_series_are_those_of_the_bag_in_si_units(run):
    ticks = np.arange(0.0, DURATION + 0.01, 0.1)
    silent = (ticks >= SILENT[0] - 1e-9) & (ticks < SILENT[1] - 1e-9)
    assert run.duration == pytest.approx(DURATION)
    assert run.series['theta'].time == pytest.approx(ticks)
    expected = [math.nan if s else theta(t) for t, s in zip(ticks, silent, strict=True)]
    assert run.series['theta'].values == pytest.approx(expected, nan_ok=True)
    assert run.series['phi'].values == pytest.approx([phi(t) for t in ticks])
    assert set(run.series['d_true'].values) == {D}
    assert run.series['interval'].values == pytest.approx(np.full(600, 0.02))
    assert run.series['silence'].values[silent] == pytest.approx(ticks[silent] - SILENT[0])
    poses = np.array([centre(t) for t in run.series['object_x'].time])
    assert run.series['object_x'].values == pytest.approx(poses[:, 0])
    assert run.series['object_y'].values == pytest.approx(poses[:, 1])
    assert 'd' not in run.series
    words = [run.states[int(index)] for index in run.series['state'].values]
    assert words == ['stopped: contact silent' if s else 'pushing' for s in silent]


def test_episodes_are_stops_refusals_and_what_nodes_complain_of(run):
    found = [(e.lane, e.text, e.level, e.start, e.end) for e in run.episodes]
    assert [episode[:3] for episode in found] == [
        ('readings', 'refused: out of plane', 'warning'),
        ('controller', 'stopped: contact silent', 'error'),
        ('sensor_driver', HOSTILE, 'warning'),
    ]
    times = [time for episode in found for time in episode[3:]]
    # The last reading that was refused came 0.02 s before the first good one.
    assert times == pytest.approx([3.0, 3.08, 6.0, 7.0, 8.0, 10.0], abs=1e-6)


def test_facts_and_details_are_those_of_the_bag(run):
    assert run.name == 'pushed'
    assert '2023-11-14 22:13:20 UTC' in run.facts
    assert 'tactile_push 1.2.3' in run.facts
    assert ('note', HOSTILE) in run.tables['Parameters of push_controller']
    assert ('/tactile', JOINTS, '601') in run.tables['Topics']


def test_progress_ends_at_the_messages_that_are_shown(tmp_path):
    told = []
    with BagReader(write_bag(tmp_path / 'pushed')) as bag:
        count = messages_shown(bag)
        read_run(bag, told.append)
        assert count == sum(bag.counts.values())
    assert told == sorted(told) == list(range(1000, count + 1, 1000))


@pytest.mark.parametrize(('namespace', 'node'), [('', 'sim_plant'), ('/left', 'left/sim_plant')])
def test_finger_in_a_namespace_is_found_with_its_own_plant(tmp_path, namespace, node):
    parameters = {node: {**PARAMETERS['sim_plant'], 'mu_c': math.inf}}
    run = run_of(write_bag(tmp_path / 'bag', namespace, parameters=parameters))
    assert run.scene.mu_c == math.inf
    assert len(run.series['theta'].time) == 121
    assert run.warnings == []


def test_l_is_that_of_active_sensing_without_a_simulator_and_a_difference_is_a_warning(tmp_path):
    sensing = {'active_sensing': {'vertices': [-0.03, -0.03, 0.03, -0.03, 0.0, 0.06], 'edge': 0}}
    for name, parameters, l, warnings in (
        ('hardware', sensing, '30', []),
        (
            'both',
            PARAMETERS | sensing,
            '23.75',
            ['l is 23.75 mm by the parameters of /sim_plant and 30 mm by those of /active_sensing'],
        ),
    ):
        run = run_of(write_bag(tmp_path / name, parameters=parameters))
        outcome = {what: here for what, here, _ in run.outcome}
        assert outcome['l [mm]'] == l
        # (17) by hand, -l / tan(phi - theta), at the steps of the last third.
        last = [t / 10.0 for t in range(121) if not 60 <= t < 70][-37:]
        d = [-float(l) / math.tan(phi(t) - theta(t)) for t in last]
        assert outcome['so d by (17) [mm]'] == f'{min(d):.2f} to {max(d):.2f}'
        assert run.warnings == warnings


def test_contradictions_are_episodes(tmp_path):
    run = run_of(sensing_bag(tmp_path / 'bag', [0.05] * 6, [0.0, 3.0, 3.0, 0.0, 99.0, 1.0]))
    found = [(e.lane, e.text, e.level, e.start, e.end) for e in run.episodes]
    assert found == [
        ('object', CONTRADICTIONS[3], 'error', pytest.approx(0.1), pytest.approx(0.3)),
        ('object', CONTRADICTIONS[1], 'error', pytest.approx(0.5), pytest.approx(0.5)),
    ]


def test_contacts_alone_make_a_report(tmp_path):
    normal = 0.2 + math.pi / 2.0
    contact = pose(1.0, 0.02 * math.cos(normal), 0.02 * math.sin(normal), 0.2)
    run = run_of(written(tmp_path / 'bag', ('/contact', POSE, 1.0, contact)))
    assert set(run.series) == {'theta'}
    assert run.series['theta'].values == pytest.approx([0.2])
    assert run.scene.radius == pytest.approx(0.02)
    assert (run.states, run.episodes, run.outcome) == ((), [], [])
