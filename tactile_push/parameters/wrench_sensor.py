# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The parameters of `wrench_sensor`, and the reader that they make."""

import math
from dataclasses import dataclass

from tactile_push import paper
from tactile_push.parameters import shared
from tactile_push.parameters.parameter import NodeParameters, parameter
from tactile_push.tactile import WrenchSensing

USUAL = WrenchSensing(paper.FINGER_RADIUS, (0.0, 0.0, 0.02), (0.0, 0.0, 0.0))


@dataclass(frozen=True)
class WrenchSensorParameters(NodeParameters):
    """Where the tip is on the sensor, and which of its wrenches to believe."""

    # fmt: off
    tip_radius: float = parameter(USUAL.radius, 'm', 'radius of the hemispherical tip', 1e-4, 1.0)
    tip_xyz: list[float] = shared.tip_xyz
    tip_rpy: list[float] = shared.tip_rpy
    reaction: bool = parameter(USUAL.reaction, '',
        'wrenches are what the tip exerts; otherwise they are what acts on it')
    contact_force: float = parameter(USUAL.contact_force, 'N',
        'from this force on the tip touches', 1e-3, 1000.0)
    release_force: float = parameter(USUAL.release_force, 'N',
        'below this force it touches no more', 1e-3, 1000.0)
    filter_time_constant: float = parameter(USUAL.time_constant, 's',
        "time constant of the filter, by which a reading is older; its stamp says so; 0 for none",
        0.0, 1.0)
    max_torsion: float = parameter(USUAL.max_torsion, 'N m',
        'greatest moment that a contact may leave unexplained; a soft tip twists by some',
        1e-6, 10.0)
    max_gap: float = parameter(USUAL.max_gap, 's',
        'longest time between two wrenches; one that comes later is refused', 1e-3, 1.0)
    max_rate: float = parameter(USUAL.max_rate, 'Hz', 'readings a second at the most', 1.0, 1000.0)
    force_range: float = parameter(USUAL.force_range, 'N',
        'a component of this size is saturated', 1e-3, math.inf)
    moment_range: float = parameter(USUAL.moment_range, 'N m',
        'the same of the moment', 1e-6, math.inf)
    needs_tare: bool = parameter(True, '',
        'wrenches count only after a tare; false for a sensor that tares itself', read_only=True)
    tare_time: float = parameter(USUAL.tare_time, 's',
        'a tare is the mean of the last wrenches of so long', 0.05, 60.0)
    calibrated_frame: str = shared.calibrated_frame
    silence_timeout: float = parameter(0.3, 's',
        'this long without a wrench is an error, by the steady clock', 0.01, 60.0)
    autostart: bool = shared.autostart
    # fmt: on


def wrench_sensing(p: WrenchSensorParameters) -> WrenchSensing:
    """Return what to believe of wrenches; ValueError with a parameter's name if it cannot be."""
    try:
        return WrenchSensing(
            radius=p.tip_radius,
            xyz=tuple(p.tip_xyz),
            rpy=tuple(p.tip_rpy),
            reaction=p.reaction,
            contact_force=p.contact_force,
            release_force=p.release_force,
            time_constant=p.filter_time_constant,
            max_torsion=p.max_torsion,
            max_gap=p.max_gap,
            max_rate=p.max_rate,
            force_range=p.force_range,
            moment_range=p.moment_range,
            tare_time=p.tare_time,
            frame=p.calibrated_frame,
        )
    except ValueError as error:
        where, _, what = str(error).partition(': ')
        name = f'tip_{where}' if where in ('xyz', 'rpy') else where
        raise ValueError(f'{name}: {what}') from None
