# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Comparison of bags against differences that were put there."""

import math
import struct
import tempfile
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mcap.writer import Writer

from support.bag_making import encode, joint_state, write_bag, write_file, write_foreign_bag
from support.bags_to_compare import CLOCK, JOINT_STATE, PERIOD, STATE, clocks, states
from tactile_push.bags import BagError, BagReader, schema_text
from tactile_push.comparing.diff import diff
from tactile_push.comparing.differences import Difference, Tolerances


@pytest.fixture
def compare(tmp_path):
    """Return a function that writes two bags and compares them: results by topic."""

    def run(a, b, **options):
        paths = [
            topics
            if isinstance(topics, Path)
            else write_bag(tmp_path / f'{name}{len(list(tmp_path.iterdir()))}', topics)
            for name, topics in (('a', a), ('b', b))
        ]
        with BagReader(paths[0]) as one, BagReader(paths[1]) as other:
            return {result.name: result for result in diff(one, other, **options)}

    return run


def test_equal_bags_are_the_same(compare):
    topics = {STATE: states(), '/clock': clocks(1, 2, 3)}
    results = compare(topics, topics)
    assert list(results) == ['/clock', STATE]
    assert all(result.same for result in results.values())
    assert results[STATE].compared == 5
    assert (results['/clock'].compared, results['/clock'].by_stamp) == (3, False)
    assert results[STATE].by_stamp
    assert results[STATE].first is None


def test_one_number_is_found(compare):
    result = compare({STATE: states()}, {STATE: states(change={3: {'phi': 1.25}})})[STATE]
    found = Difference(3 * PERIOD, 'position.phi', 1.5, 1.25, 0.25)
    assert (result.compared, result.different) == (5, 1)
    assert result.first == found
    assert list(result.fields) == ['position.phi']
    entry = result.fields['position.phi']
    assert (entry.first, entry.largest, entry.messages) == (found, found, 1)
    assert not result.same


def test_first_and_largest_difference_of_each_field(compare):
    change = {1: {'phi': 1.0}, 2: {'phi': 4.5, 'theta': 9.2}, 4: {'phi': 0.0}}
    result = compare({STATE: states()}, {STATE: states(change=change)})[STATE]
    assert (result.compared, result.different) == (5, 3)
    phi, theta = result.fields['position.phi'], result.fields['position.theta']
    assert (phi.first.key, phi.largest.key, phi.messages) == (PERIOD, 2 * PERIOD, 3)
    assert (phi.largest.a, phi.largest.b, phi.largest.distance) == (1.5, 4.5, 3.0)
    assert (theta.first.key, theta.messages) == (2 * PERIOD, 1)
    assert result.first == phi.first


def test_missing_messages_do_not_shift_the_rest(compare):
    kind, messages = states(10)
    a = [message for k, message in enumerate(messages) if k not in (7, 8)]
    b = [message for k, message in enumerate(messages) if k != 2]
    result = compare({STATE: (kind, a)}, {STATE: (kind, b)})[STATE]
    assert (result.compared, result.different) == (7, 0)
    assert (result.only_a, result.first_only_a) == (1, 2 * PERIOD)
    assert (result.only_b, result.first_only_b) == (2, 7 * PERIOD)
    assert not result.same and not result.remarks


def test_repeated_stamps_are_paired_in_order(compare):
    messages = [(k, joint_state(7, x=float(x))) for k, x in enumerate((1, 2, 3))]
    others = [(k, joint_state(7, x=float(x))) for k, x in enumerate((1, 5))]
    result = compare({'/x': (JOINT_STATE, messages)}, {'/x': (JOINT_STATE, others)})['/x']
    assert (result.compared, result.different, result.only_a, result.only_b) == (2, 1, 1, 0)
    assert result.first == Difference(7, 'position.x', 2.0, 5.0, 3.0)


def test_without_header_the_order_counts(compare):
    result = compare({'/clock': clocks(1, 2, 3, 9)}, {'/clock': clocks(1, 2, 5)})['/clock']
    assert (result.compared, result.different, result.only_a, result.only_b) == (3, 1, 1, 0)
    assert result.first == Difference(2, 'clock', '0.000000003', '0.000000005', 2e-9)
    assert result.first_only_a == 3


