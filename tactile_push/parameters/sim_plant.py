# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The parameters of `sim_plant`, and the simulated rig and faults that they describe."""

import math
import re
import typing
from dataclasses import dataclass

from tactile_push import paper
from tactile_push.interface import COMMANDS, JOINT_VELOCITIES, POINTS, VELOCITY
from tactile_push.parameters import shared
from tactile_push.parameters.parameter import NodeParameters, parameter
from tactile_push.tactile import PlanarFinger

if typing.TYPE_CHECKING:
    from tactile_push.mechanics import Outline
    from tactile_push.simulation import Faults, Mount, RigConfig

SIX_ZEROS = [0.0] * 6
POLYGON = 'polygon'


@dataclass(frozen=True)
class SimPlantParameters(NodeParameters):
    """The object and the start, the finger, the sensor and time; then faults, off by default."""

    # fmt: off
    device: str = parameter(shared.DEVICE, '',
        'where the sensor_driver will find the sensor: socket://host:port to listen on, or an '
        'absolute path for a pseudo terminal', read_only=True)
    object: str = parameter(paper.BLOCK, '',
        'what is pushed; a polygon is that of vertices, pushed at its first edge',
        choices=(paper.BLOCK, paper.DISK, POLYGON), read_only=True)
    vertices: list[float] = shared.vertices
    edge_length: float = parameter(paper.BLOCK_EDGE, 'm',
        'pushed edge of the block', 1e-3, 1.0, read_only=True)
    edge_to_cm: float = parameter(paper.BLOCK_L, 'm',
        'distance l from the pushed edge of the block to its centre of mass, half its depth',
        1e-3, 1.0, read_only=True)
    disk_radius: float = parameter(paper.DISK_RADIUS, 'm',
        'radius of the disk', 1e-3, 1.0, read_only=True)
    c: float = parameter(0.0, 'm',
        'm_max / f_max of the support of the object; 0 for a uniform support',
        0.0, 1.0, read_only=True)
    mu_c: float = parameter(math.inf, '',
        'friction between finger and object; may be .inf', 0.0, read_only=True)
    theta_initial: float = parameter(paper.THETA_INITIAL, 'rad',
        'angle of the edge at the start', -1.5, 1.5, read_only=True)
    d_initial: float = parameter(paper.D_INITIAL, 'm',
        'contact along the edge of a block or polygon at the start', -0.5, 0.5, read_only=True)
    belt_speed: float = shared.belt_speed
    finger_radius: float = shared.finger_radius
    proximal_length: float = shared.proximal_length
    distal_length: float = shared.distal_length
    mount_angle: float = shared.mount_angle
    tip_turns: bool = parameter(True, '',
        'the finger tip turns with the last link; otherwise wrist_joint, a third joint, holds it '
        'straight', read_only=True)
    commanded_point: str = shared.commanded_point
    commands: str = parameter(VELOCITY, '',
        'what moves the finger: velocity, that of finger/cmd_vel; or joint_velocities, those of '
        "the joints, as finger_servo gives them, which stay in force until others come",
        choices=COMMANDS, read_only=True)
    f_max: float = parameter(2.7, 'N',
        'force that moves the object straight on, by which the finger is pushed back',
        1e-3, 1e4, read_only=True)
    publish_wrench: bool = parameter(False, '',
        'publish what a force/torque sensor under the finger tip measures', read_only=True)
    tip_xyz: list[float] = shared.tip_xyz
    tip_rpy: list[float] = shared.tip_rpy
    publish_image: bool = parameter(False, '',
        'publish what a camera in the finger tip sees', read_only=True)
    image_noise: float = parameter(0.02, '',
        "standard deviation of a pixel's brightness, in parts of the brightest", 0.004, 1.0,
        read_only=True)
    untouched_images: int = parameter(50, '',
        'so many images that somebody hears show an untouched tip, for a reference', 0, 1000000,
        read_only=True)
    contact_lag: float = parameter(0.0, 's',
        'by how much the contact of a reading may be older than it, as with a sensor node that '
        'filters', 0.0, 1.0, read_only=True)
    sensor_rate: float = parameter(50.0, 'Hz', 'readings a second', 1.0, 1000.0, read_only=True)
    command_timeout: float = parameter(0.5, 's',
        'the finger stops after this long without a command, unless joint_velocities move it',
        0.01, 10.0, read_only=True)
    publish_clock: bool = parameter(False, '',
        'publish /clock, and let its time wait for contacts and commands', read_only=True)
    real_time_factor: float = parameter(1.0, 's/s',
        'largest speed of the time; other than 1 only with publish_clock',
        0.01, 100.0, read_only=True)
    control_rate: float = parameter(paper.CONTROL_RATE, 'Hz',
        'commands a second for which the published time waits', 0.1, 200.0, read_only=True)
    max_speed: float = parameter(0.1, 'm/s',
        'the finger goes no faster, whatever the command', 1e-4, 10.0)
    servo_time_constant: float = parameter(0.0, 's',
        'time constant of the lag with which the finger follows its command', 0.0, 10.0)
    servo_delay: float = parameter(0.0, 's',
        'time between a command and its first effect', 0.0, 10.0)
    servo_velocity_quantum: float = parameter(0.0, 'm/s',
        'the velocity of the finger is a whole multiple of this', 0.0, 1.0)
    lift_delay: float = parameter(0.0, 's',
        'time from place/release until the finger that it lifts has let go of the object',
        0.0, 5.0)
    workspace_min: float = parameter(-math.inf, 'm', 'least x of the finger in finger_base')
    workspace_max: float = parameter(math.inf, 'm', 'greatest x of the finger in finger_base')
    belt_ripple: float = parameter(0.0, '',
        "amplitude of the belt's uneven speed, relative to the speed", 0.0, 0.99)
    belt_ripple_frequency: float = parameter(1.0, 'Hz', 'frequency of belt_ripple', 0.01, 100.0)
    belt_stopped: bool = parameter(False, '', 'the belt stands')
    mu_c_ripple: float = parameter(0.0, '',
        'amplitude of an uneven mu_c, relative to mu_c', 0.0, 0.99)
    mu_c_ripple_length: float = parameter(0.005, 'm',
        'wavelength of mu_c_ripple along the edge', 1e-3, 1.0)
    sensor_noise: float = parameter(0.0, 'rad',
        "standard deviation of the noise of the contact's angle", 0.0, 1.6)
    sensor_bias: float = parameter(0.0, 'rad', "constant error of the contact's angle", -1.6, 1.6)
    sensor_quantum: float = parameter(0.0, 'rad', 'the angle is a whole multiple of this', 0.0, 1.6)
    sensor_latency: float = parameter(0.0, 's',
        'a reading comes out with the first one that is taken so much later', 0.0, 10.0)
    sensor_dropout: float = parameter(0.0, '', 'probability that a reading is lost', 0.0, 1.0)
    sensor_outlier: float = parameter(0.0, '',
        'probability that a reading is anywhere on the hemisphere', 0.0, 1.0)
    sensor_stuck: bool = parameter(False, '', 'the sensor sends its last value for ever')
    sensor_detectable_range: float = parameter(math.pi / 2.0, 'rad',
        'largest angle from the pole at which the sensor feels a contact', 0.0, math.pi / 2.0)
    wrench_noise: float = parameter(0.0, 'N',
        'standard deviation of the noise of each component of the force', 0.0, 1000.0)
    wrench_moment_noise: float = parameter(0.0, 'N m',
        'the same of the moment', 0.0, 1000.0)
    wrench_offset: list[float] = parameter(SIX_ZEROS, 'N, N m',
        'force and moment that the sensor tells without a contact')
    wrench_drift: list[float] = parameter(SIX_ZEROS, 'N/s, N m/s',
        'how fast that changes')
    seed: int = parameter(0, '',
        "seed of the sensor's random errors", 0, 2147483647, read_only=True)
    # fmt: on


