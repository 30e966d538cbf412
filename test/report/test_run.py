# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What is made of a bag for its report: series, episodes, scene, outcome, from what is there."""

import math

import numpy as np
import pytest

from support.pushed_bag import (
    DURATION,
    HOSTILE,
    PARAMETERS,
    SILENT,
    START,
    D,
    L,
    R,
    centre,
    diagnostics,
    joint_state,
    phi,
    pose,
    theta,
    write_bag,
)
from tactile_push.bags import BagError, BagReader, BagWriter
from tactile_push.estimation import CONTRADICTIONS
from tactile_push.report import messages_shown, read_run

JOINTS, POSE = 'sensor_msgs/msg/JointState', 'geometry_msgs/msg/PoseStamped'


def run_of(folder):
    with BagReader(folder) as bag:
        return read_run(bag)


@pytest.fixture(scope='module')
def run(tmp_path_factory):
    return run_of(write_bag(tmp_path_factory.mktemp('run') / 'pushed'))


def written(folder, *messages):
    """Write a bag of (topic, type, time [s], CDR)."""
    with BagWriter(folder) as bag:
        for topic, kind in dict.fromkeys((topic, kind) for topic, kind, _, _ in messages):
            bag.add_topic(topic, kind)
        for topic, _, t, data in messages:
            now = START + round(t * 1e9)
            bag.write(topic, data, now, now)
    return folder


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


def test_scene_follows_the_parameters(run):
    assert run.scene.radius == R
    assert run.scene.mu_c == 0.3
    assert np.ptp(run.scene.outline, axis=0) == pytest.approx([0.05, 2.0 * L])


def test_facts_and_details_are_those_of_the_bag(run):
    assert run.name == 'pushed'
    assert '2023-11-14 22:13:20 UTC' in run.facts
    assert 'tactile_push 1.2.3' in run.facts
    assert ('note', HOSTILE) in run.tables['Parameters of push_controller']
    assert ('/tactile', JOINTS, '601') in run.tables['Topics']


def test_outcome_has_what_follows_from_the_states(run):
    outcome = {what: (here, paper) for what, here, paper in run.outcome}
    assert outcome['steps'] == ('111', '')  # 121 ticks less those of the stop
    assert outcome['θ within 3° of θ_d from step'] == ('never', '173')
    last = [t / 10.0 for t in range(121) if not 60 <= t < 70][-37:]  # the last third
    angles = [math.degrees(phi(t)) for t in last]
    expected = f'{min(angles):.1f} to {max(angles):.1f}'
    assert outcome['φ from step 74 [°]'][0].replace('\u00a0', ' ') == expected
    assert outcome['longest silence of the contact [s]'] == ('0.900 at 6.900 s', '')
    assert outcome['stops'] == ('contact silent 1×', '')


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


def test_second_finger_is_left_out_with_a_word(tmp_path):
    state = joint_state(0.0, theta=0.1, phi=1.5)
    contact = pose(0.0, 0.0, R, 0.0)
    run = run_of(
        written(
            tmp_path / 'bag',
            ('/right/contact', POSE, 0.0, contact),
            ('/left/contact', POSE, 0.0, contact),
            ('/left/push_controller/state', JOINTS, 0.0, state),
        )
    )
    assert run.series['phi'].values.tolist() == [1.5]
    assert run.warnings == ['not shown: the topics in /right']


def test_contacts_alone_make_a_report(tmp_path):
    normal = 0.2 + math.pi / 2.0
    contact = pose(1.0, 0.02 * math.cos(normal), 0.02 * math.sin(normal), 0.2)
    run = run_of(written(tmp_path / 'bag', ('/contact', POSE, 1.0, contact)))
    assert set(run.series) == {'theta'}
    assert run.series['theta'].values == pytest.approx([0.2])
    assert run.scene.radius == pytest.approx(0.02)
    assert (run.states, run.episodes, run.outcome) == ((), [], [])


@pytest.mark.parametrize('shape', ['block', 'disk', 'neither'])
def test_object_without_parameters_is_known_by_its_contacts(tmp_path, shape):
    rows = []
    for k in range(50):
        angle = 0.01 * k
        normal = angle + math.pi / 2.0
        d, l = {'block': (1e-4 * k, 0.02375), 'disk': (0.0, 0.0285), 'neither': (0.0, 0.04)}[shape]
        x = (R + l) * math.cos(normal) - d * math.cos(angle)
        y = (R + l) * math.sin(normal) - d * math.sin(angle)
        turned = angle if shape == 'block' else 3.0 * angle  # a disk may roll
        t = 0.02 * k
        rows += [
            ('/ground_truth/state', JOINTS, t, joint_state(t, theta=angle, d=d)),
            ('/ground_truth/object_pose', POSE, t, pose(t, x, y, turned)),
        ]
    outline = np.array(run_of(written(tmp_path / 'bag', *rows)).scene.outline)
    if shape == 'block':
        assert np.ptp(outline, axis=0) == pytest.approx([0.05, 0.0475])
    elif shape == 'disk':
        assert np.hypot(*outline.T) == pytest.approx(0.0285)
    else:
        assert len(outline) == 0


def test_stamps_of_another_clock_give_way_to_the_time_of_recording(tmp_path):
    contact = pose(-1e6, 0.0, R, 0.0)
    run = run_of(
        written(
            tmp_path / 'bag',
            ('/contact', POSE, 0.0, contact),
            ('/contact', POSE, 5.0, pose(4.9, 0.0, R, 0.0)),
            ('/contact', POSE, 6.0, contact),
        )
    )
    assert run.series['theta'].time == pytest.approx([0.0, 4.9, 6.0])


