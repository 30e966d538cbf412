# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Tare, filter and contact of a tip on a force/torque sensor, and the wrenches that it refuses."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from support.touches import RADIUS, unit, wrench
from tactile_push.tactile import (
    WRENCH_REFUSALS,
    NotUntouchedError,
    ReadingRejectedError,
    WrenchReader,
    WrenchSensing,
)

CENTRE = np.array([0.0, 0.0, 0.02])
PLAIN = WrenchSensing(RADIUS, tuple(CENTRE), (0.0, 0.0, 0.0), time_constant=0.0)
PERIOD = 0.01
NOTHING = np.zeros(3), np.zeros(3)
OFFSET = np.array([0.7, -1.1, 2.5]), np.array([0.01, 0.02, -0.03])


class Sensor:
    """A sensor with an offset, and the reader that hears it each 10 ms."""

    def __init__(self, sensing=PLAIN, offset=NOTHING, needs_tare=False):
        self.reader = WrenchReader(sensing, needs_tare)
        self.offset = offset
        self.time = 100.0

    def send(self, force, moment=(0.0, 0.0, 0.0), after=PERIOD, frame='sensor'):
        self.time += after
        return self.reader.touch(
            self.time, frame, np.add(force, self.offset[0]), np.add(moment, self.offset[1])
        )

    def press(self, azimuth=0.0, elevation=1.2, pressing=1.0, **how):
        return self.send(
            *wrench(unit(azimuth, elevation), pressing, (0.0, 0.0), 0.0, CENTRE), **how
        )

    def refusal(self, *args, **how):
        with pytest.raises(ReadingRejectedError) as refused:
            self.send(*args, **how)
        assert str(refused.value) in WRENCH_REFUSALS
        return str(refused.value)

    def hang_free(self, seconds=0.6):
        """Let the tip touch nothing for a while."""
        for _ in range(round(seconds / PERIOD)):
            try:
                self.send([0.0, 0.0, 0.0])
            except ReadingRejectedError as reason:
                assert str(reason) == 'not tared'


def test_contact_and_its_forces_are_read():
    sensor = Sensor()
    force, moment = wrench(unit(-2.0, 0.7), 1.5, (0.3, 0.4), 0.001, CENTRE)
    touch = sensor.send(force, moment)
    assert touch.reading.azimuth == pytest.approx(-2.0)
    assert touch.reading.elevation == pytest.approx(0.7)
    assert touch.reading.normal_force == pytest.approx(1.5)
    assert touch.tangential_force == pytest.approx(0.5)
    assert touch.torsion == pytest.approx(0.001)
    assert touch.age == 0.0


def turned(rpy):
    """Return the rotation by roll about x, then pitch about y, then yaw about z."""
    (cr, cp, cy), (sr, sp, sy) = np.cos(rpy), np.sin(rpy)
    about_x = np.array([[1, 0, 0], [0, cr, -sr], [0, sr, cr]])
    about_y = np.array([[cp, 0, sp], [0, 1, 0], [-sp, 0, cp]])
    about_z = np.array([[cy, -sy, 0], [sy, cy, 0], [0, 0, 1]])
    return about_z @ about_y @ about_x


@pytest.mark.parametrize('reaction', [False, True])
@given(*[st.floats(-3.0, 3.0)] * 3, st.tuples(*[st.floats(-0.05, 0.05)] * 3))
@settings(derandomize=True, deadline=None, max_examples=30)
def test_tip_may_sit_anyhow_on_the_sensor(reaction, roll, pitch, yaw, xyz):
    rpy = (roll, pitch, yaw)
    axes = turned(rpy)
    at_tip, about_centre = wrench(unit(0.4, 0.9), 2.0, (0.5, -0.2), 0.001, np.zeros(3))
    force = axes @ at_tip
    moment = axes @ about_centre + np.cross(xyz, force)
    sign = -1.0 if reaction else 1.0
    sensor = Sensor(replace(PLAIN, xyz=xyz, rpy=rpy, reaction=reaction))
    touch = sensor.send(sign * force, sign * moment)
    assert touch.reading.azimuth == pytest.approx(0.4, abs=1e-6)
    assert touch.reading.elevation == pytest.approx(0.9, abs=1e-6)
    assert touch.torsion == pytest.approx(0.001, abs=1e-8)


