# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The finger and the object in the view from above."""

import math

import numpy as np
import pytest

from support.pushed_bag import (
    JOINTS,
    POSE,
    START,
    L,
    R,
    joint_state,
    pose,
    run_of,
    written,
)
from tactile_push.bags import BagWriter


def test_scene_follows_the_parameters(run):
    assert run.scene.radius == R
    assert run.scene.mu_c == 0.3
    assert np.ptp(run.scene.outline, axis=0) == pytest.approx([0.05, 2.0 * L])


@pytest.mark.parametrize('shape', ['block', 'disk', 'neither'])
def test_object_without_parameters_is_known_by_its_contacts(tmp_path, shape):
    rows = []
    for k in range(50):
        angle = 0.01 * k
        normal = angle + math.pi / 2.0
        d, l = {'block': (1e-4 * k, 0.02375), 'disk': (0.0, 0.0285), 'neither': (0.0, 0.04)}[shape]
        x = (R + l) * math.cos(normal) - d * math.cos(angle)
        y = (R + l) * math.sin(normal) - d * math.sin(angle)
        turned = angle if shape == 'block' else 3.0 * angle  # a disk may roll
        t = 0.02 * k
        rows += [
            ('/ground_truth/state', JOINTS, t, joint_state(t, theta=angle, d=d)),
            ('/ground_truth/object_pose', POSE, t, pose(t, x, y, turned)),
        ]
    outline = np.array(run_of(written(tmp_path / 'bag', *rows)).scene.outline)
    if shape == 'block':
        assert np.ptp(outline, axis=0) == pytest.approx([0.05, 0.0475])
    elif shape == 'disk':
        assert np.hypot(*outline.T) == pytest.approx(0.0285)
    else:
        assert len(outline) == 0


@pytest.mark.parametrize(
    'text', ['nonsense', '[1, 2]', '{"sim_plant": 3}', '{"sim_plant": {"object": 7}}']
)
def test_parameters_that_make_no_sense_are_as_good_as_none(tmp_path, text):
    with BagWriter(tmp_path / 'bag') as bag:
        bag.note('tactile_push.parameters', text)
        bag.add_topic('/contact', POSE)
        bag.write('/contact', pose(0.0, 0.0, R, 0.0), START, START)
    assert len(run_of(tmp_path / 'bag').scene.outline) == 0
