# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Parameters as a person may mistype them, at the start and while the nodes run."""

import math
import subprocess
import sys
import time
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from typing import Any

from rcl_interfaces.msg import ParameterValue
from rcl_interfaces.srv import GetParameters
from rclpy.node import Node
from rclpy.parameter import Parameter as RosParameter

from tactile_push.nodes.contact_geometry import ContactGeometry
from tactile_push.nodes.push_controller import PushController
from tactile_push.nodes.sensor_driver import SensorDriver
from tactile_push.nodes.sim_plant import SimPlant
from tactile_push.parameters import PARAMETERS, Parameter

from .bench import Bench, expect
from .promise import NO_BENCH, fault

NODES: tuple[type[Node], ...] = (SensorDriver, ContactGeometry, PushController, SimPlant)
START_TIMEOUT = 30.0  # [s]
AT_A_TIME = 2
WILD = 2.0  # for so long the gains are the largest ones [s]
WRONG_ARGUMENTS = (
    ('push_controller', '-p kp:=-1.0'),
    ('push_controller', '-p kp:=1'),
    ('push_controller', '-p kp:=.nan'),
    ('push_controller', '-p kp:=1e999'),
    ('push_controller', '-p kp:=1,5'),
    ('push_controller', '-p kp:=much'),
    ('push_controller', '-p kp:=[0.05]'),
    ('push_controller', '-p kp:=true'),
    ('push_controller', '-p kp='),
    ('push_controller', '-p kp'),
    ('push_controller', '-p Kp:=0.05'),
    ('push_controller', '-p kpp:=0.05'),
    ('push_controller', '-p belt_speed:=-0.005'),
    ('push_controller', '-p belt_speed:=0.0'),
    ('push_controller', '-p theta_desired:=-10.0'),
    ('push_controller', '-p contact_timeout:=0.0'),
    ('push_controller', '-p control_rate:=10'),
    ('push_controller', '-p autostart:=maybe'),
    ('push_controller', '-p workspace_min:=0.2'),
    ('push_controller', '--params-file nowhere.yaml'),
    ('push_controller', 'kp:=0.05'),
    ('sensor_driver', '-p device:=nonsense://x'),
    ('sensor_driver', '-p device:=socket://127.0.0.1'),
    ('sensor_driver', '-p baud_rate:=9600.0'),
    ('sensor_driver', '-p baud_rate:=-9600'),
    ('sensor_driver', '-p devize:=/dev/ttyUSB0'),
    ('contact_geometry', '-p finger_radius:=13.5'),
    ('contact_geometry', '-p use_joint_states:=1'),
    ('contact_geometry', '-p mount_angle:=90.0'),
    ('contact_geometry', '-p joint_names:=proximal_joint'),
    ('finger_servo', '-p kinematics:=round'),
    ('finger_servo', '-p joint_names:=[proximal_joint]'),
    ('finger_servo', '-p joint_min:=[-3.0]'),
    ('finger_servo', '-p joint_max:=[-3.0,-3.0]'),
    ('finger_servo', '-p joint_speed:=[1,1]'),
    ('finger_servo', '-p workspace_min:=0.2'),
    ('sim_plant', '-p object:=cone'),
    ('sim_plant', '-p commands:=angles'),
    ('sim_plant', '-p mu_c:=-0.3'),
    ('sim_plant', '-p sensor_rate:=0.0'),
    ('sim_plant', '-p device:=/nowhere/sensor'),
)


def value_of(value: Any) -> ParameterValue:
    """Return a value as the service takes it; None is no value at all."""
    return RosParameter('any', value=value).get_parameter_value()


def wrong_values(parameter: Parameter) -> Iterator[Any]:
    """Return what a parameter must not become while its node runs."""
    kind = type(parameter.default)
    yield from (v for v in (True, 1, 1.0, '1.0', None) if type(v) is not kind)
    yield [1.0]
    if kind is not list:
        yield ['1.0']
    if kind in (int, float):
        bounds = (parameter.lower - 1, parameter.upper + 1)
        yield from (kind(bound) for bound in bounds if math.isfinite(bound))
    if kind is float:
        yield math.nan
    if parameter.choices:
        yield ''
    if parameter.read_only:
        yield parameter.default


@fault('parameters wrong at the start', setup=NO_BENCH)
def wrong_at_the_start(bench: Bench) -> None:
    """Ends with status 2 and one line that names what is wrong."""
    said = _start_all(bench)
    for (node, argument), (status, words) in zip(WRONG_ARGUMENTS, said, strict=True):
        expect(status == 2, f'{node} {argument}: exit status {status}')
        expect(words.count('\n') == 1, f'{node} {argument}: {words!r}')


@fault('parameters wrong at run time')
def wrong_at_run_time(bench: Bench) -> None:
    """Are refused with a reason and stay as they were; pushes on."""
    finger = bench.finger
    begin = time.monotonic()
    for node in NODES:
        name = finger.name(node.NAME)
        declared = PARAMETERS[node.NAME].declared()
        before = _values(bench, name, declared)
        for parameter in declared:
            for value in wrong_values(parameter):
                answer = bench.observer.set_parameter(name, parameter.name, value_of(value))
                expect(
                    not answer.successful and bool(answer.reason),
                    f'{node.NAME}: {parameter.name} = {value!r} was taken or refused in silence',
                )
        answer = bench.observer.set_parameter(name, 'nonsense', value_of(1.0))
        expect(not answer.successful, f'{node.NAME}: nonsense = 1.0 was taken')
        expect(
            _values(bench, name, declared) == before,
            f'{node.NAME}: something changed',
        )
    stops = finger.reasons_since(begin) - {''}
    expect(not stops, f'stopped: {", ".join(stops)}')
    finger.push()


@fault('largest gains')
def largest_gains(bench: Bench) -> None:
    """Keeps within the bounds on v_x and its change; pushes on with the gains before."""
    finger = bench.finger
    controller = finger.name('push_controller')
    usual = {'kp': 0.05, 'kd': 5.0}
    for gains in ({'kp': 100.0, 'kd': 1000.0}, usual):
        for name, value in gains.items():
            answer = bench.observer.set_parameter(controller, name, value_of(value))
            expect(answer.successful, f'{name} = {value}: {answer.reason}')
        bench.observer.spin(WILD if gains is not usual else 0.0)
    finger.push(10.0)


def _values(bench: Bench, node: str, parameters: tuple[Parameter, ...]) -> str:
    request = GetParameters.Request(names=[parameter.name for parameter in parameters])
    return str(bench.observer.ask(GetParameters, f'{node}/get_parameters', request).values)


def _start_all(bench: Bench) -> list[tuple[int, str]]:
    """Start a node with each wrong argument, two at a time; give exit status and words."""

    def start(case: tuple[str, str]) -> tuple[int, str]:
        node, argument = case
        module = f'tactile_push.nodes.{node}'
        done = subprocess.run(
            [sys.executable, '-m', module, '--ros-args', *argument.split()],
            env=bench.nodes.environment,
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
            timeout=START_TIMEOUT,
        )
        return done.returncode, done.stdout + done.stderr

    with ThreadPoolExecutor(AT_A_TIME) as pool:
        return list(pool.map(start, WRONG_ARGUMENTS))
