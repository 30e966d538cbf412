# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
import itertools
import math
import signal

import pytest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from lifecycle_msgs.msg import Transition

from tactile_push.control import PUSHING, STATES, STOPPED
from tactile_push.testing import Observer, Rig, field, seconds

CONTROL_PERIOD, CONTACT_TIMEOUT, COMMAND_TIMEOUT = 0.1, 0.3, 0.5
PUSHED, STOPPED_ = float(STATES.index(PUSHING)), float(STATES.index(STOPPED))


def levels(arrays: list[DiagnosticArray], node: str) -> list[bytes]:
    return [s.level for array in arrays for s in array.status if s.name == node]


def test_killed_driver_stops_the_finger_and_a_new_one_lets_it_go_on_without_a_kick(
    rig: Rig, observer: Observer
):
    diagnostics = observer.hear(DiagnosticArray, '/diagnostics')
    rig.start()
    rig.wait_until_moving()
    assert field(rig.states[-1], 'state') == PUSHED
    rig.nodes.running['sensor_driver'].kill()
    rig.nodes.running['sensor_driver'].wait()
    observer.wait_for(lambda: rig.commands[-1].twist.linear.x == 0.0, 'a zero command')
    rig.wait_until_resting()
    last_contact = seconds(rig.contacts[-1])
    later = [m for m in rig.commands if seconds(m) > last_contact]
    stopped = next(seconds(m) for m in later if m.twist.linear.x == 0.0)
    # A stamp just at the timeout may round either way; the last contact may be heard here alone.
    assert stopped - last_contact >= CONTACT_TIMEOUT - 0.051
    assert stopped - last_contact <= CONTACT_TIMEOUT + CONTROL_PERIOD + 0.051
    assert all(m.twist.linear.x == 0.0 for m in later if seconds(m) > stopped)
    observer.wait_for(
        lambda: DiagnosticStatus.ERROR in levels(diagnostics, 'push_controller'),
        'the controller to report an error',
    )

    silent = len(rig.commands)
    contacts = len(rig.contacts)
    rig.start_node('sensor_driver', {'use_sim_time': True})
    observer.wait_for(lambda: len(rig.contacts) > contacts + 20, 'contacts')
    rig.wait_until_moving()
    resumed = next(m for m in rig.states if seconds(m) > stopped and field(m, 'state') == PUSHED)
    assert field(resumed, 'phi') == pytest.approx(math.pi / 2.0)
    assert field(resumed, 'v_x') == 0.0
    # The law may change phi by kp |theta - theta_d| and kd |theta(k) - theta(k-1)| a period.
    velocity = [m.twist.linear.x for m in rig.commands[silent:]]
    steps = [abs(b - a) for a, b in itertools.pairwise(velocity)]
    assert max(steps) < 0.0015
    observer.wait_for(
        lambda: levels(diagnostics, 'push_controller')[-1] == DiagnosticStatus.OK,
        'the controller to be well again',
    )


def test_killed_controller_stops_the_finger(rig: Rig, observer: Observer):
    rig.start()
    rig.wait_until_moving()
    rig.nodes.running['push_controller'].kill()
    rig.nodes.running['push_controller'].wait()
    rig.wait_until_resting()
    moving = [m for m in rig.truth if field(m, 'v_x') != 0.0]
    assert seconds(moving[-1]) - seconds(rig.commands[-1]) <= COMMAND_TIMEOUT + 0.051


def test_deactivated_controller_sends_a_last_zero_and_falls_silent(rig: Rig, observer: Observer):
    rig.start()
    rig.wait_until_moving()
    assert observer.change_state('push_controller', Transition.TRANSITION_DEACTIVATE)
    rig.wait_until_resting()
    assert rig.commands[-1].twist.linear.x == 0.0
    said = len(rig.commands)
    later = seconds(rig.truth[-1]) + 5 * CONTROL_PERIOD
    observer.wait_for(lambda: seconds(rig.truth[-1]) > later, 'time to pass')
    assert len(rig.commands) == said
    assert observer.change_state('push_controller', Transition.TRANSITION_ACTIVATE)
    rig.wait_until_moving()
    assert rig.commands[said].twist.linear.x == 0.0


@pytest.mark.parametrize('stop_signal', [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_signal_ends_every_node_in_silence_and_the_last_command_is_zero(
    rig: Rig, observer: Observer, stop_signal
):
    rig.start()
    rig.wait_until_moving()
    controller = rig.nodes.running.pop('push_controller')
    said = rig.nodes.log('push_controller').read_text()
    controller.send_signal(stop_signal)
    observer.wait_for(lambda: controller.poll() is not None, 'the controller to end')
    observer.wait_for(lambda: rig.commands[-1].twist.linear.x == 0.0, 'a zero command')
    rig.wait_until_resting()
    assert controller.returncode == 0
    assert rig.nodes.log('push_controller').read_text() == said
    for name, process in rig.nodes.running.items():
        process.send_signal(stop_signal)
        observer.wait_for(lambda process=process: process.poll() is not None, f'{name} to end')
        assert process.returncode == 0, name