def test_stamps_that_go_back_are_put_in_order(tmp_path):
    run = run_of(
        written(
            tmp_path / 'bag',
            ('/contact', POSE, 0.0, pose(1.0, 0.0, R, 0.2)),
            ('/contact', POSE, 0.1, pose(0.5, 0.0, R, 0.1)),
        )
    )
    assert run.series['theta'].values == pytest.approx([0.1, 0.2])


def test_states_of_an_older_version_lack_what_they_lack(tmp_path):
    run = run_of(
        written(
            tmp_path / 'bag',
            ('/push_controller/state', JOINTS, 0.0, joint_state(0.0, theta=0.1)),
            ('/push_controller/state', JOINTS, 0.1, joint_state(0.1, theta=0.1, phi=1.5)),
        )
    )
    assert run.series['phi'].values == pytest.approx([math.nan, 1.5], nan_ok=True)
    assert 'silence' not in run.series
    assert run.states == ()


@pytest.mark.parametrize(
    'text', ['nonsense', '[1, 2]', '{"sim_plant": 3}', '{"sim_plant": {"object": 7}}']
)
def test_parameters_that_make_no_sense_are_as_good_as_none(tmp_path, text):
    with BagWriter(tmp_path / 'bag') as bag:
        bag.note('tactile_push.parameters', text)
        bag.add_topic('/contact', POSE)
        bag.write('/contact', pose(0.0, 0.0, R, 0.0), START, START)
    assert len(run_of(tmp_path / 'bag').scene.outline) == 0


def test_status_of_every_level(tmp_path):
    kind = 'diagnostic_msgs/msg/DiagnosticArray'
    levels = (b'\x00', b'\x01', b'\x02', b'\x03')
    rows = [
        ('/diagnostics', kind, float(k), diagnostics(float(k), 'node', level, f'level {k}'))
        for k, level in enumerate(levels)
    ]
    tactile = ('/tactile', JOINTS, 9.0, joint_state(9.0, azimuth=0.0, elevation=1.0))
    run = run_of(written(tmp_path / 'bag', *rows, tactile))
    assert [(e.text, e.level, e.start, e.end) for e in run.episodes] == [
        ('level 1', 'warning', 1.0, 2.0),
        ('level 2', 'error', 2.0, 3.0),
        ('level 3', 'error', 3.0, 5.0),
    ]


def sensing_bag(folder, widths, contradictions):
    """Write a bag of control periods and how wide the 95 % interval of d was in each [m]."""
    rows = []
    for k, (width, contradiction) in enumerate(zip(widths, contradictions, strict=True)):
        t = 0.1 * k
        values = {'theta': 0.1, 'theta_desired': math.radians(-10.0), 'phi': 1.5, 'state': 2.0}
        rows.append(('/push_controller/state', JOINTS, t, joint_state(t, **values)))
        bounds = {'d_lower': -width / 2, 'd_upper': width / 2, 'd_least': -0.025, 'd_most': 0.025}
        sensed = joint_state(t, d=0.0, **bounds, contradiction=contradiction)
        rows.append(('/active_sensing/state', JOINTS, t, sensed))
    return written(folder, *rows)


def test_bounds_of_d_are_shown_and_the_step_from_which_it_is_known(tmp_path):
    widths = [0.05, 0.01, 0.0015, 0.003, 0.001, 0.0005]
    run = run_of(sensing_bag(tmp_path / 'bag', widths, [0.0] * 6))
    assert run.series['d_upper'].values - run.series['d_lower'].values == pytest.approx(widths)
    assert set(run.series['d_least'].values) == {-0.025}
    assert set(run.series['d_most'].values) == {0.025}
    outcome = {what: (here, paper) for what, here, paper in run.outcome}
    assert outcome['d known to 2 mm from step'] == ('4', '400')


@pytest.mark.parametrize(
    ('widths', 'row'), [([0.05, 0.001, 0.01], ('never', '400')), ([0.0] * 3, None)]
)
def test_d_that_is_never_known_or_known_by_roundness(tmp_path, widths, row):
    run = run_of(sensing_bag(tmp_path / 'bag', widths, [0.0] * 3))
    outcome = {what: (here, paper) for what, here, paper in run.outcome}
    assert outcome.get('d known to 2 mm from step') == row


def test_contradictions_are_episodes(tmp_path):
    run = run_of(sensing_bag(tmp_path / 'bag', [0.05] * 6, [0.0, 3.0, 3.0, 0.0, 99.0, 1.0]))
    found = [(e.lane, e.text, e.level, e.start, e.end) for e in run.episodes]
    assert found == [
        ('object', CONTRADICTIONS[3], 'error', pytest.approx(0.1), pytest.approx(0.3)),
        ('object', CONTRADICTIONS[1], 'error', pytest.approx(0.5), pytest.approx(0.5)),
    ]


def test_bag_of_something_else_is_refused(tmp_path):
    data = joint_state(0.0, wheel=1.0)
    folder = written(tmp_path / 'bag', ('/wheels', JOINTS, 0.0, data))
    with pytest.raises(BagError, match=r'bag: nothing to report, expected messages on push_'):
        run_of(folder)


def test_topic_of_another_type_is_refused(tmp_path):
    data = joint_state(0.0, theta=1.0)
    folder = written(tmp_path / 'bag', ('/contact', JOINTS, 0.0, data))
    with pytest.raises(BagError, match=f'bag: /contact: expected {POSE}, got {JOINTS}'):
        run_of(folder)
