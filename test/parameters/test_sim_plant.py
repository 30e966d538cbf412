# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
import numpy as np
import pytest

from tactile_push.parameters.sim_plant import (
    FAULTS,
    SimPlantParameters,
    faults,
    faults_on,
    rig_config,
)
from tactile_push.simulation import Faults, Workspace

HARMLESS = {'belt_ripple_frequency', 'mu_c_ripple_length'}  # without the ripple
# A value of each fault, and where it has to arrive.
VALUES = {
    'servo_time_constant': (0.1, lambda f: f.servo.time_constant),
    'servo_delay': (0.2, lambda f: f.servo.delay),
    'servo_velocity_quantum': (0.001, lambda f: f.servo.velocity_quantum),
    'lift_delay': (0.1, lambda f: f.servo.lift_delay),
    'workspace_min': (-0.08, lambda f: f.workspace.lower),
    'workspace_max': (0.02, lambda f: f.workspace.upper),
    'belt_ripple': (0.3, lambda f: f.belt.ripple),
    'belt_ripple_frequency': (2.0, lambda f: f.belt.frequency),
    'belt_stopped': (True, lambda f: f.belt.stopped),
    'mu_c_ripple': (0.4, lambda f: f.friction.ripple),
    'mu_c_ripple_length': (0.01, lambda f: f.friction.length),
    'sensor_noise': (0.01, lambda f: f.sensor.noise),
    'sensor_bias': (-0.02, lambda f: f.sensor.bias),
    'sensor_quantum': (0.005, lambda f: f.sensor.quantum),
    'sensor_latency': (0.05, lambda f: f.sensor.latency),
    'sensor_dropout': (0.015, lambda f: f.sensor.dropout),
    'sensor_outlier': (0.025, lambda f: f.sensor.outlier),
    'sensor_stuck': (True, lambda f: f.sensor.stuck),
    'sensor_detectable_range': (0.7, lambda f: f.sensor.detectable_range),
    'wrench_noise': (0.05, lambda f: f.force_sensor.noise),
    'wrench_moment_noise': (0.0005, lambda f: f.force_sensor.moment_noise),
    'wrench_offset': ([1.0, 2.0, 3.0, 0.1, 0.2, 0.3], lambda f: list(f.force_sensor.offset)),
    'wrench_drift': ([0.1, 0.0, 0.0, 0.0, 0.0, 0.2], lambda f: list(f.force_sensor.drift)),
}


def test_every_fault_is_off_by_default_and_changeable_while_the_plant_runs():
    assert faults_on(SimPlantParameters()) == []
    assert not any(fault.read_only for fault in FAULTS)


@pytest.mark.parametrize('fault', FAULTS, ids=lambda fault: fault.name)
def test_a_fault_that_is_on_is_named(fault):
    value = {bool: True, list: [0.125] * 6}.get(type(fault.default), 0.125)
    assert value != fault.default
    on = faults_on(SimPlantParameters(**{fault.name: value}))
    assert on == ([] if fault.name in HARMLESS else [fault.name])


def test_every_fault_is_off_by_default():
    assert faults(SimPlantParameters()) == Faults()
    assert [fault.name for fault in FAULTS] == list(VALUES)


@pytest.mark.parametrize('name', VALUES)
def test_each_fault_arrives_where_it_belongs(name):
    value, place = VALUES[name]
    assert place(faults(SimPlantParameters(**{name: value}))) == value


def test_a_workspace_without_a_place_is_refused():
    bounded = SimPlantParameters(workspace_min=-0.1, workspace_max=0.1)
    assert faults(bounded).workspace == Workspace(-0.1, 0.1)
    with pytest.raises(ValueError, match='parameter workspace_min: expected'):
        faults(SimPlantParameters(workspace_min=0.1, workspace_max=-0.1))


def test_a_wrench_of_other_than_six_numbers_is_refused():
    with pytest.raises(ValueError, match='parameter wrench_offset: expected six finite numbers'):
        faults(SimPlantParameters(wrench_offset=[1.0]))


def test_a_start_beyond_the_edge_is_refused_by_the_name_of_its_parameter():
    with pytest.raises(ValueError, match='parameter d_initial: expected a contact .* got 0.3'):
        rig_config(SimPlantParameters(d_initial=0.3))


TRIANGLE = [-0.02, -0.01, 0.03, -0.01, -0.01, 0.02]


def test_a_polygon_is_pushed_at_its_first_edge():
    p = SimPlantParameters(object='polygon', vertices=TRIANGLE, d_initial=0.01, c=0.015, mu_c=0.3)

    config = rig_config(p)

    corners = [[-0.02, -0.01], [0.03, -0.01], [-0.01, 0.02]]
    assert config.slider.outline.points(1.0) == pytest.approx(np.array(corners))
    assert (config.slider.c, config.mu_c, config.d) == (0.015, 0.3, 0.01)


@pytest.mark.parametrize(
    ('vertices', 'said'),
    [
        (TRIANGLE[:5], 'expected x and y of three corners or more, got 5 numbers'),
        (TRIANGLE[:4], 'expected x and y of three corners or more, got 4 numbers'),
        ([0.0, 0.0, 1.0, 0.0, 2.0, 0.0], 'expected a convex outline'),
        ([1000.0 * number for number in TRIANGLE], 'are these millimetres?'),
        ([number + 0.1 for number in TRIANGLE], 'expected a point inside the outline'),
    ],
)
def test_a_polygon_that_is_none_is_refused(vertices, said):
    with pytest.raises(ValueError, match='^parameter vertices: ') as error:
        rig_config(SimPlantParameters(object='polygon', vertices=vertices))
    assert said in str(error.value)
