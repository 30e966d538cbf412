# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""From the numbers of `active_sensing/state` to what the law that places believes."""

import math
from collections.abc import Mapping, Sequence

import numpy as np

from tactile_push.control.placing.believing import Belief
from tactile_push.control.placing.learning import Spread
from tactile_push.control.placing.model import Pushed
from tactile_push.mechanics import friction_cone
from tactile_push.mechanics.resistance import Pressure
from tactile_push.mechanics.turning_tip import TurningTip

NARROWEST = 1e-5  # standard deviation of d [m]; with 0 nothing could be learned
LARGEST, LEAST = 1e3, 1e-12  # of what an object can be like, in units of SI; picked
FRICTION = ('mu_c', 'mu_c_lower', 'mu_c_upper')  # needed, and may be infinite
NEEDED = (  # finite
    *('theta', 'd', 'theta_deviation', 'd_deviation', 'log_c_deviation', 'l', 'radius'),
    *('c_squared', 'growth', 'shape', 'tilt', 'moment_along', 'moment_mixed', 'moment_across'),
    *('edge_start', 'edge_end', 'noise'),
)
LOWEST = {
    **dict.fromkeys(('l', 'radius', 'c_squared', 'noise'), LEAST),
    **dict.fromkeys(('theta_deviation', 'd_deviation', 'log_c_deviation'), 0.0),
}


def belief_of(
    values: Mapping[str, float], x: float, links: Sequence[float], reading: float
) -> Belief | None:
    """Return what is believed at a reading: the means under the most likely edge.

    Parameters
    ----------
    values : mapping of str to float
        Numbers of `active_sensing/state` by name.
    x : float
        Centre of the finger's disk across the belt [m].
    links : sequence of float
        The finger's links, as `Control.links`.
    reading : float
        Belt between two readings [m].

    Returns
    -------
    Belief or None
        What is believed; None if anything that it takes is not known, or like no object at all.
    """
    numbers = [*(values.get(name, math.nan) for name in NEEDED), x, *links]
    known = all(values.get(name, math.nan) >= 0.0 for name in FRICTION)
    if not (known and all(abs(number) <= LARGEST for number in numbers)):  # which NaN is not
        return None
    if any(values[name] < lowest for name, lowest in LOWEST.items()):
        return None
    cos_alpha, sin_alpha = friction_cone(values['mu_c'])
    moments = np.array([values[f'moment_{way}'] for way in ('along', 'mixed', 'across')])
    pressure = Pressure(
        *(values['c_squared'], values['growth'], values['shape'], moments, values['tilt'])
    )
    tip = TurningTip(*links)
    pushed = Pushed(*(values['l'], values['radius'], pressure, cos_alpha, sin_alpha, tip, 0.0))
    spread = Spread(
        values['theta_deviation'],
        max(values['d_deviation'], NARROWEST),
        values['log_c_deviation'],
        values['noise'],
        reading,
    )
    ends = values['edge_start'], values['edge_end']
    friction = values['mu_c_lower'], values['mu_c_upper']
    return Belief(x, values['theta'], values['d'], pushed, friction, ends, spread)
