# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
import pytest

from tactile_push.interface import FORCE_TORQUE, SENSORS
from tactile_push.parameters import (
    PARAMETERS,
    ActiveSensingParameters,
    MujocoPlantParameters,
    SimPlantParameters,
)
from tactile_push.parameters.sensor_kinds import SENSOR_KINDS


def test_each_kind_of_the_interface_is_here():
    assert tuple(SENSOR_KINDS) == SENSORS


@pytest.mark.parametrize('name', SENSORS)
def test_nodes_and_plants_take_what_a_kind_needs(name):
    kind = SENSOR_KINDS[name]
    for node, given in (
        (PARAMETERS[kind.node], kind.parameters),
        (SimPlantParameters, kind.plant),
        (MujocoPlantParameters, kind.plant),
        (ActiveSensingParameters, kind.sensing),
    ):
        made = node.of(given)
        assert {name: getattr(made, name) for name in given} == given


def test_plant_waits_for_contacts_as_old_as_the_filter_makes_them():
    kind = SENSOR_KINDS[FORCE_TORQUE]
    assert kind.plant['contact_lag'] == kind.parameters['filter_time_constant']
