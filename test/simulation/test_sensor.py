# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tactile_push.simulation import Readout, Sensor
from tactile_push.tactile import NO_CONTACT, Reading, contact_of_reading, reading_of_contact

PROPERTY = settings(derandomize=True, deadline=None, max_examples=60)
POLE = math.pi / 2.0
angles = st.floats(-1.5, 1.5)


def at(angle):
    """Return the true reading of a contact at an angle from the pole to the left."""
    return reading_of_contact(angle, POLE)


def angle_of(reading):
    """Return the angle from the pole to the left, by the definition of azimuth and elevation."""
    left = math.cos(reading.elevation) * math.cos(reading.azimuth)
    return math.atan2(left, math.sin(reading.elevation))


def readings(sensor, angle=0.3, count=2000, seed=1, period=0.02):
    """Read many times; return what was sent."""
    readout = Readout(sensor, seed)
    samples = [s for k in range(count) for s in readout.read(at(angle), k * period)]
    return samples


def angles_sent(sensor, **settings):
    return np.array([angle_of(s.reading) for s in readings(sensor, **settings)])


def on_the_hemisphere(reading):
    return -math.pi <= reading.azimuth <= math.pi and 0.0 <= reading.elevation <= POLE


@given(angles)
@PROPERTY
def test_perfect_sensor_sends_the_truth_to_the_bit_at_once(angle):
    (sample,) = Readout(Sensor(), 0).read(at(angle), 1.0)
    assert sample.reading == at(angle)
    assert sample.likely


def test_no_contact_stays_no_contact_whatever_the_errors():
    readout = Readout(Sensor(noise=0.1, bias=0.1, quantum=0.1), 0)
    (sample,) = readout.read(NO_CONTACT, 0.0)
    assert sample.reading == NO_CONTACT
    assert not sample.likely


@pytest.mark.parametrize('angle', [0.0, 0.3, -0.7])
def test_noise_has_its_deviation_and_no_mean_even_across_the_pole(angle):
    sent = angles_sent(Sensor(noise=0.02), angle=angle)
    assert sent.std() == pytest.approx(0.02, rel=0.06)
    assert sent.mean() == pytest.approx(angle, abs=4.0 * 0.02 / math.sqrt(2000))


@given(st.floats(-POLE, POLE), st.floats(0.0, 1.0), st.floats(-1.0, 1.0), st.floats(0.0, 1.0))
@PROPERTY
def test_reading_stays_one_of_the_upright_hemisphere(angle, noise, bias, quantum):
    sensor = Sensor(noise=noise, bias=bias, quantum=quantum)
    for sample in readings(sensor, angle, count=20):
        assert on_the_hemisphere(sample.reading)
        contact_of_reading(sample.reading, POLE, 0.0135, 1e-9)


@pytest.mark.parametrize(('angle', 'bias'), [(0.1, -0.25), (-0.1, 0.25), (0.4, 0.3)])
def test_bias_is_added_across_the_pole_too(angle, bias):
    sent = angles_sent(Sensor(bias=bias), angle=angle, count=5)
    assert sent == pytest.approx([angle + bias] * 5, abs=1e-12)


@given(angles, st.floats(0.001, 0.2))
@PROPERTY
def test_quantised_angle_is_the_nearest_multiple(angle, quantum):
    (sent,) = angles_sent(Sensor(quantum=quantum), angle=angle, count=1)
    off_by = abs(sent - angle)
    assert off_by <= 0.5 * quantum + 1e-9
    if abs(sent) < POLE - 1e-9:  # at the equator it goes no further
        assert sent / quantum == pytest.approx(round(sent / quantum), abs=1e-6)


def test_latency_delays_every_reading_and_keeps_the_order():
    readout = Readout(Sensor(latency=0.05), 0)
    out = {}
    for k in range(20):
        for sample in readout.read(at(0.01 * k), 0.02 * k):
            out[round(angle_of(sample.reading) / 0.01)] = 0.02 * k
    assert list(out) == list(range(17))
    # At the first reading that is not before 0.05 s later.
    assert all(time == pytest.approx(0.02 * k + 0.06) for k, time in out.items())


def test_latency_of_whole_periods_is_not_one_more_by_rounding():
    for periods in range(1, 8):
        readout = Readout(Sensor(latency=periods * 0.02), 0)
        waiting = next(k for k in range(20) if readout.read(at(0.1), k * 0.02))
        assert waiting == periods


