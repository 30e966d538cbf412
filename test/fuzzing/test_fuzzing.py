# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import copy
import importlib
import itertools
import math
import random
import sys

import pytest
from geometry_msgs.msg import PoseStamped, TwistStamped
from hypothesis import given, settings
from hypothesis import strategies as st
from sensor_msgs.msg import JointState

import fuzzing.chain
from faults.promise import PLAIN
from faults.table import start_bench
from fuzzing.chain import Chain, FuzzError, run
from fuzzing.messages import extremes
from fuzzing.mutation import mutated_input
from fuzzing.nodes import send_extremes


def pieces(seed=1):
    return mutated_input(random.Random(seed))


def test_spoiled_input_moves_the_finger_within_its_bounds():
    chain, growth = run(pieces(), 200_000)
    assert chain.readings > 1000
    assert chain.moving > 100
    assert growth < 100_000


def test_same_seed_gives_the_same_input_and_another_seed_another():
    first = list(itertools.islice(pieces(), 200))
    assert first == list(itertools.islice(pieces(), 200))
    assert first != list(itertools.islice(pieces(2), 200))
    assert all(first)


def test_input_holds_what_lines_and_buffers_make():
    data = b''.join(itertools.islice(pieces(), 5000))
    assert data.count(b'$PTACT') > 1000
    assert any(byte >= 128 for byte in data)
    assert max(map(len, data.split(b'\n'))) > 5000


@settings(max_examples=200, deadline=None)
@given(st.lists(st.binary(max_size=300), max_size=30))
def test_any_bytes_are_borne(reads):
    chain = Chain()
    for data in reads:
        chain.read(data)
    assert chain.reads == len(reads)


@settings(max_examples=100, deadline=None)
@given(st.integers(0, 2**32), st.lists(st.tuples(st.integers(0, 400), st.binary(max_size=3))))
def test_any_change_of_valid_input_is_borne(seed, changes):
    data = bytearray(b''.join(itertools.islice(pieces(seed), 20)))
    for place, other in changes:
        data[place : place + 2] = other
    chain = Chain()
    for start in range(0, len(data), 100):
        chain.read(bytes(data[start : start + 100]))


def test_velocity_that_is_no_number_is_found(monkeypatch):
    monkeypatch.setattr(
        'tactile_push.control.push_control.finger_velocity', lambda phi, belt_speed: math.nan
    )
    monkeypatch.setattr(
        'tactile_push.control.limits.Limits.velocity', lambda self, wanted, *rest: wanted
    )
    with pytest.raises(FuzzError, match='nan'):
        run(pieces(), 100_000)


def test_kick_is_found(monkeypatch):
    speeds = itertools.cycle((0.015, -0.015))
    monkeypatch.setattr(
        'tactile_push.control.limits.Limits.velocity', lambda self, *rest: next(speeds)
    )
    with pytest.raises(FuzzError, match='step'):
        run(pieces(), 100_000)


def test_memory_that_grows_is_found(monkeypatch):
    kept = []

    class Leaky(fuzzing.chain.SentenceStream):
        def feed(self, data):
            kept.append(data)
            return super().feed(data)

    monkeypatch.setattr(fuzzing.chain, 'SentenceStream', Leaky)
    with pytest.raises(FuzzError, match='memory grew'):
        run(pieces(), 500_000)


@pytest.mark.parametrize(
    ('message', 'fields'),
    [
        (
            PoseStamped(),
            {'header.stamp.sec', 'header.stamp.nanosec', 'header.frame_id'}
            | {f'pose.position.{axis}' for axis in 'xyz'}
            | {f'pose.orientation.{axis}' for axis in 'xyzw'},
        ),
        (
            TwistStamped(),
            {'header.stamp.sec', 'header.stamp.nanosec', 'header.frame_id'}
            | {f'twist.{kind}.{axis}' for kind in ('linear', 'angular') for axis in 'xyz'},
        ),
        (
            JointState(),
            {'header.stamp.sec', 'header.stamp.nanosec', 'header.frame_id'}
            | {'name', 'position', 'velocity', 'effort'},
        ),
    ],
)
def test_every_field_goes_to_its_extremes(message, fields):
    before = copy.deepcopy(message)
    spoiled = list(extremes(message))
    assert message == before
    assert {what.partition(' = ')[0] for what, _ in spoiled} == fields
    assert {m.header.stamp.sec for _, m in spoiled} >= {-(2**31), 2**31 - 1}


def test_real_nodes_bear_every_field_at_its_extremes():
    bench = start_bench(PLAIN)
    try:
        assert send_extremes(bench) > 200
    finally:
        assert bench.close() == []


@pytest.fixture
def main(monkeypatch, capsys):
    """Return a function that runs the command: exit status, standard output, error."""
    module = importlib.import_module('fuzzing.__main__')
    monkeypatch.setattr(module, 'interrupt_once', lambda: None)

    def command(outcome, *arguments):
        def messages(progress):
            if isinstance(outcome, BaseException):
                raise outcome
            return outcome

        monkeypatch.setattr(module, 'fuzz_messages', messages)
        monkeypatch.setattr(sys, 'argv', ['fuzzing', *arguments])
        try:
            status = module.main()
        except SystemExit as end:
            status = end.code
        return status, *capsys.readouterr()

    return command


def test_command_says_what_it_did(main):
    status, out, _ = main('all is well', '--bytes', '50000')
    assert status == 0
    assert out.splitlines()[0].startswith('50000 bytes in ')
    assert out.splitlines()[1] == 'all is well'


@pytest.mark.parametrize(
    ('outcome', 'status'), [(FuzzError('a node ended'), 1), (KeyboardInterrupt(), 130)]
)
def test_command_ends_as_what_it_runs(main, outcome, status):
    assert main(outcome, '--bytes', '1000')[0] == status


@pytest.mark.parametrize('arguments', [('--bytes', '0'), ('--bytes', 'many'), ('--nonsense',)])
def test_bad_usage_ends_the_command_with_2(main, arguments):
    assert main('', *arguments)[0] == 2
