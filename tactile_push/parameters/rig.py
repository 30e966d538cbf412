# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The simulated rig and its faults, as the parameters of `sim_plant` describe them."""

from tactile_push.mechanics import Outline, Slider, Support
from tactile_push.parameters.sim_plant import SimPlantParameters
from tactile_push.simulation import (
    Belt,
    Faults,
    RigConfig,
    Sensor,
    Servo,
    UnevenFriction,
    Workspace,
)
from tactile_push.tactile import PlanarFinger


def rig_config(p: SimPlantParameters) -> RigConfig:
    """Return the rig that the parameters describe; ValueError if there is no such rig."""
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
        PlanarFinger(p.proximal_length, p.distal_length, p.mount_angle),
    )


def faults(p: SimPlantParameters) -> Faults:
    """Return the faults that the parameters describe; ValueError if they do not fit together."""
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
