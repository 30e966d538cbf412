# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
import math

import pytest

from tactile_push.doctor import MISSING, RIGHT, WRONG
from tactile_push.doctor.touches import (
    ABOVE,
    LEFT,
    NOTHING,
    RIGHT_OF_POLE,
    TOUCHES,
    touch_findings,
)
from tactile_push.interface import CAMERA_SENSOR, SENSOR_DRIVER, TACTILE, WRENCH_SENSOR

UNTOUCHED = (math.nan, math.nan)
# As docs/conventions.md has them, with fingers that miss by up to 15 degrees [degrees].
TRUE = {LEFT: (-10.0, 65.0), RIGHT_OF_POLE: (-175.0, 70.0), ABOVE: (100.0, 60.0)}


def wrapped(degrees):
    return math.remainder(degrees, 360.0)


def touches(change=lambda a, e: (a, e), unit=math.pi / 180.0):
    """Return the readings of a sensor that changes azimuth and elevation [degrees] so."""
    made = {NOTHING: [UNTOUCHED] * 3}
    for name, place in TRUE.items():
        azimuth, elevation = change(*place)
        made[name] = [(wrapped(azimuth) * unit, elevation * unit)] * 3
    return made


def judged(readings, sensor=SENSOR_DRIVER):
    return [
        (f.verdict, f.subject, f'{f.words}; {f.remedy}') for f in touch_findings(readings, sensor)
    ]


def test_right_signs_are_right():
    found = judged(touches())
    assert [(verdict, subject) for verdict, subject, _ in found] == [
        (RIGHT, TACTILE),
        (RIGHT, 'azimuth'),
        (RIGHT, 'elevation'),
    ]


@pytest.mark.parametrize(
    ('change', 'subject', 'words'),
    [
        (lambda a, e: (-a, e), 'azimuth', 'send the azimuth with the other sign'),
        (lambda a, e: (180.0 - a, e), 'azimuth', 'left and right are exchanged'),
        (lambda a, e: (180.0 - a, e), 'azimuth', 'send 180° less this azimuth'),
        (lambda a, e: (a, 90.0 - e), 'elevation', 'send 90° less this elevation'),
    ],
)
def test_swapped_sign_is_named_with_what_to_send(change, subject, words):
    (fault,) = [one for one in judged(touches(change)) if one[0] == WRONG]
    assert fault[1] == subject
    assert words in fault[2]


@pytest.mark.parametrize('offset', [90.0, -90.0, 150.0])
def test_offset_is_named_with_its_size(offset):
    readings = touches(lambda a, e: (a + offset, e))
    (fault,) = [one for one in judged(readings) if one[0] == WRONG]
    named = float(fault[2].partition('off by ')[2].partition('°')[0])
    # The touches themselves are off by -10, 5 and 10 degrees, by 2 in the mean.
    assert named == pytest.approx(offset + 2.0, abs=1.0)
    assert 'send this azimuth less' in fault[2]


def test_turned_mirror_is_undone_by_what_it_says():
    (fault,) = [one for one in judged(touches(lambda a, e: (70.0 - a, e))) if one[0] == WRONG]
    assert 'the wrong way round' in fault[2]
    named = float(fault[2].partition('send ')[2].partition('°')[0])
    assert named == pytest.approx(70.0, abs=5.0)


@pytest.mark.parametrize(
    ('sensor', 'words'),
    [
        (WRENCH_SENSOR, 'turn tip_rpy of wrench_sensor by 9'),
        (CAMERA_SENSOR, 'tactile_push calibrate camera'),
        ('own_sensor', 'let the sensor publish this azimuth less 9'),
    ],
)
def test_remedy_names_the_parameter_of_the_node(sensor, words):
    readings = touches(lambda a, e: (a + 90.0, e))
    assert any(words in fault for _, _, fault in judged(readings, sensor))


def test_degrees_are_no_radians():
    (fault,) = [one for one in judged(touches(unit=1.0)) if one[0] == WRONG]
    assert 'no radians' in fault[2]


def test_touch_that_is_not_felt_and_contact_of_nothing_are_named():
    readings = {**touches(), LEFT: [UNTOUCHED] * 3, NOTHING: [(0.0, 1.0)] * 3}
    found = judged(readings, WRENCH_SENSOR)
    assert [verdict for verdict, _, _ in found] == [WRONG, WRONG]
    assert 'wrench_sensor/tare' in found[0][2]
    assert 'at the touch left; touch harder, or lower contact_force' in found[1][2]


def test_silent_sensor_is_named():
    ((verdict, subject, words),) = judged({**touches(), ABOVE: []})
    assert (verdict, subject) == (MISSING, TACTILE)
    assert 'at the touch above' in words


def test_touches_that_fit_no_sensor_are_asked_for_again():
    readings = touches()
    readings[RIGHT_OF_POLE] = readings[LEFT]
    assert (WRONG, 'azimuth') in [(verdict, subject) for verdict, subject, _ in judged(readings)]
    readings = touches()
    readings[LEFT] = [(0.0, 0.3)] * 3
    (fault,) = [one for one in judged(readings) if one[0] == WRONG]
    assert 'not all touches were near the pole' in fault[2]


def test_azimuths_on_both_sides_of_the_cut_have_their_mean_there():
    readings = touches()
    readings[RIGHT_OF_POLE] = [(3.1, 1.2), (-3.1, 1.2)] * 3
    assert all(verdict == RIGHT for verdict, _, _ in judged(readings))


def test_every_touch_is_asked_for():
    assert set(TOUCHES) == {LEFT, RIGHT_OF_POLE, ABOVE, NOTHING}
