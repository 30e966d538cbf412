# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What names and positions that do not fit together say, to nodes, replay and experiment alike."""

import importlib
import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tactile_push.bags import BagReader, BagWriter, schema_text
from tactile_push.control import FINGER_UNKNOWN, NO_REASON, STOP_REASONS, WAITING, PushLaw
from tactile_push.interface import CONTROLLER_STATE, JOINT_STATE_TYPE, JOINT_STATES, TACTILE
from tactile_push.pipeline import Control, Geometry, by_name
from tactile_push.pipeline.messages import joint_state_fields
from tactile_push.pipeline.named import Joints
from tactile_push.replay import replay
from tactile_push.replay.new_bag import encoder
from tactile_push.simulation import experiment, paper_block
from tactile_push.testing.processes import claim_domain

BEGIN = 1_795_000_000  # some day in 2026 [s]
AHEAD = math.pi / 2.0
JOINTS = ['proximal_joint', 'distal_joint']
ANGLES = ['azimuth', 'elevation']


@pytest.mark.parametrize(
    ('names', 'positions', 'values'),
    [
        (['a', 'b'], [1.0, 2.0], {'a': 1.0, 'b': 2.0}),
        (['a', 'b', 'a'], [1.0, 2.0, 3.0], {'b': 2.0}),
        (['a', 'a'], [1.0, 1.0], {}),  # equal values do not make it clear either
        (['a', 'b', 'c'], [1.0, 2.0], {'a': 1.0, 'b': 2.0}),
        (['a', 'b', 'a'], [1.0, 2.0], {'b': 2.0}),
        (['a'], [1.0, 2.0], {'a': 1.0}),
        (['a'], [], {}),
        ([], [1.0], {}),
    ],
)
def test_name_has_a_value_if_it_stands_once_and_has_a_position(names, positions, values):
    assert by_name(names, positions) == values


@given(
    names=st.lists(st.sampled_from('abcd'), max_size=8),
    positions=st.lists(st.floats(allow_nan=False), max_size=8),
)
@settings(derandomize=True, deadline=None)
def test_order_of_the_entries_does_not_matter(names, positions):
    together = min(len(names), len(positions))
    names, positions = names[:together], positions[:together]
    assert by_name(names, positions) == by_name(names[::-1], positions[::-1])


def whole(names, positions):
    return names, positions


def more_positions(names, positions):
    return names, [*positions, 7.0]


def more_names(names, positions):
    return [*names, 'other'], positions


def others_repeated(names, positions):
    return ['other', *names, 'other'], [7.0, *positions, 8.0]


def repeated(names, positions):
    return [*names, names[0]], [*positions, positions[0]]


def repeated_without_position(names, positions):
    return [*names, names[1]], positions


def missing(names, positions):
    return names[:1], positions[:1]


def missing_position(names, positions):
    return names, positions[:1]


USED = [whole, more_positions, more_names, others_repeated]
UNUSED = [repeated, repeated_without_position, missing, missing_position]
CASES = pytest.mark.parametrize('odd', [*USED, *UNUSED])
TOPIC = pytest.mark.parametrize('topic', [JOINT_STATES, TACTILE])


def messages(topic, odd):
    """Return names and positions by topic, those of one topic odd."""
    plain = {JOINT_STATES: (JOINTS, [0.1, 0.0]), TACTILE: (ANGLES, [0.0, AHEAD - 0.1])}
    return {**plain, topic: odd(*plain[topic])}


@pytest.fixture(scope='module')
def ros():
    rclpy = pytest.importorskip('rclpy')
    domain, lock = claim_domain()
    rclpy.init(domain_id=domain, args=['--ros-args', '-p', 'push_controller:autostart:=false'])
    yield
    rclpy.shutdown()
    lock.close()