FAULTS = tuple(
    declared
    for declared in SimPlantParameters.declared()
    if not declared.read_only and declared.name != 'max_speed'
)
NO_FAULTS_OF_THEIR_OWN = {'belt_ripple_frequency', 'mu_c_ripple_length'}


def faults_on(p: SimPlantParameters) -> list[str]:
    """Return the names of the parameters that switch a fault on."""
    return [
        fault.name
        for fault in FAULTS
        if fault.name not in NO_FAULTS_OF_THEIR_OWN and getattr(p, fault.name) != fault.default
    ]


def rig_config(p: SimPlantParameters) -> 'RigConfig':
    """Return the rig that the parameters describe; ValueError if there is no such rig."""
    from tactile_push.mechanics import Outline, Slider, Support  # which load the compiler
    from tactile_push.simulation import RigConfig

    if p.commands == JOINT_VELOCITIES and p.commanded_point != POINTS[0]:
        raise ValueError(
            f'parameter commanded_point: expected {POINTS[0]} with commands {JOINT_VELOCITIES}, '
            f'which command no point, got {p.commanded_point}'
        )
    if p.object == paper.BLOCK:
        outline, d = Outline.rectangle(p.edge_length, 2.0 * p.edge_to_cm), p.d_initial
    elif p.object == POLYGON:
        outline, d = _polygon(p.vertices), p.d_initial
    else:
        outline, d = Outline.circle(p.disk_radius), 0.0
    slider = Slider(outline, p.c or Support.uniform(outline).c)
    finger = PlanarFinger(p.proximal_length, p.distal_length, p.mount_angle)
    try:
        return RigConfig(
            *(slider, p.mu_c, p.theta_initial, d, p.belt_speed, p.finger_radius, finger),
            *(p.tip_turns, p.commanded_point, p.f_max),
        )
    except ValueError as error:
        raise ValueError(re.sub('^d:', 'parameter d_initial:', str(error))) from None


