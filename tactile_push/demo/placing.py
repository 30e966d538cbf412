# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Three objects are placed one after the other, by touch alone."""

import math
from collections.abc import Callable
from dataclasses import asdict, dataclass
from functools import partial
from pathlib import Path
from typing import Any

from tactile_push.bags import BagReader
from tactile_push.control.placing.stages import RELEASED
from tactile_push.demo.running import (
    Experiment,
    follow_experiment,
    keep_quiet,
    page_port,
    run_experiment,
)
from tactile_push.figures import plot_placed
from tactile_push.interface import (
    ACTIVE_SENSING,
    EXPERIMENT,
    PLACE,
    PLACE_STATE,
    PUSH_CONTROLLER,
    SENTENCE,
    SIM_PLANT,
    TRUE_POSE,
    TRUE_STATE,
)
from tactile_push.paper import BELT_SPEED, BLOCK, CONTROL_PERIOD
from tactile_push.parameters.recorded import recorded_parameters
from tactile_push.report.columns import read_tables, topics_of
from tactile_push.report.placings import Placing, placings, way_of
from tactile_push.report.pushed import plant_in
from tactile_push.report.scene import scene_of

# Where the centre of mass and the edge are to be, in `finger_base` [m, rad]: to the right of where
# the objects come, and turned three ways. Picked, far from the workspace's ends.
GOALS = (
    (-0.055, 0.0),
    (-0.052, math.radians(-10.0)),
    (-0.050, math.radians(10.0)),
)
# What the finger and its sensor are like: a lag [s] and noise of theta [rad], as of hardware.
LAG, NOISE = 0.1, math.radians(0.3)
FRICTION = 0.5  # between finger and object
SHARE = 0.01  # how well the outline is known: deviation of l, as a share of it
BELT = 0.3  # that there is for each object [m]
# That the goals take at the most.
PLACING_STEPS = len(GOALS) * round(BELT / BELT_SPEED / CONTROL_PERIOD)
NAME, PICTURE = 'placed', 'placed.png'  # of the bag and of the picture


@dataclass(frozen=True)
class PlacedResult:
    """What became of the goals; SI units."""

    goals: list[Placing]
    wall_seconds: float  # from the start of the processes to their end [s]

    @property
    def all_released(self) -> bool:
        """Whether an object was let go for every goal."""
        return len(self.goals) == len(GOALS) and all(one.stage == RELEASED for one in self.goals)

    def as_json(self) -> dict[str, Any]:
        """Return the result as plain values, SI units."""
        goals = [{**asdict(one), 'error': one.error} for one in self.goals]
        return {'goals': goals, 'wall_seconds': self.wall_seconds}


def run_placing(
    out: Path,
    progress: Callable[[int], None],
    plant: str = SIM_PLANT,
    sensor: str = SENTENCE,
    show: Callable[[str], None] = keep_quiet,
) -> PlacedResult:
    """Place objects at the goals, record that, draw it from above and return what became of it.

    The bag placed/ and the picture placed.png go to the folder `out` and replace those of an
    earlier demonstration. The arguments are those of `run_demo`, as are the errors.
    """
    out.mkdir(parents=True, exist_ok=True)
    bag = out / NAME
    lag = {'finger_lag': LAG}
    # What is known: the outline, that this plant pushes at the belt, and the noise of one sensor.
    known: dict[str, Any] = {'l_share': SHARE} | ({'tilt_max': 0.0} if plant == SIM_PLANT else {})
    known |= {'noise': NOISE} if sensor == SENTENCE else {}
    more: dict[str, dict[str, Any]] = {
        plant: {'mu_c': FRICTION, 'servo_time_constant': LAG, 'sensor_noise': NOISE},
        PUSH_CONTROLLER: {'law': PLACE, 'belt_length': BELT, **lag},
        ACTIVE_SENSING: {**known, **lag},
        EXPERIMENT: {'steps': 2 * PLACING_STEPS, 'goals': [f'{x} {theta}' for x, theta in GOALS]},
    }
    follow = partial(follow_experiment, progress=progress, show=show)
    what = Experiment(BLOCK, more, plant, sensor)
    wall_seconds = run_experiment(what, bag, page_port(), follow)
    with BagReader(bag) as reader:
        tables, _ = read_tables(reader, topics_of(reader, ''))
        parameters = recorded_parameters(reader.notes)[0] or {}
    truth, poses = tables.get(TRUE_STATE, {}), tables.get(TRUE_POSE, {})
    found = placings(tables.get(PLACE_STATE, {}), truth)
    scene = scene_of(parameters.get(plant_in('', parameters)), tables)
    ways = {
        _title(number, one): way
        for number, one in enumerate(found, 1)
        if (way := way_of(one, truth, poses, scene)) is not None
    }
    if ways:
        plot_placed(ways, [out / PICTURE])
    return PlacedResult(found, wall_seconds)


def _title(number: int, one: Placing) -> str:
    asked = f'goal {number}: {1e3 * one.x:.1f} mm, {math.degrees(one.theta):.1f}°'
    if one.error is None:
        return f'{asked}: {one.stage}'
    x, theta = one.error
    return f'{asked}: off by {1e3 * x:.2f} mm, {math.degrees(theta):.2f}°'
