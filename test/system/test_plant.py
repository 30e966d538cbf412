# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The plant's faults and what it makes of commands, as a process."""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from geometry_msgs.msg import PoseStamped, TwistStamped
from sensor_msgs.msg import JointState

from tactile_push.control import settle_step
from tactile_push.testing import NodeProcesses, Observer, Rig, field, seconds

WELL, WARN = DiagnosticStatus.OK, DiagnosticStatus.WARN


class Plant:
    """A plant alone, in real time, and whoever commands it."""

    def __init__(self, nodes: NodeProcesses, observer: Observer, device: str, **settings: Any):
        self.observer = observer
        self.truth = observer.hear(JointState, 'ground_truth/state')
        self.said = observer.hear(DiagnosticArray, '/diagnostics')
        self.commands = observer.node.create_publisher(TwistStamped, 'finger/cmd_vel', 10)
        nodes.start('sim_plant', {'device': device, **settings})
        observer.wait_for(
            lambda: self.truth and self.commands.get_subscription_count(), 'the plant'
        )

    def command(self, v_x: float) -> None:
        message = TwistStamped()
        message.twist.linear.x = v_x
        self.commands.publish(message)

    def command_until(self, v_x: float, condition: Any, what: str) -> None:
        """Send a velocity again and again until something is so."""

        def commanded() -> Any:
            self.command(v_x)
            return condition()

        self.observer.wait_for(commanded, what)

    def last(self, name: str) -> float:
        return field(self.truth[-1], name)

    def set(self, **values: Any) -> list[Any]:
        return self.observer.set_parameters('sim_plant', **values)

    def report(self) -> tuple[bytes, str, dict[str, str]]:
        """Give the level, the message and the values that it told last."""
        statuses = [s for array in self.said for s in array.status if s.name == 'sim_plant']
        if not statuses:
            return b'', '', {}
        status = statuses[-1]
        return status.level, status.message, {v.key: v.value for v in status.values}


@pytest.fixture
def plant(nodes: NodeProcesses, observer: Observer, tmp_path: Any) -> Plant:
    return Plant(nodes, observer, str(tmp_path / 'sensor'))


def test_faults_come_and_go_while_the_plant_runs_and_are_named(plant: Plant):
    plant.command_until(-0.0002, lambda: plant.last('v_x') == -0.0002, 'the finger to move')
    assert plant.last('belt_speed') == 0.005
    assert all(r.successful for r in plant.set(belt_stopped=True, servo_velocity_quantum=0.00015))
    plant.command_until(-0.0002, lambda: plant.last('belt_speed') == 0.0, 'the belt to stop')
    plant.command_until(-0.0002, lambda: plant.last('v_x') == -0.00015, 'a quantised velocity')
    assert plant.last('v_x_commanded') == -0.0002
    plant.command_until(
        -0.0002,
        lambda: plant.report()[:2] == (WARN, 'pushing, with servo_velocity_quantum, belt_stopped'),
        'the faults to be named',
    )
    plant.set(belt_stopped=False, servo_velocity_quantum=0.0)
    plant.command_until(-0.0002, lambda: plant.report()[:2] == (WELL, 'pushing'), 'no faults')
    assert plant.report()[2]['faults'] == 'none'


def test_fault_beyond_its_range_or_of_another_type_is_refused_with_a_reason(plant: Plant):
    wrong = {
        'sensor_noise': -0.1,
        'sensor_dropout': 1.5,
        'sensor_bias': math.nan,
        'servo_delay': math.inf,
        'workspace_min': math.nan,
        'sensor_outlier': 'much',
        'sensor_stuck': 1,
        'seed': 3,
    }
    for name, value in wrong.items():
        (result,) = plant.set(**{name: value})
        assert not result.successful, name
        assert result.reason, name
    assert plant.set(workspace_max=-0.05)[0].successful
    (result,) = plant.set(workspace_min=0.0)
    assert not result.successful
    assert 'parameter workspace_min: expected a lower bound below' in result.reason


def test_command_that_is_no_number_stops_the_finger_at_once_and_is_counted(plant: Plant):
    plant.command_until(0.003, lambda: plant.last('v_x') == 0.003, 'the finger to move')
    plant.command(math.nan)
    plant.observer.wait_for(lambda: plant.last('v_x') == 0.0, 'the finger to stop')
    # Well before the 0.5 s after which it stops without a command.
    moving = next(m for m in reversed(plant.truth) if field(m, 'v_x') != 0.0)
    stopped = next(m for m in plant.truth if seconds(m) > seconds(moving))
    assert seconds(stopped) - seconds(moving) < 0.3
    assert all(math.isfinite(field(m, 'finger_x')) for m in plant.truth)
    plant.observer.wait_for(
        lambda: plant.report()[2].get('commands not finite') == '1', 'the command to be counted'
    )