def test_latency_may_change_while_readings_are_under_way():
    readout = Readout(Sensor(latency=1.0), 0)
    for k in range(5):
        assert readout.read(at(0.1), k * 0.02) == []
    readout.sensor = Sensor()
    assert len(readout.read(at(0.1), 0.1)) == 6


@pytest.mark.parametrize('probability', [0.01, 0.5])
def test_dropouts_come_as_often_as_asked(probability):
    lost = sum(s.reading is None for s in readings(Sensor(dropout=probability), count=5000))
    deviation = math.sqrt(5000 * probability * (1.0 - probability))
    assert abs(lost - 5000 * probability) < 4.0 * deviation


def test_outliers_come_as_often_as_asked_and_fill_the_hemisphere_evenly():
    samples = readings(Sensor(outlier=0.5), count=8000)
    wrong = [s for s in samples if s.reading != at(0.3)]
    assert abs(len(wrong) - 4000) < 4.0 * math.sqrt(2000)
    assert not any(s.likely for s in wrong)
    assert all(s.likely for s in samples if s.reading == at(0.3))
    # Evenly over a half sphere each component squared is 1/3 on average, and the height 1/2.
    directions = np.array(
        [
            (
                math.cos(s.reading.elevation) * math.cos(s.reading.azimuth),
                math.cos(s.reading.elevation) * math.sin(s.reading.azimuth),
                math.sin(s.reading.elevation),
            )
            for s in wrong
        ]
    )
    assert (directions**2).mean(axis=0) == pytest.approx([1 / 3] * 3, abs=0.02)
    assert directions.mean(axis=0) == pytest.approx([0.0, 0.0, 0.5], abs=0.04)


def test_stuck_sensor_sends_its_last_value_until_it_is_free():
    readout = Readout(Sensor(), 0)
    readout.read(at(0.1), 0.0)
    readout.sensor = Sensor(stuck=True, noise=0.1)
    for k in range(1, 5):
        (sample,) = readout.read(at(0.1 + 0.1 * k), 0.02 * k)
        assert sample.reading == at(0.1)
    (sample,) = readout.read(NO_CONTACT, 0.1)
    assert sample.reading == at(0.1)
    readout.sensor = Sensor()
    (sample,) = readout.read(at(0.7), 0.12)
    assert sample.reading == at(0.7)


def test_beyond_the_detectable_range_there_is_no_contact():
    sensor = Sensor(detectable_range=0.5)
    for angle in (0.49, -0.49):
        assert readings(sensor, angle, count=1)[0].reading == at(angle)
    for angle in (0.51, -0.51):
        assert readings(sensor, angle, count=1)[0].reading == NO_CONTACT


def test_large_noise_is_not_likely():
    samples = readings(Sensor(noise=0.05))
    for sample in samples:
        error = abs(angle_of(sample.reading) - 0.3)
        assert sample.likely == (error <= math.radians(3.0))


CHANCES = {'noise': 0.01, 'dropout': 0.2, 'outlier': 0.2}


def test_same_seed_gives_the_same_readings_to_the_bit_and_another_seed_does_not():
    sensor = Sensor(**CHANCES)
    assert readings(sensor, seed=3) == readings(sensor, seed=3)
    assert readings(sensor, seed=3) != readings(sensor, seed=4)


def test_switching_one_error_on_does_not_change_the_others():
    noisy = readings(Sensor(noise=0.01))
    lossy = readings(Sensor(dropout=0.2))
    wrong = readings(Sensor(outlier=0.2))
    for k, sample in enumerate(readings(Sensor(**CHANCES))):
        assert (sample.reading is None) == (lossy[k].reading is None)
        if sample.reading is not None:
            is_wrong = wrong[k].reading != at(0.3)
            assert sample.reading == (wrong if is_wrong else noisy)[k].reading


@pytest.mark.parametrize(
    ('name', 'value'),
    [
        ('noise', -0.1),
        ('noise', math.nan),
        ('bias', math.inf),
        ('quantum', -1.0),
        ('latency', -0.1),
        ('latency', math.inf),
        ('dropout', 1.1),
        ('outlier', -0.1),
        ('outlier', math.nan),
        ('detectable_range', -0.1),
    ],
)
def test_number_out_of_its_range_is_refused_by_name(name, value):
    with pytest.raises(ValueError, match=f'{name}: expected'):
        Sensor(**{name: value})


def test_force_is_kept():
    sensor = Sensor(bias=0.1)
    (sample,) = Readout(sensor, 0).read(Reading(0.0, 1.0, 2.5), 0.0)
    assert sample.reading.normal_force == 2.5