def test_contact_begins_and_ends_at_two_forces():
    sensor = Sensor(replace(PLAIN, contact_force=0.2, release_force=0.1))
    forces = [0.05, 0.15, 0.19, 0.21, 0.15, 0.11, 0.09, 0.15, 0.21]
    touches = [sensor.press(pressing=force).reading.in_contact for force in forces]
    assert touches == [False, False, False, True, True, True, False, False, True]


def test_tare_takes_away_what_the_sensor_says_without_a_contact():
    sensor = Sensor(offset=OFFSET, needs_tare=True)
    assert sensor.refusal([0.0, 0.0, 0.0]) == 'not tared'
    sensor.hang_free()
    sensor.reader.tare()
    assert not sensor.send([0.0, 0.0, 0.0]).reading.in_contact
    touch = sensor.press(0.3, 0.8)
    assert touch.reading.azimuth == pytest.approx(0.3)
    assert touch.reading.elevation == pytest.approx(0.8)


def test_tare_is_the_mean_of_its_time():
    rng = np.random.default_rng(1)
    sensor = Sensor(replace(PLAIN, tare_time=1.005), needs_tare=True)
    noises = 0.02 * rng.standard_normal((101, 3))  # of 1 s
    for noise in [[9.0, 0.0, 0.0]] * 5 + list(noises):
        assert sensor.refusal(noise) == 'not tared'
    sensor.reader.tare()
    left = -np.mean(noises, axis=0)
    sensor.send([0.0, 0.0, 0.0])
    assert sensor.reader.force == pytest.approx(math.hypot(*left))


def test_tare_is_refused_in_contact_and_the_old_one_stays():
    sensor = Sensor(offset=OFFSET, needs_tare=True)
    sensor.hang_free()
    sensor.reader.tare()
    for _ in range(60):
        sensor.press(pressing=1.3)
    with pytest.raises(NotUntouchedError, match='in contact with 1.30 N; lift the finger'):
        sensor.reader.tare()
    assert sensor.press(pressing=1.3).reading.normal_force == pytest.approx(1.3)


def test_tare_needs_wrenches():
    sensor = Sensor(needs_tare=True)
    for _ in range(9):
        sensor.refusal([0.0, 0.0, 0.0])
    with pytest.raises(NotUntouchedError, match=r'expected 10 wrenches within 0.5 s, got 9'):
        sensor.reader.tare()
    assert not sensor.reader.tared


def test_tare_needs_a_finger_that_is_still():
    sensor = Sensor(needs_tare=True)
    for k in range(50):
        sensor.refusal([0.3 * (k % 2), 0.0, 0.0])  # a standard deviation of 0.15 N
    with pytest.raises(NotUntouchedError, match=r'the force varies by 0.15 N'):
        sensor.reader.tare()


def test_tare_of_two_sensors_is_refused():
    sensor = Sensor(needs_tare=True)
    for k in range(50):
        sensor.refusal([0.0, 0.0, 0.0], frame=f'sensor{k % 2}')
    with pytest.raises(NotUntouchedError, match='in one frame'):
        sensor.reader.tare()


def test_drift_is_what_the_tare_leaves_in_the_air():
    sensor = Sensor(needs_tare=True)
    sensor.hang_free()
    sensor.reader.tare()
    sensor.hang_free(0.3)
    assert math.isnan(sensor.reader.drift)  # not long enough to tell
    sensor.hang_free(0.3)
    assert sensor.reader.drift == pytest.approx(0.0, abs=1e-12)
    sensor.offset = np.array([0.03, 0.0, 0.04]), np.zeros(3)
    sensor.hang_free()
    assert sensor.reader.drift == pytest.approx(0.05)
    sensor.press()
    assert math.isnan(sensor.reader.drift)
    sensor.hang_free(0.3)
    assert math.isnan(sensor.reader.drift)
    sensor.hang_free(0.3)
    assert sensor.reader.drift == pytest.approx(0.05)


