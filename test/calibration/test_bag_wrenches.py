# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import math

import numpy as np
import pytest

from support.bag_making import encode, write_bag
from tactile_push.bags import BagReader
from tactile_push.calibration.bag_wrenches import wrenches_in_bag

WRENCH = 'geometry_msgs/msg/WrenchStamped'
OFFSET = np.array([0.5, -0.4, 3.0, 0.01, 0.02, -0.03])
TOUCHES = [np.array([0.0, 0.5, -2.0, 0.01, 0.0, 0.0]), np.array([1.0, 0.0, -1.0, 0.0, 0.02, 0.0])]
PERIOD = 10_000_000  # [ns]


def course(*touches, untouched=60):
    """Return wrenches: of the untouched tip, then of touches that swell and ebb away."""
    ramp = np.concatenate([np.linspace(0.0, 1.0, 10), np.ones(20), np.linspace(1.0, 0.0, 10)])
    parts = [np.zeros((untouched, 6))]
    for touch in touches:
        parts += [ramp[:, None] * touch, np.zeros((10, 6))]
    return np.concatenate(parts) + OFFSET


def message(values):
    force, torque = (dict(zip('xyz', part, strict=True)) for part in (values[:3], values[3:]))
    return encode(WRENCH, wrench={'force': force, 'torque': torque})


def bag(folder, wrenches):
    messages = [(1 + k * PERIOD, message(values)) for k, values in enumerate(wrenches.tolist())]
    return write_bag(folder / 'bag', {'/wrench': (WRENCH, messages)})


@pytest.fixture
def table(tmp_path):
    file = tmp_path / 'touches.csv'
    file.write_text('azimuth_deg,elevation_deg\n0,90\n90,45\n')
    return file


def read(path, table):
    with BagReader(path) as reader:
        return wrenches_in_bag(reader, table)


def test_each_touch_is_the_mean_of_its_strong_half_without_the_offset(tmp_path, table):
    found = read(bag(tmp_path, course(*TOUCHES)), table)
    # Of ten steps up and ten down, five each press by half of the force or more: 5/9 to 9/9.
    share = (20.0 + 2.0 * sum(k / 9.0 for k in range(5, 10))) / 30.0
    expected = share * np.array(TOUCHES)
    assert found.forces == pytest.approx(expected[:, :3])
    assert found.moments == pytest.approx(expected[:, 3:])
    assert [touch.azimuth for touch in found.touches] == pytest.approx([0.0, math.pi / 2.0])


def test_touch_at_the_end_counts(tmp_path, table):
    assert len(read(bag(tmp_path, course(*TOUCHES)[:-25]), table).forces) == 2


def test_knock_is_no_touch(tmp_path, table):
    wrenches = course(*TOUCHES)
    wrenches[-6:-3, 2] -= 5.0
    assert len(read(bag(tmp_path, wrenches), table).forces) == 2


@pytest.mark.parametrize(
    ('wrenches', 'words'),
    [
        (course(TOUCHES[0]), 'touches.csv: expected 1 touches as in the bag, got 2'),
        (course()[:5], 'expected 10 wrenches of the untouched tip in the first 0.5 s, got 5'),
        (course()[:0], 'expected 10 wrenches of the untouched tip in the first 0.5 s, got 0'),
        (np.where(course() == 3.0, math.nan, course()), '/wrench: a wrench is not finite'),
    ],
)
def test_bag_that_does_not_fit_is_refused(tmp_path, table, wrenches, words):
    path = bag(tmp_path, wrenches)
    with pytest.raises(ValueError, match=words):
        read(path, table)


def test_bag_without_wrenches_is_refused(tmp_path, table):
    with pytest.raises(ValueError, match='^expected one topic of wrenches, got none$'):
        read(write_bag(tmp_path / 'bag', {}), table)
