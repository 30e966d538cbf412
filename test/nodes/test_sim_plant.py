# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The package's own rig as a node; what a plant does is tested there."""

import pytest

from support.node_bench import declared_topics
from tactile_push.interface import SIM_PLANT
from tactile_push.nodes.ros.parameters import ConfigurationError
from tactile_push.nodes.sim_plant import SimPlant


@pytest.fixture
def plant(bench, tmp_path):
    """Return what starts the plant with a device of its own."""
    return lambda **parameters: bench.start(
        SimPlant, **{'device': tmp_path / 'sensor', 'sensor_rate': 100.0, **parameters}
    )


def test_topics_are_those_of_the_interface(bench, plant):
    pytest.importorskip('cv2', reason="pip install 'tactile_push[camera]'")
    all_that_it_can = {'publish_wrench': True, 'publish_image': True}
    plant(publish_clock=True, commands='joint_velocities', **all_that_it_can)
    assert bench.topics() == declared_topics(SIM_PLANT)


@pytest.mark.parametrize(
    ('parameters', 'refusal'),
    [
        ({'real_time_factor': 2.0}, 'parameter real_time_factor: expected 1.0 unless'),
        ({'device': 'relative/path'}, 'parameter device: '),
        ({'object': 'ball'}, 'parameter object: expected one of block, disk'),
        ({'d_initial': 0.03}, 'parameter d_initial: expected'),
        (
            {'commands': 'joint_velocities', 'commanded_point': 'pole'},
            'parameter commanded_point: expected centre with commands joint_velocities',
        ),
        (
            {'commands': 'joint_velocities', 'servo_velocity_quantum': 0.001},
            'parameter servo_velocity_quantum: expected 0.0 with commands',
        ),
        ({'workspace_min': 0.2, 'workspace_max': 0.1}, 'parameter workspace_min: expected'),
    ],
)
def test_a_rig_that_is_none_is_refused(plant, parameters, refusal):
    with pytest.raises(ConfigurationError) as refused:
        plant(**parameters)
    assert str(refused.value).startswith(refusal)