def test_filter_is_a_lag_whose_age_the_reading_has():
    tau, rate = 0.05, 0.2  # time constant [s], and how fast the contact climbs [rad/s]
    sensor = Sensor(replace(PLAIN, time_constant=tau))
    for k in range(200):
        touch = sensor.press(elevation=0.5 + rate * k * PERIOD)
        climbed = 0.5 + rate * (k * PERIOD - touch.age)
        # The mean of directions within 0.01 rad misses their mean angle by its square.
        assert touch.reading.elevation == pytest.approx(climbed, abs=(rate * tau) ** 2)
        assert k > 0 or touch.age == 0.0
    # A lag of first order in steps is behind a ramp by the mean of its weights.
    share = math.exp(-PERIOD / tau)
    assert touch.age == pytest.approx(PERIOD * share / (1.0 - share), rel=1e-6)


def test_filter_makes_the_noise_smaller():
    deviations = {}
    for tau in (0.0, 0.05):
        rng, sensor = np.random.default_rng(2), Sensor(replace(PLAIN, time_constant=tau))
        force, moment = wrench(unit(0.0, 1.0), 1.0, (0.0, 0.0), 0.0, CENTRE)
        readings = [
            sensor.send(force + 0.02 * rng.standard_normal(3), moment).reading.elevation
            for _ in range(1000)
        ]
        deviations[tau] = np.std(readings[100:])
    # White noise through the weights a (1 - a)^k has the variance a / (2 - a).
    a = 1.0 - math.exp(-PERIOD / 0.05)
    ratio = deviations[0.05] / deviations[0.0]
    assert ratio == pytest.approx(math.sqrt(a / (2.0 - a)), rel=0.15)


def test_readings_come_no_more_often_than_asked_for():
    sensor = Sensor(replace(PLAIN, max_rate=100.0))
    told = [sensor.press(after=0.001) is not None for _ in range(1000)]
    assert 99 <= sum(told) <= 102


def test_contact_that_ends_between_readings_is_noticed():
    sensor = Sensor(replace(PLAIN, max_rate=10.0))
    for _ in range(21):
        sensor.press()
    assert sensor.press(pressing=0.05) is None
    for _ in range(9):
        touch = sensor.press(pressing=0.15)
    assert not touch.reading.in_contact  # 0.15 N keep a contact, but make none


@pytest.mark.parametrize(
    ('force', 'how', 'refusal'),
    [
        ([math.nan, 0.0, 0.0], {}, 'not finite'),
        ([0.0, 0.0, math.inf], {}, 'not finite'),
        ([0.0, 0.0, -20.0], {}, 'saturated'),
        ([1e300, 0.0, 0.0], {}, 'saturated'),
        ([0.0, 0.0, 0.0], {'moment': [0.0, 0.3, 0.0]}, 'saturated'),
        ([0.0, 0.0, -1.0], {'frame': 'wrist'}, 'another frame'),
        ([0.0, 0.0, -1.0], {'after': 0.0}, 'not newer'),
        ([0.0, 0.0, -1.0], {'after': -0.02}, 'not newer'),
        ([0.0, 0.0, -1.0], {'after': 0.1}, 'too long after the one before'),
        ([0.0, 0.0, 1.0], {}, 'contact behind the tip'),
        ([0.0, 0.0, -1.0], {'moment': [0.0, 0.1, 0.0]}, 'torsion'),
    ],
)
def test_wrench_that_tells_nothing_is_refused_and_the_next_one_counts(force, how, refusal):
    sensor = Sensor(replace(PLAIN, force_range=20.0, moment_range=0.3))
    sensor.press()
    time = sensor.time
    assert sensor.refusal(force, **how) == refusal
    sensor.time = max(sensor.time, time)
    assert sensor.press(0.5, 1.0).reading.azimuth == pytest.approx(0.5)


