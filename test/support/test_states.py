# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Joint states of a bag as columns."""

import pytest
from rosbags.rosbag2 import CompressionMode

from support.bag_by_rosbags import JOINT_STATE, write_by_rosbags
from support.bag_files import CLOCK
from support.states import read_states
from tactile_push.bags import BagError


def test_states_of_a_topic(tmp_path):
    write_by_rosbags(tmp_path / 'bag', CompressionMode.NONE)
    states = read_states(tmp_path / 'bag', '/state')
    assert list(states) == ['stamp', 'theta', 'phi']
    assert states['stamp'].tolist() == [step + 0.5 for step in range(50)]
    assert states['theta'].tolist() == [0.5 * step for step in range(50)]
    assert states['phi'].tolist() == [-1.0] * 50
    assert list(read_states(tmp_path / 'bag', '/nothing')) == ['stamp']
    with pytest.raises(BagError, match=f'{CLOCK}, expected {JOINT_STATE}'):
        read_states(tmp_path / 'bag', '/clock')
