# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The parameters of `sim_plant`, and what they describe."""

import math
from types import SimpleNamespace

from tactile_push.mechanics import Outline, Slider, Support
from tactile_push.parameters.finger import LINKS, make_finger
from tactile_push.parameters.parameter import Parameter
from tactile_push.simulation import (
    Belt,
    Faults,
    RigConfig,
    Sensor,
    Servo,
    UnevenFriction,
    Workspace,
)

RIG = (
    Parameter(
        'device',
        'socket://127.0.0.1:54320',
        '',
        'where the sensor_driver will find the sensor: socket://host:port to listen on, or '
        'an absolute path for a pseudo terminal',
        read_only=True,
    ),
    Parameter('object', 'block', '', 'what is pushed', choices=('block', 'disk'), read_only=True),
    Parameter('edge_length', 0.05, 'm', 'pushed edge of the block', 1e-3, 1.0, read_only=True),
    Parameter(
        'edge_to_cm',
        0.02375,
        'm',
        'distance l from the pushed edge of the block to its centre of mass, half its depth',
        1e-3,
        1.0,
        read_only=True,
    ),
    Parameter('disk_radius', 0.0285, 'm', 'radius of the disk', 1e-3, 1.0, read_only=True),
    Parameter(
        'c',
        0.0,
        'm',
        'm_max / f_max of the support of the object; 0 for a uniform support',
        0.0,
        1.0,
        read_only=True,
    ),
    Parameter(
        'mu_c',
        math.inf,
        '',
        'friction between finger and object, .inf too',
        0.0,
        read_only=True,
    ),
    Parameter(
        'theta_initial',
        0.3490658503988659,
        'rad',
        'angle of the edge at the start',
        -1.5,
        1.5,
        read_only=True,
    ),
    Parameter(
        'd_initial',
        -0.006,
        'm',
        'contact along the edge of the block at the start',
        -0.5,
        0.5,
        read_only=True,
    ),
    Parameter('belt_speed', 0.005, 'm/s', 'speed of the belt', 1e-5, 1.0, read_only=True),
    Parameter(
        'finger_radius',
        0.0135,
        'm',
        "effective radius of the finger's disk",
        1e-4,
        1.0,
        read_only=True,
    ),
    *LINKS,
    Parameter('sensor_rate', 50.0, 'Hz', 'readings a second', 1.0, 1000.0, read_only=True),
    Parameter(
        'command_timeout',
        0.5,
        's',
        'without a command for so long the finger stops',
        0.01,
        10.0,
        read_only=True,
    ),
    Parameter(
        'publish_clock',
        False,
        '',
        'own the time: publish /clock and let it wait for contacts and commands',
        read_only=True,
    ),
    Parameter(
        'real_time_factor',
        1.0,
        's/s',
        'how fast the time passes at the most; other than 1 only with publish_clock',
        0.01,
        100.0,
        read_only=True,
    ),
    Parameter(
        'control_rate',
        10.0,
        'Hz',
        'commands a second that the published time waits for',
        0.1,
        200.0,
        read_only=True,
    ),
)

SPEED_LIMIT = Parameter(
    'max_speed', 0.1, 'm/s', 'the finger goes no faster, whatever the command', 1e-4, 10.0
)
FAULTS = (
    Parameter(
        'servo_time_constant',
        0.0,
        's',
        'of the first-order lag by which the finger follows its command',
        0.0,
        10.0,
    ),
    Parameter('servo_delay', 0.0, 's', 'between a command and its first effect', 0.0, 10.0),
    Parameter(
        'servo_velocity_quantum', 0.0, 'm/s', 'velocities are whole multiples of it', 0.0, 1.0
    ),
    Parameter('workspace_min', -math.inf, 'm', 'the finger stops there, x in finger_base'),
    Parameter('workspace_max', math.inf, 'm', 'the finger stops there, x in finger_base'),
    Parameter(
        'belt_ripple',
        0.0,
        '',
        "amplitude of the belt's uneven speed, relative to the speed",
        0.0,
        0.99,
    ),
    Parameter('belt_ripple_frequency', 1.0, 'Hz', 'frequency of belt_ripple', 0.01, 100.0),
    Parameter('belt_stopped', False, '', 'the belt stands'),
    Parameter('mu_c_ripple', 0.0, '', 'amplitude of an uneven mu_c, relative to mu_c', 0.0, 0.99),
    Parameter(
        'mu_c_ripple_length', 0.005, 'm', 'wavelength of mu_c_ripple along the edge', 1e-3, 1.0
    ),
    Parameter(
        'sensor_noise',
        0.0,
        'rad',
        "standard deviation of the noise of the contact's angle",
        0.0,
        1.6,
    ),
    Parameter('sensor_bias', 0.0, 'rad', "constant error of the contact's angle", -1.6, 1.6),
    Parameter('sensor_quantum', 0.0, 'rad', 'the angle is a whole multiple of it', 0.0, 1.6),
    Parameter(
        'sensor_latency',
        0.0,
        's',
        'readings come out so much later, with the first reading after it',
        0.0,
        10.0,
    ),
    Parameter('sensor_dropout', 0.0, '', 'probability that a reading is lost', 0.0, 1.0),
    Parameter(
        'sensor_outlier',
        0.0,
        '',
        'probability that a reading is anywhere on the hemisphere',
        0.0,
        1.0,
    ),
    Parameter('sensor_stuck', False, '', 'the sensor sends its last value for ever'),
    Parameter(
        'sensor_detectable_range',
        1.5707963267948966,
        'rad',
        'largest angle from the pole at which the sensor feels a contact',
        0.0,
        1.5707963267948966,
    ),
)
SEED = Parameter(
    'seed', 0, '', 'of what chance decides about the sensor', 0, 2147483647, read_only=True
)
PARAMETERS = (*RIG, SPEED_LIMIT, *FAULTS, SEED)
NO_FAULTS_OF_THEIR_OWN = {'belt_ripple_frequency', 'mu_c_ripple_length'}


def rig_config(p: SimpleNamespace) -> RigConfig:
    """Give the rig that the parameters describe.

    Parameters
    ----------
    p : SimpleNamespace
        Their values.

    Returns
    -------
    RigConfig
        The rig.

    Raises
    ------
    ValueError
        If there is no such rig.
    """
    if p.object == 'block':
        outline = Outline.rectangle(p.edge_length, 2.0 * p.edge_to_cm)
        d = p.d_initial
    else:
        outline = Outline.circle(p.disk_radius)
        d = 0.0
    return RigConfig(
        Slider(outline, p.c or Support.uniform(outline).c),
        p.mu_c,
        p.theta_initial,
        d,
        p.belt_speed,
        p.finger_radius,
        make_finger(p),
    )


def faults(p: SimpleNamespace) -> Faults:
    """Give the faults that the parameters describe.

    Parameters
    ----------
    p : SimpleNamespace
        Their values.

    Returns
    -------
    Faults
        The faults.

    Raises
    ------
    ValueError
        If the values do not fit together.
    """
    return Faults(
        Servo(p.servo_time_constant, p.servo_delay, p.servo_velocity_quantum),
        Workspace(p.workspace_min, p.workspace_max),
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
    )


def faults_on(p: SimpleNamespace) -> list[str]:
    """Name the faults that are on.

    Parameters
    ----------
    p : SimpleNamespace
        Values of the parameters.

    Returns
    -------
    list of str
        The parameters that switch them on.
    """
    return [
        fault.name
        for fault in FAULTS
        if fault.name not in NO_FAULTS_OF_THEIR_OWN and getattr(p, fault.name) != fault.default
    ]