@CASES
@TOPIC
def test_nodes_read_by_name(ros, topic, odd):
    from sensor_msgs.msg import JointState

    from tactile_push.nodes.contact_geometry import ContactGeometry
    from tactile_push.nodes.push_controller import PushController

    def message(names, positions):
        result = JointState(name=names, position=positions)
        result.header.stamp.sec = BEGIN
        return result

    sent = {name: message(*content) for name, content in messages(topic, odd).items()}
    geometry, controller = ContactGeometry(), PushController()
    for node in (geometry, controller):
        node._on_joint_states(sent[JOINT_STATES])
    geometry._on_tactile(sent[TACTILE])
    tick = controller._control.tick(controller._time.seconds(BEGIN, 0))
    for node in (geometry, controller):
        node.destroy_node()
    assert geometry._counted['contacts'] == (odd in USED)
    assert math.isfinite(tick.finger_x) == (odd in USED or topic == TACTILE)


def write_bag(path, rounds):
    """Write a bag with names and positions of both topics, every 50 ms."""
    encode = encoder(JOINT_STATE_TYPE, schema_text(JOINT_STATE_TYPE))
    with BagWriter(path) as writer:
        for name in (JOINT_STATES, TACTILE):
            writer.add_topic(f'/{name}', JOINT_STATE_TYPE)
        for k, contents in enumerate(rounds):
            at = BEGIN * 10**9 + k * 50_000_000
            for name, content in contents.items():
                fields = joint_state_fields(divmod(at, 10**9), {})
                fields['name'], fields['position'] = content
                writer.write(f'/{name}', encode(fields), at, at)


@CASES
@TOPIC
def test_replay_reads_by_name(topic, odd, tmp_path):
    # All is as it should be in the first messages, so that the law ticks on the others.
    rounds = (messages(topic, odd if k > 1 else whole) for k in range(5))
    write_bag(tmp_path / 'bag', rounds)
    with BagReader(tmp_path / 'bag') as reader:
        (comparison,) = replay(reader, out=tmp_path / 'out')
    joints_known = odd in USED or topic == TACTILE
    assert comparison.readings == 5
    if topic == TACTILE:
        assert comparison.contacts == (5 if odd in USED else 2)
        assert comparison.refused == ({} if odd in USED else {'no azimuth and elevation': 3})
    with BagReader(tmp_path / 'out') as reader:
        states = map(reader.decode, reader.messages([f'/{CONTROLLER_STATE}']))
        ages = [by_name(state.name, state.position)['finger_age'] for state in states]
    assert len(ages) == 2
    # The reading 50 ms after the second tick lets it happen, and has joint angles of its own.
    assert ages[-1] == pytest.approx(-0.05 if joints_known else 0.05, abs=1e-6)


@pytest.mark.parametrize(('wanted', 'reason'), [(True, FINGER_UNKNOWN), (False, NO_REASON)])
def test_replay_stops_as_the_node_does_for_joints_of_other_names(wanted, reason, tmp_path):
    others = {JOINT_STATES: (['l_one', 'l_two'], [0.1, 0.1]), TACTILE: (ANGLES, [0.0, AHEAD - 0.1])}
    write_bag(tmp_path / 'bag', [others] * 20)
    config = tmp_path / 'wanted.yaml'
    config.write_text(
        'contact_geometry: {ros__parameters: {use_joint_states: false}}\n'
        f'push_controller: {{ros__parameters: {{use_joint_states: {str(wanted).lower()}}}}}\n'
    )
    with BagReader(tmp_path / 'bag') as reader:
        replay(reader, config=config, out=tmp_path / 'out')
    with BagReader(tmp_path / 'out') as reader:
        states = map(reader.decode, reader.messages([f'/{CONTROLLER_STATE}']))
        reasons = [by_name(state.name, state.position)['stop_reason'] for state in states]
    assert len(reasons) == 10
    assert STOP_REASONS[int(reasons[-1])] == reason
    assert STOP_REASONS[int(reasons[0])] == NO_REASON


