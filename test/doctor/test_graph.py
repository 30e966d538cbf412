# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
from dataclasses import replace

import pytest

from support.finger_seen import JOINTS, LOOP, WELL, changed, ends, faults
from tactile_push.doctor import MISSING, WRONG
from tactile_push.interface import (
    COMMAND,
    CONTACT_GEOMETRY,
    FINGER_SERVO,
    JOINT_STATES,
    LIVE_PAGE,
    PLACE_GOAL,
    PUSH_CONTROLLER,
    SENSING_STATE,
    SENSOR_DRIVER,
    SERVO_COMMANDS,
    SIM_PLANT,
    TACTILE,
    WRENCH_SENSOR,
)

WITHOUT = replace(WELL, nodes=(SENSOR_DRIVER, CONTACT_GEOMETRY))
TWICE = replace(WELL, nodes=(*LOOP, PUSH_CONTROLLER))
WITHOUT_WORD = {key: {SENSOR_DRIVER: None} for key in ('states', 'parameters', 'health')}
SENSORLESS = changed(
    replace(WELL, nodes=LOOP[1:]),
    publishers={TACTILE: None},
    **WITHOUT_WORD,
)
HUNG = changed(**WITHOUT_WORD)
SERVOED = changed(
    replace(WELL, nodes=(*LOOP, FINGER_SERVO)),
    states={FINGER_SERVO: 'active'},
    parameters={FINGER_SERVO: {'use_sim_time': False, 'joint_names': JOINTS}},
    health={FINGER_SERVO: (0, 'following')},
    publishers={SERVO_COMMANDS: ends(SERVO_COMMANDS, FINGER_SERVO)},
    subscriptions={
        COMMAND: ends(COMMAND, PUSH_CONTROLLER, FINGER_SERVO),
        SERVO_COMMANDS: ends(SERVO_COMMANDS, FINGER_SERVO, 'velocity_controller'),
    },
)


@pytest.mark.parametrize(
    ('seen', 'verdict', 'subject', 'words'),
    [
        (WITHOUT, MISSING, PUSH_CONTROLLER, 'does not run, or hangs'),
        (TWICE, WRONG, PUSH_CONTROLLER, '2 nodes have this name'),
        (
            changed(states={SENSOR_DRIVER: 'inactive'}),
            *(WRONG, SENSOR_DRIVER, 'is inactive'),
        ),
        (HUNG, WRONG, SENSOR_DRIVER, 'reports nothing and answers nothing'),
        (SENSORLESS, MISSING, TACTILE, 'nobody publishes what contact_geometry needs'),
        (
            changed(subscriptions={COMMAND: ends(COMMAND, PUSH_CONTROLLER, LIVE_PAGE)}),
            *(MISSING, COMMAND, 'nobody takes it and moves the finger'),
        ),
        (
            changed(SERVOED, subscriptions={SERVO_COMMANDS: ends(SERVO_COMMANDS, FINGER_SERVO)}),
            *(MISSING, SERVO_COMMANDS, 'nobody takes it and moves the finger'),
        ),
        (
            changed(publishers={TACTILE: ends(TACTILE, SENSOR_DRIVER, WRENCH_SENSOR)}),
            *(WRONG, TACTILE, '2 publishers: sensor_driver, wrench_sensor'),
        ),
        (
            changed(publishers={JOINT_STATES: None}),
            *(
                MISSING,
                JOINT_STATES,
                'nobody publishes what contact_geometry, push_controller needs',
            ),
        ),
        (
            changed(publishers={TACTILE: ends(TACTILE, 'own', type_name='std_msgs/msg/String')}),
            *(WRONG, TACTILE, 'own publishes std_msgs/msg/String'),
        ),
        (
            changed(
                publishers={TACTILE: ends(TACTILE, 'own', reliable=False)},
                subscriptions={TACTILE: ends(TACTILE, 'logger')},
            ),
            *(WRONG, TACTILE, 'logger hears nothing of own: it asks for reliable messages'),
        ),
        (
            changed(publishers={COMMAND: ends(COMMAND, PUSH_CONTROLLER, 'joystick')}),
            *(WRONG, COMMAND, '2 publishers: push_controller, joystick'),
        ),
    ],
)
def test_what_is_wrong_is_named_with_what_to_do(seen, verdict, subject, words):
    (fault,) = faults(seen)
    assert (fault.verdict, fault.subject) == (verdict, subject)
    assert fault.words.startswith(words)
    assert fault.remedy


def test_finger_without_joint_angles_needs_no_joint_states():
    alone = {
        node: {**WELL.parameters[node], 'use_joint_states': False}
        for node in (CONTACT_GEOMETRY, PUSH_CONTROLLER)
    }
    assert (
        faults(
            changed(
                publishers={JOINT_STATES: None},
                subscriptions={JOINT_STATES: None},
                parameters=alone,
            )
        )
        == []
    )


def test_finger_may_be_moved_by_its_joints():
    assert faults(SERVOED) == []


@pytest.mark.parametrize('commands', ['velocity', 'joint_velocities'])
def test_plant_moves_the_finger_by_what_it_takes(commands):
    seen = changed(
        replace(WELL, nodes=(*LOOP, SIM_PLANT)),
        parameters={SIM_PLANT: {'commands': commands}},
        health={SIM_PLANT: (0, 'pushing')},
        subscriptions={COMMAND: ends(COMMAND, PUSH_CONTROLLER, SIM_PLANT)},
    )
    assert [fault.subject for fault in faults(seen)] == [COMMAND] * (commands != 'velocity')


def test_foreign_sensor_takes_the_place_of_ours():
    assert faults(changed(SENSORLESS, publishers={TACTILE: ends(TACTILE, 'own')})) == []


def test_a_law_that_places_needs_the_estimate_and_may_wait_for_a_goal():
    takes = {topic: ends(topic, PUSH_CONTROLLER) for topic in (PLACE_GOAL, SENSING_STATE)}
    (fault,) = faults(changed(subscriptions=takes))
    assert (fault.verdict, fault.subject) == (MISSING, SENSING_STATE)
    assert 'active_sensing' in fault.remedy


def test_reliable_and_best_effort_subscription_of_one_node_serve_each_other():
    both = (*ends(COMMAND, 'logger'), *ends(COMMAND, 'logger', reliable=False))
    seen = changed(
        publishers={COMMAND: ends(COMMAND, PUSH_CONTROLLER, reliable=False)},
        subscriptions={COMMAND: (*both, *ends(COMMAND, 'own_finger', reliable=False))},
    )
    assert faults(seen) == []