def test_two_runs_have_no_stamp_in_common(compare):
    result = compare({STATE: states(5)}, {STATE: states(4, start=100)})[STATE]
    assert (result.compared, result.only_a, result.only_b) == (0, 5, 4)
    assert result.remarks == ['no stamp is in both bags']


def test_topic_of_one_bag_is_a_difference_unless_left_out(compare):
    a, b = {STATE: states(), '/clock': clocks(1)}, {STATE: states()}
    results = compare(a, b)
    assert results['/clock'].remarks == ['only A has the topic']
    assert results['/clock'].types == (CLOCK, None)
    assert compare(b, a)['/clock'].remarks == ['only B has the topic']
    for options in ({'ignore': ['/clock']}, {'topics': [STATE]}):
        results = compare(a, b, **options)
        assert list(results) == [STATE]
        assert results[STATE].same


def test_topic_without_messages_is_as_good_as_none(compare):
    assert compare({STATE: states(), '/clock': (CLOCK, [])}, {STATE: states()})[STATE].same
    assert compare({'/clock': (CLOCK, [])}, {'/clock': (CLOCK, [])}) == {}
    result = compare({'/clock': clocks(1)}, {'/clock': (CLOCK, [])})['/clock']
    assert result.remarks == ['only A has the topic']


def test_unknown_topic_is_refused(compare):
    with pytest.raises(BagError, match='no topic /nowhere in .*: they have /clock') as caught:
        compare({'/clock': clocks(1)}, {'/clock': clocks(1)}, topics=['/clock', '/nowhere'])
    assert '\n' not in str(caught.value)


def test_what_no_bag_has_is_no_tolerance_and_nothing_to_ignore(compare):
    bags = {STATE: states()}, {STATE: states(kp=0.05)}
    with pytest.raises(BagError, match=f'no topic /nowhere in .* they have {STATE}'):
        compare(*bags, ignore=['/nowhere'])
    with pytest.raises(BagError, match='no topic /nowhere in '):
        compare(*bags, tolerances=Tolerances(0.0, {('/nowhere', 'theta'): 1.0}))
    for wrong in ('thta', 'eta', 'log_time'):
        with pytest.raises(BagError, match=f'no field {wrong} in {STATE}: it has .*position.theta'):
            compare(*bags, tolerances=Tolerances(0.0, {(STATE, wrong): 1.0}))
    for right in ('kp', 'theta', 'position', 'position.theta', 'header', 'stamp', 'velocity'):
        compare(*bags, tolerances=Tolerances(0.0, {(STATE, right): 1.0}))
    compare(*bags, tolerances=Tolerances(0.0, {(STATE, 'log_time'): 1.0}), times=True)


def test_another_type_is_a_difference_in_words(compare):
    pose = 'geometry_msgs/msg/PoseStamped'
    result = compare({'/x': states()}, {'/x': (pose, [(1, encode(pose, 1))])})['/x']
    assert result.remarks == [f'type {JOINT_STATE} in A, {pose} in B']
    assert (result.compared, result.counts) == (0, (5, 1))


OLD = 'std_msgs/Header header\nfloat64 x\nfloat64 y\n'
NEW = '# x is gone\nstd_msgs/Header header # when\n\nfloat64  y\nfloat64 z\n'


def file_of_pairs(path, definition, values):
    """Write a file of a type of our own with a header and two numbers."""
    parts = schema_text('geometry_msgs/msg/PointStamped').split('=' * 80, 1)[1]
    data = b'\0\1\0\0' + struct.pack('<iII1s3x2d', 1, 2, 1, b'', *values)
    topics = {'/pair': ('my_msgs/msg/Pair', [(5, data)])}
    text = f'{definition}\n{"=" * 80}{parts}'
    return write_file(path, topics, definitions={'my_msgs/msg/Pair': text})


