# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import replace

import numpy as np
import pytest

from tactile_push.mechanics import Outline, Pose, Slider, Support, clearance
from tactile_push.simulation import RigConfig
from tactile_push.simulation.mujoco_model import GRAVITY, MujocoPhysics, model_xml

BLOCK = Outline.rectangle(0.05, 0.0475)
PHYSICS = MujocoPhysics(Support.corners(BLOCK), 0.3, 1.0, 0.05, 0.016)
CONFIG = RigConfig(Slider.on(BLOCK, PHYSICS.support), 0.5, 0.0, 0.0)


@pytest.fixture
def mujoco():
    return pytest.importorskip('mujoco', reason="pip install 'tactile_push[mujoco]'")


@pytest.mark.parametrize(
    'support',
    [
        Support.corners(BLOCK),
        Support.uniform(BLOCK, 36),
        Support.at_points([(-0.02, -0.02), (0.02, -0.02), (0.0, 0.01)], [1.0, 1.0, 4.0]),
    ],
    ids=['corners', 'uniform', 'three points'],
)
def test_feet_sink_alike_under_their_shares_of_the_weight(mujoco, support):
    model = mujoco.MjModel.from_xml_string(model_xml(CONFIG, replace(PHYSICS, support=support)))
    data = mujoco.MjData(model)
    data.qpos[7] = -0.1  # the finger is away
    for _ in range(1000):
        mujoco.mj_step(model, data)
    assert data.contact.dist == pytest.approx(-50e-6, rel=0.01)
    shares = support.loads / support.loads.sum()
    loads = data.efc_force[data.contact.efc_address]
    assert loads == pytest.approx(shares * 1.0 * GRAVITY, rel=0.01)


def test_the_moments_of_inertia_are_those_of_a_prism(mujoco):
    model = mujoco.MjModel.from_xml_string(model_xml(CONFIG, PHYSICS))
    inertia = model.body('object').inertia
    about = np.array([0.0475**2 + 0.05**2, 0.05**2 + 0.05**2, 0.05**2 + 0.0475**2]) / 12.0
    assert sorted(inertia) == pytest.approx(sorted(about), rel=0.05)
    given = mujoco.MjModel.from_xml_string(model_xml(CONFIG, replace(PHYSICS, inertia=1e-3)))
    assert 1e-3 in given.body('object').inertia


def test_an_object_left_alone_stops_as_fast_as_friction_lets_it(mujoco):
    model = mujoco.MjModel.from_xml_string(model_xml(CONFIG, PHYSICS))
    data = mujoco.MjData(model)
    data.qpos[2], data.qpos[7] = -50e-6, -0.1
    data.qvel[0] = 0.5
    for _ in range(100):
        mujoco.mj_step(model, data)
    # mu_s g for as long as the velocity is above what the viscous part of friction stops.
    assert data.qvel[0] == pytest.approx(0.5 - 0.3 * GRAVITY * 0.1, rel=0.02)


@pytest.mark.parametrize(
    'outline',
    [Outline.circle(0.02), Outline.polygon([(-0.02, -0.02), (0.03, -0.01), (-0.01, 0.03)])],
    ids=['circle', 'polygon'],
)
def test_the_side_is_the_outline(mujoco, outline):
    slider = Slider.on(outline, Support.uniform(outline))
    config = RigConfig(slider, 0.5, 0.0, None)
    physics = replace(PHYSICS, support=Support.uniform(slider.outline, 36))
    model = mujoco.MjModel.from_xml_string(model_xml(config, physics))
    data = mujoco.MjData(model)
    side, tip = model.geom('side').id, model.geom('tip').id
    mujoco.mj_forward(model, data)
    at = data.geom_xpos[tip][:2].copy()
    for x, y in 1.5 * slider.outline.points(5e-3):
        data.qpos[:2] = at - (x, y)  # the object comes to the tip
        mujoco.mj_forward(model, data)
        _, gap = clearance(Pose(0.0, 0.0, 0.0), x, y, config.body.path, config.radius)
        assert mujoco.mj_geomDistance(model, data, side, tip, 1.0, None) == pytest.approx(
            gap, abs=1e-6
        )


@pytest.mark.parametrize(
    ('name', 'value'),
    [('mu_s', 0.0), ('mass', math.inf), ('object_height', -1.0), ('push_height', 0.05)],
)
def test_physics_that_is_none_is_refused(name, value):
    with pytest.raises(ValueError, match=f'{name}: expected'):
        replace(PHYSICS, **{name: value})


def test_feet_that_do_not_balance_the_object_are_refused():
    with pytest.raises(ValueError, match='support: expected loads that balance'):
        replace(PHYSICS, support=Support.at_points([(0.0, 0.0), (0.02, 0.0)]))