@CASES
@TOPIC
def test_experiment_reads_by_name(topic, odd, monkeypatch):
    ticks = []

    class OddGeometry(Geometry):
        def joint_states(self, stamp, names, positions):
            content = odd(list(names), list(positions)) if topic == JOINT_STATES else None
            return super().joint_states(stamp, *(content or (names, positions)))

        def tactile(self, stamp, names, positions, joint_angle=None):
            content = odd(list(names), list(positions)) if topic == TACTILE else None
            return super().tactile(stamp, *(content or (names, positions)), joint_angle)

    class OddControl(Control):
        def joint_states(self, stamp, names, positions):
            content = odd(list(names), list(positions)) if topic == JOINT_STATES else None
            return super().joint_states(stamp, *(content or (names, positions)))

        def tick(self, stamp, elapsed=math.nan):
            ticks.append(super().tick(stamp, elapsed))
            return ticks[-1]

    module = importlib.import_module('tactile_push.simulation.experiment')
    monkeypatch.setattr(module, 'Geometry', OddGeometry)
    monkeypatch.setattr(module, 'Control', OddControl)
    run = experiment(paper_block(), PushLaw(0.05, 5.0, 0.0), 3)
    assert run.end == ('done' if odd in USED else WAITING)
    assert math.isfinite(ticks[-1].finger_x) == (odd in USED or topic == TACTILE)


def of_joints(*messages):
    """Return what is wrong after messages of names with positions."""
    joints = Joints(JOINTS)
    for names, positions in messages:
        joints.angles(names, positions)
    return joints.trouble


PREFIXED = ['left_proximal_joint', 'left_distal_joint']


@pytest.mark.parametrize(
    ('messages', 'trouble'),
    [
        ([], ''),
        ([(JOINTS, [0.1, 0.2])], ''),
        ([(['wheel'], [1.0]), (JOINTS, [0.1, 0.2])], ''),
        (
            [(PREFIXED, [0.1, 0.2])],
            'joint_names: expected proximal_joint, distal_joint in joint_states, '
            'got no proximal_joint, distal_joint, but left_proximal_joint, left_distal_joint',
        ),
        (
            [(['proximal_joint', 'distaljoint'], [0.1, 0.2])],
            'joint_names: expected proximal_joint, distal_joint in joint_states, '
            'got no distal_joint, but proximal_joint, distaljoint',
        ),
        (
            [(JOINTS[:1], [0.1]), (JOINTS[1:], [0.2])],
            'joint_names: expected proximal_joint, distal_joint in one message of joint_states, '
            'got each in another',
        ),
        (
            [(JOINTS, [])],
            'joint_states: proximal_joint has no position, distal_joint has no position',
        ),
        ([(JOINTS, [0.1])], 'joint_states: distal_joint has no position'),
        (
            [([*JOINTS, JOINTS[0]], [0.1, 0.2, 0.1])],
            'joint_states: proximal_joint is named more than once',
        ),
        ([(JOINTS, [0.1, math.nan])], 'joint_states: distal_joint is nan'),
        ([([], [])], 'joint_states: no names'),
        (
            [(PREFIXED, [0.1, 0.2]), (JOINTS, [math.inf, 0.2])],
            'joint_states: proximal_joint is inf',
        ),
    ],
)
def test_trouble_names_what_is_missing_and_what_was_seen(messages, trouble):
    assert of_joints(*messages) == trouble


def test_names_of_others_do_not_fill_memory_or_message():
    trouble = of_joints(*(([f'{k}' * 100], [0.0]) for k in range(10_000)))
    assert len(trouble) < 600
    assert trouble.endswith('...')


NUMBERS = st.lists(st.floats(), max_size=4)


@given(st.lists(st.tuples(st.lists(st.sampled_from([*JOINTS, 'x', '']), max_size=4), NUMBERS)))
@settings(derandomize=True, deadline=None)
def test_there_is_trouble_unless_the_last_message_has_finite_angles_of_all_joints(messages):
    joints = Joints(JOINTS)
    for names, positions in messages:
        angles = joints.angles(names, positions)
        assert (angles is None) == (not set(JOINTS) <= by_name(names, positions).keys())
        assert bool(joints.trouble) == (angles is None or not all(map(math.isfinite, angles)))
