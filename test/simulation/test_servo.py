# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import itertools
import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tactile_push.simulation import Servo, Workspace
from tactile_push.simulation.servo import FLAT, DelayLine, lagged, quantised

PROPERTY = settings(derandomize=True, deadline=None, max_examples=80)
speeds = st.floats(-0.02, 0.02)


def follow(velocity, command, time_constant, duration):
    """Follow a command for a while; return all pieces and the velocity at the end."""
    pieces = []
    while True:
        elapsed, mean, velocity = lagged(velocity, command, time_constant, duration)
        pieces.append((elapsed, mean))
        if elapsed >= duration:
            return pieces, velocity
        duration -= elapsed


def test_lag_makes_63_percent_of_a_step_in_its_time_constant():
    _, velocity = follow(0.0, 0.01, 0.1, 0.1)
    assert velocity == pytest.approx(0.01 * (1.0 - 1.0 / math.e), rel=1e-12)


@given(speeds, speeds, st.floats(1e-4, 2.0), st.floats(1e-3, 3.0))
@PROPERTY
def test_lag_is_the_exponential_and_its_integral(start, command, time_constant, duration):
    pieces, velocity = follow(start, command, time_constant, duration)
    decay = math.exp(-duration / time_constant)
    way = command * duration + (start - command) * time_constant * (1.0 - decay)
    assert sum(time for time, _ in pieces) == pytest.approx(duration, rel=1e-12)
    assert sum(time * mean for time, mean in pieces) == pytest.approx(way, abs=1e-9)
    assert velocity == pytest.approx(command + (start - command) * decay, abs=2e-9)


@given(speeds, speeds, st.floats(1e-4, 2.0), st.floats(1e-3, 0.2))
@PROPERTY
def test_pieces_of_the_way_are_nearly_straight(start, command, time_constant, duration):
    pieces, _ = follow(start, command, time_constant, duration)
    passed, at = 0.0, 0.0

    def place(time):
        gone = -math.expm1(-time / time_constant)
        return command * time + (start - command) * time_constant * gone

    for elapsed, mean in pieces:
        for share in (0.25, 0.5, 0.75):
            chord = at + share * elapsed * mean
            assert abs(place(passed + share * elapsed) - chord) <= 1.01 * FLAT
        passed, at = passed + elapsed, at + elapsed * mean


def test_time_constant_that_does_not_matter_needs_one_piece():
    pieces, velocity = follow(0.02, -0.02, 1e-6, 0.1)
    assert len(pieces) == 1
    assert velocity == -0.02


def test_finger_that_lags_comes_to_rest():
    velocity, time = 0.01, 0.0
    while velocity != 0.0:
        _, velocity = follow(velocity, 0.0, 0.1, 0.1)
        time += 0.1
        assert time < 2.0


def test_without_a_lag_the_command_is_followed_to_the_bit():
    assert lagged(0.3, 0.1, 0.0, 0.7) == (0.7, 0.1, 0.1)
    assert quantised(0.1, 0.0) == 0.1


@given(speeds, st.floats(1e-5, 1e-2))
@PROPERTY
def test_quantised_velocity_is_the_nearest_multiple(velocity, quantum):
    rounded = quantised(velocity, quantum)
    assert rounded / quantum == pytest.approx(round(rounded / quantum), abs=1e-9)
    assert abs(rounded - velocity) <= 0.5001 * quantum


def arriving(line, commands, period, delay):
    """Return what arrives while commands follow each other."""
    arrived = []
    for k, command in enumerate(commands):
        pieces = line.arriving(command, k * period, period, delay)
        assert sum(length for _, length in pieces) == pytest.approx(period)
        arrived += pieces
    return arrived


def at(pieces, time):
    """Return what the finger hears at a time."""
    for velocity, length in pieces:
        if time < length:
            return velocity
        time -= length
    return None


@given(
    st.lists(st.sampled_from([-1.0, 0.0, 0.5, 1.0]), min_size=5, max_size=12), st.floats(0.0, 0.45)
)
@PROPERTY
def test_commands_arrive_after_the_delay_and_the_finger_rests_before(commands, delay):
    pieces = arriving(DelayLine(0.0), commands, 0.1, delay)
    for i in range(10 * len(commands)):
        sent = (i + 0.5) / 100.0 - delay
        if abs(sent / 0.1 - round(sent / 0.1)) > 1e-6:  # not just at a change
            expected = commands[math.floor(sent / 0.1)] if sent > 0.0 else 0.0
            assert at(pieces, (i + 0.5) / 100.0) == expected


def test_undelayed_command_arrives_in_one_piece_to_the_bit():
    line = DelayLine(0.0)
    for k, command in enumerate([0.1, 0.1, -0.3, 0.0]):
        assert line.arriving(command, k * 0.1, 0.1, 0.0) == [(command, 0.1)]


def test_delay_line_changes_its_length_while_commands_are_under_way():
    line = DelayLine(0.0)
    assert line.arriving(1.0, 0.0, 0.1, 0.3) == [(0.0, 0.1)]
    assert line.arriving(2.0, 0.1, 0.1, 0.0) == [(2.0, 0.1)]  # what was under way is there at once
    assert line.arriving(3.0, 0.2, 0.1, 0.05) == [
        (2.0, pytest.approx(0.05)),
        (3.0, pytest.approx(0.05)),
    ]


@given(st.floats(-0.02, 0.02), st.lists(speeds, min_size=1, max_size=20))
@PROPERTY
def test_finger_never_leaves_its_workspace(start, velocities):
    workspace = Workspace(-0.02, 0.02)
    x = start
    for v_x in velocities:
        inside = workspace.time_inside(x, v_x, 1.0)
        assert 0.0 <= inside <= 1.0
        x += v_x * inside
        assert -0.02 - 1e-12 <= x <= 0.02 + 1e-12
        if inside < 1.0:
            assert abs(x) == pytest.approx(0.02)


def test_finger_beyond_its_workspace_may_only_come_back():
    workspace = Workspace(-0.02, 0.02)
    assert workspace.time_inside(0.03, 0.01, 1.0) == 0.0
    assert workspace.time_inside(0.03, -0.01, 0.5) == 0.5


@pytest.mark.parametrize(
    ('name', 'value'),
    list(
        itertools.product(
            ['time_constant', 'delay', 'velocity_quantum', 'lift_delay'], [-0.1, math.inf]
        )
    ),
)
def test_number_out_of_its_range_is_refused_by_name_and_value(name, value):
    with pytest.raises(ValueError, match=f'{name}: expected a finite number of 0 or more, got'):
        Servo(**{name: value})


@pytest.mark.parametrize('bounds', [(0.0, 0.0), (0.1, -0.1), (math.nan, 0.0)])
def test_workspace_without_a_place_is_refused(bounds):
    with pytest.raises(ValueError, match='workspace: expected a lower bound below'):
        Workspace(*bounds)
