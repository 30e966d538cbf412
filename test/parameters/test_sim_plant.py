# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
import math

import pytest

from tactile_push.parameters.sim_plant import FAULTS, SimPlantParameters, faults_on

HARMLESS = {'belt_ripple_frequency', 'mu_c_ripple_length'}  # without the ripple


def test_every_fault_is_off_by_default_and_changeable_while_the_plant_runs():
    assert faults_on(SimPlantParameters()) == []
    assert not any(fault.read_only for fault in FAULTS)


@pytest.mark.parametrize('fault', FAULTS, ids=lambda fault: fault.name)
def test_a_fault_that_is_on_is_named(fault):
    value = True if isinstance(fault.default, bool) else 0.125
    assert not math.isclose(value, fault.default)
    on = faults_on(SimPlantParameters(**{fault.name: value}))
    assert on == ([] if fault.name in HARMLESS else [fault.name])
