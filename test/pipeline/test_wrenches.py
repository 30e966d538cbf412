# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What becomes of each message of `wrench`."""

import math

import pytest

from support.touches import RADIUS, unit, wrench
from tactile_push.interface import TACTILE
from tactile_push.pipeline.stamps import seconds_since
from tactile_push.pipeline.wrenches import Wrenches
from tactile_push.tactile import WrenchReader, WrenchSensing

BEGIN = 1_795_000_000
CENTRE = (0.0, 0.0, 0.02)
PRESS = wrench(unit(0.5, 0.9), 1.5, (0.4, 0.0), 0.0, CENTRE)


@pytest.fixture
def step():
    sensing = WrenchSensing(RADIUS, CENTRE, (0.0, 0.0, 0.0), time_constant=0.02)
    reader = WrenchReader(sensing, needs_tare=False)
    return Wrenches(reader, lambda sec, nanosec: seconds_since(BEGIN, sec, nanosec))


def test_contact_becomes_angles_in_positions_and_forces_in_efforts(step):
    ((topic, fields),) = step.wrench((BEGIN, 7), 'sensor', *PRESS).outputs()
    assert topic == TACTILE
    assert fields['header'] == {'stamp': {'sec': BEGIN, 'nanosec': 7}, 'frame_id': ''}
    assert fields['name'] == ['azimuth', 'elevation', 'normal_force', 'tangential_force']
    nan = math.nan
    assert fields['position'] == pytest.approx([0.5, 0.9, nan, nan], nan_ok=True)
    assert fields['effort'] == pytest.approx([nan, nan, 1.5, 0.4], nan_ok=True)


def test_no_contact_is_all_nan(step):
    ((_, fields),) = step.wrench((BEGIN, 0), 'sensor', [0.0] * 3, [0.0] * 3).outputs()
    assert all(map(math.isnan, fields['position'] + fields['effort']))


def test_reading_is_stamped_with_the_mean_time_of_its_wrenches(step):
    step.wrench((BEGIN, 990_000_000), 'sensor', *PRESS)
    ((_, fields),) = step.wrench((BEGIN + 1, 0), 'sensor', *PRESS).outputs()
    # The first one, 10 ms ago, has the weight exp(-10/20).
    age = 0.01 * math.exp(-0.5)
    assert fields['header']['stamp']['sec'] == BEGIN
    assert fields['header']['stamp']['nanosec'] == pytest.approx(1e9 * (1.0 - age), abs=2)


def test_refused_wrench_gives_nothing(step):
    touched = step.wrench((BEGIN, 0), 'sensor', [math.nan] * 3, [0.0] * 3)
    assert (touched.refusal, list(touched.outputs())) == ('not finite', [])


def test_stamp_before_1970_is_refused(step):
    touched = step.wrench((-1, 0), 'sensor', *PRESS)
    assert (touched.refusal, list(touched.outputs())) == ('negative stamp', [])
