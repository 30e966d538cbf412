# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import replace

import pytest

from support.finger_seen import ANGLES, LOOP, WELL, changed, ends, faults
from tactile_push.doctor import WRONG, Heard
from tactile_push.interface import (
    ACTIVE_SENSING,
    CLOCK,
    CONTACT,
    CONTACT_GEOMETRY,
    JOINT_STATES,
    PUSH_CONTROLLER,
    SENSOR_DRIVER,
    TACTILE,
)


@pytest.mark.parametrize(
    ('seen', 'verdict', 'subject', 'words'),
    [
        (
            changed(heard={TACTILE: Heard(150, 3.0, ages=(0.001,), values=({'a': 1.0},))}),
            *(WRONG, TACTILE, 'lacks azimuth, elevation'),
        ),
        (
            changed(heard={TACTILE: Heard(30, 3.0, values=ANGLES)}),
            *(WRONG, TACTILE, '10.0 messages a second, expected 20'),
        ),
        (
            changed(heard={TACTILE: Heard(150, 3.0, ages=(2.5, 2.5, 2.6), values=ANGLES)}),
            *(WRONG, TACTILE, 'stamps are 2.50 s old'),
        ),
        (
            changed(heard={TACTILE: Heard(150, 3.0, ages=(-2.5,), values=ANGLES)}),
            *(WRONG, TACTILE, 'stamps are 2.50 s ahead of the clock'),
        ),
        (
            changed(heard={CONTACT: Heard(150, 3.0, frames=frozenset({'map'}))}),
            *(WRONG, CONTACT, 'names map'),
        ),
        (
            changed(
                heard={
                    JOINT_STATES: Heard(
                        150, 3.0, ages=(0.001,), values=({'distal_joint': 0.0, 'j1': 0.0},)
                    )
                },
                parameters={CONTACT_GEOMETRY: None},
            ),
            *(WRONG, PUSH_CONTROLLER, 'joint_states lacks proximal_joint'),
        ),
        (
            changed(parameters={CONTACT_GEOMETRY: {'finger_radius': 0.02}}),
            *(WRONG, 'finger_radius', 'contact_geometry has 0.02, push_controller has 0.0135'),
        ),
        (
            changed(health={SENSOR_DRIVER: (2, 'device is gone')}),
            *(WRONG, SENSOR_DRIVER, 'reports: device is gone'),
        ),
    ],
)
def test_what_is_wrong_is_named_with_what_to_do(seen, verdict, subject, words):
    (fault,) = faults(seen)
    assert (fault.verdict, fault.subject) == (verdict, subject)
    assert fault.words.startswith(words)
    assert fault.remedy


SIMULATED = changed(
    parameters={node: {**WELL.parameters[node], 'use_sim_time': True} for node in LOOP},
)
CLOCKED = {CLOCK: ends(CLOCK, 'sim_plant')}


@pytest.mark.parametrize(
    ('seen', 'words'),
    [
        (SIMULATED, 'waits for simulated time, which nobody publishes'),
        (changed(publishers=CLOCKED), 'time is simulated, and sensor_driver, contact_geometry'),
        (changed(SIMULATED, publishers={CLOCK: CLOCKED[CLOCK] * 2}), '2 nodes publish it'),
        (
            changed(
                SIMULATED,
                publishers=CLOCKED,
                heard={topic: replace(heard, seconds=0.0) for topic, heard in WELL.heard.items()},
            ),
            'the simulated time stands',
        ),
    ],
)
def test_time_is_the_same_for_all(seen, words):
    (fault,) = faults(seen)
    assert fault.subject == CLOCK
    assert words in fault.words
    assert faults(changed(SIMULATED, publishers=CLOCKED)) == []


WAITING = {PUSH_CONTROLLER: (1, 'waiting for contact')}


def test_controller_waits_while_nothing_touches_the_tip():
    nothing = ({'azimuth': math.nan, 'elevation': math.nan},)
    untouched = changed(
        heard={TACTILE: replace(WELL.heard[TACTILE], values=nothing)}, health=WAITING
    )
    assert faults(untouched) == []
    (fault,) = faults(changed(health=WAITING))  # though the tip is touched
    assert (fault.subject, fault.words) == (PUSH_CONTROLLER, 'reports: waiting for contact')


@pytest.mark.parametrize('law', ['push', 'place'])
def test_the_finger_s_lag_has_to_be_the_same_for_a_law_that_plans_with_it(law):
    controller = {**WELL.parameters[PUSH_CONTROLLER], 'law': law, 'finger_lag': 0.0}
    seen = changed(parameters={PUSH_CONTROLLER: controller, ACTIVE_SENSING: {'finger_lag': 0.1}})
    wrong = [fault.subject for fault in faults(seen)]
    assert ('finger_lag' in wrong) == (law == 'place')
