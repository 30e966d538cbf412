# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What nodes commanded comes out again, to the bit, of the bag that was recorded meanwhile."""

import signal
from pathlib import Path

from geometry_msgs.msg import PoseStamped
from lifecycle_msgs.msg import Transition
from sensor_msgs.msg import JointState
from std_srvs.srv import Trigger

from tactile_push.bags import BagReader
from tactile_push.cli import main
from tactile_push.control import PUSHING, STATES, STOP_REASONS, STOPPED
from tactile_push.parameters.config_file import config_file
from tactile_push.replay import replay
from tactile_push.testing import NodeProcesses, Observer, field, seconds


def test_bag_of_an_eventful_run_replays_to_the_bit(
    nodes: NodeProcesses, observer: Observer, tmp_path: Path
):
    states = observer.hear(JointState, 'push_controller/state')
    sensed = observer.hear(JointState, 'active_sensing/state')
    device = {'device': str(tmp_path / 'sensor')}
    bag = tmp_path / 'bag'

    def wait_for_ticks(count: int, state: str) -> None:
        """Wait for ticks in a row in a state."""
        seen, index = len(states), float(STATES.index(state))

        def in_a_row() -> bool:
            new = states[seen:][-count:]
            return len(new) == count and all(field(s, 'state') == index for s in new)

        observer.wait_for(in_a_row, f'{count} ticks {state}')

    nodes.start('sim_plant', {**device, 'sensor_noise': 0.002}, config=config_file('block.yaml'))
    nodes.start('sensor_driver', device)
    nodes.start('contact_geometry', config=config_file('block.yaml'))
    # On a loaded machine it would rest until somebody resumed it, before its time comes.
    late = {'max_ticks_lost': 100}
    nodes.start('push_controller', late, config=config_file('block.yaml'))
    nodes.start('active_sensing', config=config_file('block.yaml'))
    wait_for_ticks(5, PUSHING)
    observer.wait_for(lambda: sensed, 'the object to be sensed')
    recorder = nodes.start('bag_recorder', {'output': str(bag)})
    # The observer hears two of them, too.
    hearing = {
        'push_controller/state': 3,
        'contact_geometry/state': 1,
        'active_sensing/state': 2,
        'object_pose': 1,
    }
    observer.wait_for(
        lambda: all(observer.node.count_subscribers(t) >= n for t, n in hearing.items()),
        'the recorder to listen',
    )
    wait_for_ticks(15, PUSHING)
    driver = nodes.running.pop('sensor_driver')
    driver.kill()
    driver.wait()
    wait_for_ticks(3, STOPPED)
    nodes.start('sensor_driver', device)
    wait_for_ticks(10, PUSHING)
    assert observer.set_parameters('push_controller', kd=2.0)[0].successful
    wait_for_ticks(10, PUSHING)
    assert observer.change_state('push_controller', Transition.TRANSITION_DEACTIVATE)
    assert observer.change_state('push_controller', Transition.TRANSITION_ACTIVATE)
    wait_for_ticks(10, PUSHING)
    assert observer.set_parameters('push_controller', max_ticks_lost=3)[0].successful
    controller = nodes.running['push_controller']
    controller.send_signal(signal.SIGSTOP)
    ticks = len(states)
    contacts = observer.hear(PoseStamped, 'contact')
    observer.wait_for(  # the others go on, for longer than three periods
        lambda: contacts and seconds(contacts[-1]) - seconds(states[-1]) > 0.8, 'time to pass'
    )
    assert len(states) <= ticks + 1
    controller.send_signal(signal.SIGCONT)
    wait_for_ticks(3, STOPPED)
    assert STOP_REASONS[int(field(states[-1], 'stop_reason'))] == 'ticks lost'
    assert observer.call(Trigger, 'push_controller/resume', Trigger.Request()).success
    wait_for_ticks(10, PUSHING)
    recorder.send_signal(signal.SIGINT)
    assert recorder.wait(30) == 0

    with BagReader(bag) as reader:
        (comparison,) = replay(reader, out=tmp_path / 'again')
    # Until recorder and nodes have found one another nothing can be followed.
    assert len(comparison.ticks) > 40
    assert not comparison.different()
    # What had been heard before the recording counts until the contact is lost.
    assert 20 < len(comparison.sensed) < len(comparison.ticks)
    assert main(['diff', str(bag), str(tmp_path / 'again')]) == 0
