# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
from tactile_push.tactile import LinearAxis


def test_the_disk_is_where_the_joint_is():
    axis = LinearAxis()
    assert axis.centre((0.03,)) == (0.03, 0.0)
    assert axis.levers((0.03,)) == ((1.0, 0.0),)
    assert axis.manipulability((0.03,)) == 1.0


def test_positions_are_no_angles():
    assert LinearAxis().moved((0.0,), (7.0,)) == (7.0,)