def test_another_definition_is_a_difference_in_words(compare, tmp_path):
    old = file_of_pairs(tmp_path / 'old.mcap', OLD, (1.0, 2.0))
    new = file_of_pairs(tmp_path / 'new.mcap', NEW, (1.0, 2.0))
    result = compare(old, new)['/pair']
    assert result.remarks == ['A and B define my_msgs/msg/Pair differently']
    assert (result.fields_only_a, result.fields_only_b) == (['x'], ['z'])
    # The same bytes mean something else.
    assert result.first == Difference(1_000_000_002, 'y', 2.0, 1.0, 1.0)


def test_remarks_in_a_definition_are_no_difference(compare, tmp_path):
    old = file_of_pairs(tmp_path / 'old.mcap', OLD, (1.0, 2.0))
    remarked = OLD.replace('x\n', ' x   # ahead\n\n# and\n')
    same = file_of_pairs(tmp_path / 'same.mcap', remarked, (1.0, 2.0))
    assert compare(old, same)['/pair'].same


def test_field_of_one_bag_is_named_once(compare):
    result = compare({STATE: states()}, {STATE: states(kp=0.05)})[STATE]
    assert (result.fields_only_a, result.fields_only_b) == ([], ['position.kp'])
    assert (result.compared, result.different, result.fields) == (5, 0, {})
    assert not result.same


def test_tolerances(compare):
    a = {STATE: states()}
    b = {STATE: states(change={1: {'phi': 1.5 + 2e-3}, 2: {'theta': 0.2 + 1e-6}})}

    def fields(default, special=()):
        tolerances = Tolerances(default, dict(special))
        return set(compare(a, b, tolerances=tolerances)[STATE].fields)

    both = {'position.phi', 'position.theta'}
    assert fields(0.0) == both
    assert fields(1e-4) == {'position.phi'}
    assert fields(1e-2) == set()
    assert fields(0.0, {(STATE, 'theta'): 1e-5}) == {'position.phi'}
    assert fields(0.0, {(STATE, 'position.theta'): 1e-5}) == {'position.phi'}
    assert fields(0.0, {(STATE, 'position'): 1e-5}) == {'position.phi'}
    assert fields(1.0, {(STATE, 'theta'): 0.0}) == {'position.theta'}
    assert fields(0.0, {(STATE, 'position'): 1.0, (STATE, 'theta'): 0.0}) == {'position.theta'}
    a['/another'] = b['/another'] = states()
    assert fields(0.0, {('/another', 'theta'): 1.0}) == both


def test_exactly_the_tolerance_is_allowed(compare):
    a, b = ({'/x': (JOINT_STATE, [(1, joint_state(1, x=x))])} for x in (1.0, 1.25))
    assert compare(a, b, tolerances=Tolerances(0.25))['/x'].same
    assert not compare(a, b, tolerances=Tolerances(math.nextafter(0.25, 0.0)))['/x'].same


def test_infinite_tolerance_leaves_a_field_out(compare):
    a = {STATE: states(phi=math.nan)}
    b = {STATE: states(kp=0.05)}
    tolerances = Tolerances(0.0, {(STATE, 'phi'): math.inf, (STATE, 'kp'): math.inf})
    assert compare(a, b, tolerances=tolerances)[STATE].same


def test_times_are_compared_if_asked_for(compare):
    a = {STATE: states(3)}
    kind, messages = states(3)
    b = {STATE: (kind, [(time + 5_000_000 * (k == 1), m) for k, (time, m) in enumerate(messages)])}
    assert compare(a, b)[STATE].same
    result = compare(a, b, times=True)[STATE]
    assert result.different == 1
    assert set(result.fields) == {'log_time', 'publish_time'}
    assert result.first == Difference(PERIOD, 'log_time', '0.103000000', '0.108000000', 0.005)
    assert compare(a, b, times=True, tolerances=Tolerances(0.005))[STATE].same


def test_bag_of_rosbags_equals_our_own(compare, tmp_path):
    topics = {STATE: states(), '/clock': clocks(1, 2)}
    theirs = write_foreign_bag(tmp_path / 'theirs', topics)
    results = compare(theirs, topics)
    assert [(result.compared, result.different) for result in results.values()] == [(2, 0), (5, 0)]
    assert all(result.same for result in results.values())