def test_sensor_other_than_the_calibrated_one_is_refused_even_before_a_tare():
    sensor = Sensor(replace(PLAIN, frame='sensor'), needs_tare=True)
    assert sensor.refusal([0.0, 0.0, 0.0], frame='wrist') == 'another frame'
    assert sensor.refusal([0.0, 0.0, 0.0]) == 'not tared'


def test_slow_sensor_is_refused_altogether():
    sensor = Sensor()
    sensor.press()
    for _ in range(20):
        assert sensor.refusal([0.0, 0.0, -1.0], after=0.1) == 'too long after the one before'
    assert sensor.reader.gap == pytest.approx(0.1)


def test_clock_that_is_set_back_costs_nothing_but_the_past():
    sensor = Sensor(replace(PLAIN, time_constant=0.1))
    sensor.press(0.2, 1.0)
    touch = sensor.press(0.5, 1.0, after=-50.0)
    assert touch.reading.azimuth == pytest.approx(0.5)  # nothing of the one before is in it
    assert touch.age == 0.0


def test_restart_keeps_the_tare_alone():
    sensor = Sensor(offset=OFFSET, needs_tare=True)
    sensor.hang_free()
    sensor.reader.tare()
    sensor.press()
    sensor.reader.restart()
    assert sensor.reader.tared
    assert math.isnan(sensor.reader.force)
    assert not sensor.press(pressing=0.15).reading.in_contact  # what kept the contact is forgotten


numbers = st.one_of(st.floats(-30.0, 30.0), st.floats(allow_nan=True, allow_infinity=True))


@given(
    st.lists(
        st.tuples(st.tuples(*[numbers] * 6), st.sampled_from([0.01, 0.01, 0.0, -1.0, 0.2])),
        max_size=30,
    ),
    st.booleans(),
)
@settings(derandomize=True, deadline=None, max_examples=60)
def test_whatever_comes_a_reading_is_on_the_hemisphere_or_none(wrenches, needs_tare):
    sensor = Sensor(replace(PLAIN, time_constant=0.02), needs_tare=needs_tare)
    for numbers_sent, after in wrenches:
        sensor.time += after
        try:
            touch = sensor.reader.touch(sensor.time, 'sensor', numbers_sent[:3], numbers_sent[3:])
        except ReadingRejectedError as reason:
            assert str(reason) in WRENCH_REFUSALS
            continue
        assert not needs_tare
        if touch is not None and touch.reading.in_contact:
            assert -math.pi <= touch.reading.azimuth <= math.pi
            assert 0.0 <= touch.reading.elevation <= math.pi / 2.0
            assert touch.reading.normal_force >= 0.0
            assert abs(touch.torsion) <= PLAIN.max_torsion


@pytest.mark.parametrize(
    ('what', 'words'),
    [
        ({'radius': 0.0}, 'radius: expected a positive finite number'),
        ({'xyz': (0.0, 0.0)}, 'xyz: expected three finite numbers'),
        ({'rpy': (0.0, 0.0, math.nan)}, 'rpy: expected three finite numbers'),
        ({'max_gap': math.inf}, 'max_gap: expected a positive finite number'),
        ({'time_constant': -0.1}, 'time_constant: expected 0 or more'),
        ({'force_range': 0.0}, 'force_range: expected more than 0'),
        ({'release_force': 0.3}, r'release_force: expected a positive force up to contact_force'),
        ({'release_force': 0.0}, r'release_force: expected a positive force up to contact_force'),
    ],
)
def test_sensor_that_cannot_be_is_refused(what, words):
    with pytest.raises(ValueError, match=words):
        replace(PLAIN, **what)
