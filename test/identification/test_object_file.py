# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import json
import math
from dataclasses import replace

import numpy as np
import pytest

from support.measured_pushes import VERTICES
from tactile_push.identification.models import Physics
from tactile_push.identification.object_file import (
    mujoco_plant_values,
    object_content,
    plant_values,
    sensing_values,
)
from tactile_push.mechanics import Outline, Support
from tactile_push.parameters import (
    ActiveSensingParameters,
    MujocoPlantParameters,
    SimPlantParameters,
)
from tactile_push.parameters.active_sensing import make_sensing
from tactile_push.parameters.mujoco_plant import mujoco_config
from tactile_push.parameters.sim_plant import rig_config
from tactile_push.simulation import read_object

SHAPE = {'kind': 'polygon', 'vertices': VERTICES}


def test_the_file_says_what_was_found(identified, tmp_path):
    file = tmp_path / 'object.json'
    file.write_text(json.dumps(object_content(SHAPE, identified)))

    thing = read_object(file)

    physics = identified.fit.physics
    assert thing.mu_c == physics.mu_c
    assert thing.centre_of_mass == thing.support.centre == physics.support.centre
    # With more points than the fit had; those of a tilted pressure stand for it to a per mille.
    assert thing.support.c == pytest.approx(physics.support.c, rel=2e-3)
    content = json.loads(file.read_text())
    assert content['standard_deviations'] == identified.fit.deviations


def test_a_known_support_stays_as_it_is(identified, tmp_path):
    feet = Support.at_points([[0.005, 0.005], [0.05, 0.005], [0.01, 0.04]], [1.0, 2.0, 1.5])
    known = replace(identified, fit=replace(identified.fit, physics=Physics(feet, 0.4)))
    file = tmp_path / 'object.json'
    file.write_text(json.dumps(object_content(SHAPE, known)))

    thing = read_object(file)

    assert thing.support.points == pytest.approx(feet.points)
    assert thing.support.loads * 4.5 == pytest.approx(feet.loads)
    assert (thing.centre_of_mass, thing.mu_c) == (None, 0.4)


def test_friction_that_no_push_tells_is_left_out(identified):
    covariance = identified.fit.covariance.copy()
    covariance[1, 1] = math.inf
    found = replace(identified, fit=replace(identified.fit, covariance=covariance))

    content, values = object_content(SHAPE, found), sensing_values(found)

    assert 'mu_c' not in content
    assert [*content['standard_deviations']] == ['c', 'x', 'y']
    assert [*values] == ['vertices', 'c_min', 'c_max']
    assert 'mu_c' not in plant_values(found)


def test_active_sensing_takes_the_object_about_its_centre_of_friction(identified):
    values = sensing_values(identified)

    p = ActiveSensingParameters.of(values)
    make_sensing(p)
    corners = np.array(p.corners) + identified.fit.physics.support.centre
    assert corners == pytest.approx(np.array(VERTICES), abs=1e-12)
    for name, value in (('c', 0.025), ('mu_c', 0.3)):  # of the pushes
        low, high = values[f'{name}_min'], values[f'{name}_max']
        assert low < value < high
        assert high - low == pytest.approx(0.2 * value, rel=0.1)  # a tenth, as it is told well


def test_the_plant_pushes_the_object_at_its_first_edge(identified):
    config = rig_config(SimPlantParameters.of(plant_values(identified)))

    physics = identified.fit.physics
    assert (config.slider.c, config.mu_c) == (physics.support.c, physics.mu_c)
    corners = config.slider.outline.points(1.0) + physics.support.centre
    assert corners == pytest.approx(np.array(VERTICES), abs=1e-12)
    assert config.d == 0.0


def test_feet_in_mujoco_bear_the_object_as_it_was_found(identified):
    config, feet = mujoco_config(MujocoPlantParameters.of(mujoco_plant_values(identified)))

    physics = identified.fit.physics
    corners = config.slider.outline.points(1.0) + physics.support.centre
    assert corners == pytest.approx(np.array(VERTICES), abs=1e-12)
    assert config.mu_c == physics.mu_c
    # They are few: their c is a little below that of the pressure they stand for.
    shares = feet.support.loads / feet.support.loads.sum()
    assert shares @ np.hypot(*feet.support.points.T) == pytest.approx(physics.support.c, rel=0.03)
    assert shares @ feet.support.points == pytest.approx([0.0, 0.0], abs=1e-12)


def test_active_sensing_takes_a_disk_and_nothing_else_that_is_round(identified):
    def of(outline):
        return replace(identified, pushes=replace(identified.pushes, outline=outline))

    assert sensing_values(of(Outline.circle(0.03)))['disk_radius'] == pytest.approx(0.03)
    with pytest.raises(ValueError, match='outline: expected a polygon or a circle'):
        sensing_values(of(Outline.ellipse(0.03, 0.02)))
    disk = replace(of(Outline.circle(0.03)), fit=identified.fit)
    assert rig_config(SimPlantParameters.of(plant_values(disk))).d == 0.0