def _polygon(vertices: list[float]) -> 'Outline':
    """Return the outline about its centre of mass; ValueError if it is none."""
    from tactile_push.mechanics import Outline
    from tactile_push.mechanics.size import check_metres

    numbers = len(vertices)
    if numbers % 2 or numbers < 6:
        raise ValueError(
            f'parameter vertices: expected x and y of three corners or more, got {numbers} numbers'
        )
    try:
        outline = Outline.polygon(list(zip(vertices[::2], vertices[1::2], strict=True)))
        check_metres('vertices', outline)
        outline.about(0.0, 0.0)  # which refuses a centre of mass beside the object
    except ValueError as error:
        raise ValueError(f'parameter vertices: {str(error).removeprefix("vertices: ")}') from None
    return outline


def faults(p: SimPlantParameters) -> 'Faults':
    """Return the faults that the parameters describe; ValueError if they do not fit together."""
    from tactile_push.simulation import (
        Belt,
        Faults,
        ForceSensor,
        Sensor,
        Servo,
        UnevenFriction,
        Workspace,
    )

    if p.commands == JOINT_VELOCITIES and p.servo_velocity_quantum != 0.0:
        raise ValueError(
            f'parameter servo_velocity_quantum: expected 0.0 with commands {JOINT_VELOCITIES}, '
            f'got {p.servo_velocity_quantum}'
        )
    try:
        workspace = Workspace(p.workspace_min, p.workspace_max)
    except ValueError as error:
        raise ValueError(re.sub('^workspace:', 'parameter workspace_min:', str(error))) from None
    try:
        force_sensor = ForceSensor(
            *(p.wrench_noise, p.wrench_moment_noise),
            *(tuple(p.wrench_offset), tuple(p.wrench_drift)),
        )
    except ValueError as error:
        raise ValueError(f'parameter wrench_{error}') from None
    return Faults(
        Servo(p.servo_time_constant, p.servo_delay, p.servo_velocity_quantum, p.lift_delay),
        workspace,
        Belt(p.belt_ripple, p.belt_ripple_frequency, p.belt_stopped),
        UnevenFriction(p.mu_c_ripple, p.mu_c_ripple_length),
        Sensor(
            p.sensor_noise,
            p.sensor_bias,
            p.sensor_quantum,
            p.sensor_latency,
            p.sensor_dropout,
            p.sensor_outlier,
            p.sensor_stuck,
            p.sensor_detectable_range,
        ),
        force_sensor,
    )


def mount(p: SimPlantParameters) -> 'Mount':
    """Return how the tip sits on its force/torque sensor; ValueError if it cannot."""
    from tactile_push.simulation import Mount

    return Mount(p.finger_radius, tuple(p.tip_xyz), tuple(p.tip_rpy))
