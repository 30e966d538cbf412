# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Touches that were asked for, kept and read again as those of any other bag."""

import math
from typing import NamedTuple

import numpy as np
import pytest

from support.bag_making import encode
from support.touches import unit, wrench
from tactile_push.bags import BagReader
from tactile_push.calibration.asking import Asking
from tactile_push.calibration.bag_wrenches import wrenches_in_bag
from tactile_push.calibration.coverage import suggested_touches
from tactile_push.calibration.kept_touches import KeptTouches
from tactile_push.calibration.wrench_sense import WrenchSense

WRENCH = 'geometry_msgs/msg/WrenchStamped'
PERIOD = 10_000_000  # [ns]
FREE = (np.zeros(3), np.zeros(3))
TIP = np.array([0.0, 0.001, 0.03])


class Message(NamedTuple):
    received: int
    sent: int
    data: bytes


class Person:
    """Touches the tip where it is asked to."""

    def __init__(self, folder):
        self.kept = KeptTouches(folder, '/ft', lambda bag: bag.add_topic('/ft', WRENCH))
        self.asking = Asking(WrenchSense(), self.kept, lambda line: None)
        self.now = 1_000_000_000

    def feel(self, parts, count):
        for _ in range(count):
            self.now += PERIOD
            force, torque = (dict(zip('xyz', part, strict=True)) for part in parts)
            data = encode(WRENCH, wrench={'force': force, 'torque': torque})
            message = Message(self.now, self.now - 1000, data)
            self.asking.message(1e-9 * self.now, [*parts[0], *parts[1]], message)

    def touch(self, parts):
        self.feel(parts, 70)
        self.asking.key('\n')
        self.feel(FREE, 1)

    def start(self):
        self.asking.key('\n')
        self.feel(FREE, 60)


def pressed(azimuth, elevation, number):
    return wrench(unit(azimuth, elevation), 2.0, (math.cos(number), math.sin(number)), 0.0, TIP)


def test_kept_touches_are_read_as_those_of_any_bag(tmp_path):
    person = Person(tmp_path / 'touches')
    person.start()
    felt = [pressed(*place, number) for number, place in enumerate(suggested_touches())]
    for parts in felt:
        person.touch(parts)
    assert person.asking.done
    person.kept.close()
    with BagReader(tmp_path / 'touches') as bag:
        found = wrenches_in_bag(bag, tmp_path / 'touches' / 'touches.csv')
    assert found.forces == pytest.approx(np.array([force for force, _ in felt]))
    assert found.moments == pytest.approx(np.array([moment for _, moment in felt]))
    places = np.array([touch[:2] for touch in found.touches])
    assert places == pytest.approx(np.array(suggested_touches()), abs=1e-6)


def test_bag_that_was_not_closed_has_its_touches(tmp_path):
    person = Person(tmp_path / 'touches')
    person.start()
    person.touch(pressed(0.0, 1.0, 0))
    person.kept._bag._disk.close()  # as when the process is killed
    said = []
    with BagReader(tmp_path / 'touches', said.append) as bag:
        found = wrenches_in_bag(bag, tmp_path / 'touches' / 'touches.csv')
    assert len(found.touches) == 1
    assert said != []


def test_nothing_kept_leaves_nothing(tmp_path):
    person = Person(tmp_path / 'touches')
    person.asking.key('q')
    person.kept.close()
    assert not (tmp_path / 'touches').exists()


def test_older_touches_are_not_overwritten(tmp_path):
    (tmp_path / 'touches').mkdir()
    with pytest.raises(FileExistsError):
        Person(tmp_path / 'touches').start()