def file_of_json(path, *messages, encoding='json', schema='jsonschema', definition=b'{}'):
    with open(path, 'wb') as stream:
        writer = Writer(stream)
        writer.start()
        channel = writer.register_channel(
            STATE, encoding, writer.register_schema(JOINT_STATE, schema, definition)
        )
        for k, message in enumerate(messages):
            writer.add_message(channel, k * PERIOD, message, k * PERIOD)
        writer.finish()
    return path


def test_what_cannot_be_decoded_is_compared_byte_by_byte(compare, tmp_path):
    a = file_of_json(tmp_path / 'a.mcap', b'{}', b'{"x": 1}')
    b = file_of_json(tmp_path / 'b.mcap', b'{}', b'{"x": 2}', definition=b'{"other": 1}')
    note = "compared byte by byte: message encoding 'json', schema encoding 'jsonschema'"
    same = compare(a, a)[STATE]
    assert (same.same, same.compared, same.notes) == (True, 2, [note])
    result = compare(a, b, tolerances=Tolerances(9.0))[STATE]
    assert (result.same, result.different, result.notes) == (False, 1, [note])
    assert result.first == Difference(1, 'bytes [6]', ord('1'), ord('2'), math.inf)
    cdr = file_of_json(tmp_path / 'c.mcap', b'{}', encoding='cdr')
    other = compare(a, cdr)[STATE]
    assert (other.same, other.compared) == (False, 0)
    assert other.remarks[0].startswith("message encoding 'json', schema encoding 'jsonschema' in A")


VALUES = st.floats(width=64) | st.sampled_from([0.0, 1.0])
ROWS = st.lists(st.tuples(st.integers(0, 10), VALUES, VALUES), min_size=1, max_size=20)


def bag_of(folder, name, rows):
    messages = [(k, joint_state(stamp, x=x, y=y)) for k, (stamp, x, y) in enumerate(rows)]
    return BagReader(write_bag(Path(folder, name), {'/x': (JOINT_STATE, messages)}))


@pytest.mark.slow
@settings(max_examples=30, deadline=None)
@given(ROWS)
def test_bag_equals_itself(rows):
    with tempfile.TemporaryDirectory() as folder:
        (result,) = diff(bag_of(folder, 'a', rows), bag_of(folder, 'b', rows), times=True)
    assert result.same
    assert result.compared == len(rows)


def mirrored(found):
    return Difference(found.key, found.where, found.b, found.a, found.distance)


@pytest.mark.slow
@settings(max_examples=50, deadline=None)
@given(ROWS, ROWS)
def test_comparison_is_symmetric(rows_a, rows_b):
    with tempfile.TemporaryDirectory() as folder:
        a, b = bag_of(folder, 'a', rows_a), bag_of(folder, 'b', rows_b)
        (there,), (back,) = diff(a, b), diff(b, a)
    assert (there.compared, there.different) == (back.compared, back.different)
    assert (there.only_a, there.only_b) == (back.only_b, back.only_a)
    assert there.first_only_a == back.first_only_b
    assert set(there.fields) == set(back.fields)
    for name, found in there.fields.items():
        again = back.fields[name]
        assert found.messages == again.messages
        # As text, for NaN.
        assert repr(found.first) == repr(mirrored(again.first))
        assert found.largest.distance == again.largest.distance


@pytest.mark.slow
@settings(max_examples=50, deadline=None)
@given(ROWS, st.data())
def test_a_single_change_is_found_exactly(rows, data):
    place = data.draw(st.integers(0, len(rows) - 1))
    field = data.draw(st.sampled_from([1, 2]))
    before = rows[place][field]
    after = data.draw(
        VALUES.filter(lambda x: x != before and not (math.isnan(x) and math.isnan(before)))
    )
    changed = list(rows)
    changed[place] = tuple(after if k == field else x for k, x in enumerate(rows[place]))
    with tempfile.TemporaryDirectory() as folder:
        (result,) = diff(bag_of(folder, 'a', rows), bag_of(folder, 'b', changed))
    assert (result.compared, result.different) == (len(rows), 1)
    assert (result.only_a, result.only_b) == (0, 0)
    name = f'position.{" xy"[field]}'
    assert list(result.fields) == [name]
    first = result.first
    assert (first.key, first.where) == (rows[place][0], name)
    assert repr((first.a, first.b)) == repr((before, after))
