# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What an experiment waits for before it starts the controller."""

from pathlib import Path

from geometry_msgs.msg import PoseStamped
from sensor_msgs.msg import JointState

from support.states import read_states
from tactile_push.parameters.config_file import config_file
from tactile_push.testing import NodeProcesses, Observer
from tactile_push.testing.observer import PATIENCE


def test_controller_starts_when_the_object_is_sensed(
    nodes: NodeProcesses, observer: Observer, tmp_path: Path
):
    contacts = observer.hear(PoseStamped, 'contact')
    states = observer.hear(JointState, 'push_controller/state')
    config, simulated = config_file('block.yaml'), {'use_sim_time': True}
    device, bag = {'device': str(tmp_path / 'sensor')}, tmp_path / 'bag'
    timing = {'sensor_rate': 20.0, 'publish_clock': True, 'real_time_factor': 20.0}
    nodes.start('sim_plant', {**device, **timing}, config=config)
    nodes.start('sensor_driver', {**device, **simulated})
    nodes.start('contact_geometry', simulated, config=config)
    nodes.start('push_controller', {'autostart': False, **simulated}, config=config)
    experiment = nodes.start('experiment', {'bag': str(bag), 'steps': 40, **simulated})
    others = {'contact': 3, 'push_controller/state': 2}  # the observer, too
    observer.wait_for(
        lambda: (
            contacts and all(observer.node.count_subscribers(t) >= n for t, n in others.items())
        ),
        'the others to hear each other',
    )
    seen = len(contacts)
    observer.wait_for(lambda: len(contacts) >= seen + 100, 'time to go by')
    assert states == []
    nodes.start('active_sensing', simulated, config=config)
    assert experiment.wait(PATIENCE) == 0
    pushed = read_states(bag, '/push_controller/state')
    sensed = read_states(bag, '/active_sensing/state')
    assert len(pushed['stamp']) >= 40
    # When all have found one another only they know: the first ones may not be in the bag.
    assert len(sensed['stamp']) > 0
    assert sensed['stamp'][0] >= pushed['stamp'][0]
