# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What happens to the rig, one episode after the other: another angle, and a fault for a while."""

import math
import random
from collections.abc import Iterator
from dataclasses import dataclass

from tactile_push.parameters.sim_plant import FAULTS

DESIRED = math.radians(10.0)  # the object is turned to either side
HOME = -0.06  # where the finger starts, in finger_base [m]
ASIDE = 0.02  # so far from there the object is turned so that the finger comes back [m]
BEFORE = (2.0, 20.0)  # from the new angle to the fault [s]
# Largest value and longest time of each fault [s]. A belt that stands and a sensor that is stuck
# cannot be told from an object that translates, and the finger would drift to its end.
MOST = {
    'servo_time_constant': (0.1, 20.0),
    'servo_delay': (0.05, 20.0),
    'servo_velocity_quantum': (0.0005, 20.0),
    'belt_ripple': (0.3, 20.0),
    'belt_stopped': (True, 2.0),
    'mu_c_ripple': (0.5, 20.0),
    'sensor_noise': (math.radians(0.5), 20.0),
    'sensor_bias': (math.radians(2.0), 20.0),
    'sensor_quantum': (math.radians(0.5), 20.0),
    'sensor_latency': (0.2, 20.0),
    'sensor_dropout': (1.0, 10.0),
    'sensor_outlier': (0.1, 20.0),
    'sensor_stuck': (True, 2.0),
}
DEFAULTS = {parameter.name: parameter.default for parameter in FAULTS}


@dataclass(frozen=True)
class Episode:
    """A fault of the plant for a while.

    Parameters
    ----------
    fault : str
        The parameter of `sim_plant`.
    value : float or bool
        Its value meanwhile.
    before, duration : float
        Time from the new angle to the fault, and of the fault [s].
    """

    fault: str
    value: float | bool
    before: float
    duration: float

    @property
    def default(self) -> float | bool:
        """The parameter's value otherwise."""
        return DEFAULTS[self.fault]


def episodes(draw: random.Random) -> Iterator[Episode]:
    """Yield episodes without end: every fault once, in any order, and again.

    Parameters
    ----------
    draw : random.Random
        Decides.

    Yields
    ------
    Episode
        The next one.
    """
    while True:
        for fault in draw.sample(sorted(MOST), len(MOST)):
            most, longest = MOST[fault]
            value = most if isinstance(most, bool) else most * draw.uniform(0.1, 1.0)
            yield Episode(fault, value, draw.uniform(*BEFORE), longest * draw.uniform(0.1, 1.0))


def next_desired(desired: float, finger_x: float) -> float:
    """Choose the side to which the object is turned next.

    Parameters
    ----------
    desired : float
        Its present desired angle [rad].
    finger_x : float
        Where the finger is, in `finger_base` [m].

    Returns
    -------
    float
        The other side, unless the finger has to come back: it drifts to the right where the
        desired angle is negative [rad].
    """
    if abs(finger_x - HOME) > ASIDE:
        return math.copysign(DESIRED, finger_x - HOME)
    return -desired