def test_command_that_is_too_fast_is_bounded_and_counted(plant: Plant):
    plant.command_until(1e300, lambda: plant.last('v_x') == 0.1, 'the finger to move')
    plant.command_until(-0.5, lambda: plant.last('v_x') == -0.1, 'the finger to come back')
    plant.command_until(
        0.0,
        lambda: int(plant.report()[2].get('commands too fast', 0)) >= 2,
        'the commands to be counted',
    )


def test_stamps_of_before_1970_end_nothing(
    nodes: NodeProcesses, observer: Observer, tmp_path: Path
):
    plant = Plant(nodes, observer, str(tmp_path / 'sensor'), publish_clock=True)
    contacts = observer.node.create_publisher(PoseStamped, 'contact', 10)
    message = TwistStamped()
    message.header.stamp.sec = -5
    message.twist.linear.x = 0.002
    contact = PoseStamped(header=message.header)

    def told() -> bool:
        contacts.publish(contact)
        plant.commands.publish(message)
        return field(plant.truth[-1], 'v_x') == 0.002

    observer.wait_for(told, 'the finger to obey')
    count = len(plant.truth)
    observer.wait_for(lambda: len(plant.truth) > count + 20, 'time to go on')
    assert nodes.running['sim_plant'].poll() is None


def test_second_publisher_of_commands_is_reported(plant: Plant):
    other = plant.observer.node.create_publisher(TwistStamped, 'finger/cmd_vel', 10)
    plant.command_until(
        0.0,
        lambda: plant.report()[:2] == (WARN, 'several publishers of finger/cmd_vel'),
        'the second publisher to be noticed',
    )
    plant.observer.node.destroy_publisher(other)
    plant.command_until(0.0, lambda: plant.report()[1] == 'pushing', 'one publisher again')


def test_finger_stops_at_its_workspace_and_says_so(plant: Plant):
    plant.set(workspace_max=-0.058)
    plant.command_until(0.02, lambda: plant.last('finger_x') > 0.001999, 'the bound')
    plant.command_until(
        0.02, lambda: plant.report()[1].startswith('finger at its workspace limit'), 'the report'
    )
    plant.command_until(0.02, lambda: plant.last('v_x') == 0.0, 'the finger to stand')
    assert plant.last('v_x_commanded') == 0.02
    assert max(field(m, 'finger_x') for m in plant.truth) <= 0.002 + 1e-12


def test_hardware_like_loop_settles_and_simulated_time_goes_on(rig: Rig, observer: Observer):
    diagnostics = observer.hear(DiagnosticArray, '/diagnostics')
    rig.start(
        sensor_rate=50.0,
        servo_time_constant=0.1,
        sensor_noise=math.radians(0.5),
        sensor_outlier=0.01,
        sensor_dropout=0.01,
        sensor_latency=0.02,
    )
    observer.wait_for(lambda: rig.states and field(rig.states[-1], 'ticks') > 300, '300 ticks')
    observer.wait_for(
        lambda: seconds(rig.truth[-1]) >= seconds(rig.states[-1]), 'the truth of that time'
    )
    theta = np.array([field(m, 'theta') for m in rig.truth])
    assert settle_step(theta, math.radians(-10.0), math.radians(3.0)) is not None
    assert field(rig.states[-1], 'ticks_lost') == 0.0
    observer.wait_for(
        lambda: any(
            int({v.key: v.value for v in s.values}.get('readings lost', 0)) > 0
            for array in diagnostics
            for s in array.status
            if s.name == 'sim_plant'
        ),
        'lost readings to be counted',
    )


@pytest.mark.parametrize('fault', [{'sensor_dropout': 1.0}, {'sensor_detectable_range': 0.0}])
def test_time_goes_on_without_any_contact(rig: Rig, observer: Observer, fault: dict[str, float]):
    rig.start()
    rig.wait_until_moving()
    assert observer.set_parameters('sim_plant', **fault)[0].successful
    rig.wait_until_resting()
    later = seconds(rig.truth[-1]) + 3.0
    observer.wait_for(lambda: seconds(rig.truth[-1]) > later, 'time to pass')
