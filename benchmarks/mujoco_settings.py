# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""How well the rig in MuJoCo agrees with the exact surface, and what its settings are good for.

    python benchmarks/mujoco_settings.py

A tip held straight by a wrist pushes, under the paper's law and without noise, at the belt's height
or above it. The package's own rig simulates the same on the exact surface of the same feet, which
tilts by mu_s h under a push at the height h. Of each setting: the largest differences of theta and
d over 400 control periods, and the share of a core that the rig in MuJoCo takes in real time.
"""

import math
import time
from contextlib import nullcontext
from dataclasses import dataclass
from typing import Any
from unittest.mock import patch

from rich.console import Console
from rich.progress import track
from rich.table import Table

from tactile_push import paper
from tactile_push.control import PushLaw, finger_velocity
from tactile_push.mechanics import Outline, Slider, Support
from tactile_push.simulation import Rig, RigConfig, mujoco_model, mujoco_rig
from tactile_push.simulation.mujoco_model import MujocoPhysics
from tactile_push.simulation.mujoco_rig import MujocoRig

STEPS, PERIOD = 400, paper.CONTROL_PERIOD
MU_S, MASS, HEIGHT = 0.3, 0.93, 0.05
BLOCK = Outline.rectangle(paper.BLOCK_EDGE, paper.BLOCK_DEPTH)
DISK = Outline.circle(paper.DISK_RADIUS)


@dataclass(frozen=True)
class Case:
    """An object on feet."""

    name: str
    outline: Outline
    support: Support
    mu_c: float
    height: float = 0.0  # of the push above the belt [m]


CASES = (
    Case('block on corners, mu_c 0.5', BLOCK, Support.corners(BLOCK), 0.5),
    Case('block on corners, mu_c 0.1', BLOCK, Support.corners(BLOCK), 0.1),
    Case('block on 36 feet, mu_c 0.5', BLOCK, Support.uniform(BLOCK, 36), 0.5),
    Case('block on 36 feet, mu_c 0.1, 16 mm', BLOCK, Support.uniform(BLOCK, 36), 0.1, 0.016),
    Case('disk on its rim, mu_c 0.3, 16 mm', DISK, Support.rim(DISK, 36), 0.3, 0.016),
)
SETTINGS: dict[str, dict[str, float]] = {
    'as they are': {},
    'time step 0.5 ms': {'TIME_STEP': 5e-4},
    'time step 2 ms': {'TIME_STEP': 2e-3},
    'feet that sink by 5 um': {'SAG': 5e-6},
    'feet that sink by 500 um': {'SAG': 5e-4},
    'impratio 1 (by default)': {'IMPRATIO': 1.0},
    'impratio 100': {'IMPRATIO': 100.0},
    'softness 0.1': {'SOFTNESS': 0.1},
    'tolerance 1e-8 (by default)': {'TOLERANCE': 1e-8},
}


def difference(case: Case, settings: dict[str, float]) -> tuple[float, float, float]:
    """Give the largest differences of theta [deg] and d [mm], and the share of a core."""
    slider = Slider.on(case.outline, case.support, exact=True, tilt=MU_S * case.height)
    d = paper.D_INITIAL if case.outline is BLOCK else 0.0
    config = RigConfig(slider, case.mu_c, paper.THETA_INITIAL, d, tip_turns=False)
    physics = MujocoPhysics(case.support, MU_S, MASS, HEIGHT, case.height)
    own, own_law = Rig(config), PushLaw(paper.KP, paper.KD, paper.THETA_DESIRED)
    theta = d = spent = 0.0
    with patched(settings):
        rig, law = MujocoRig(config, physics), PushLaw(paper.KP, paper.KD, paper.THETA_DESIRED)
        for _ in range(STEPS):
            own.step(finger_velocity(own_law.update(own.theta), config.belt_speed), PERIOD)
            v_x = finger_velocity(law.update(rig.theta), config.belt_speed)
            start = time.process_time()
            rig.step(v_x, PERIOD)
            spent += time.process_time() - start
            theta = max(theta, abs(math.degrees(rig.theta - own.theta)))
            d = max(d, 1e3 * abs(rig.d - own.d)) if rig.touching else math.inf
    return theta, d, spent / (STEPS * PERIOD)


def patched(settings: dict[str, float]) -> Any:
    """Give a context in which the settings are others."""
    if 'TIME_STEP' in settings:
        return patch.object(mujoco_rig, 'TIME_STEP', settings['TIME_STEP'])
    return patch.multiple(mujoco_model, **settings) if settings else nullcontext()


def main() -> None:
    """Print the table."""
    table = Table('settings', *(case.name for case in CASES))
    for name, settings in track(SETTINGS.items(), console=Console(stderr=True), transient=True):
        cells = []
        for case in CASES:
            theta, d, share = difference(case, settings)
            apart = f'{theta:.3f}°, {d:.3f} mm' if math.isfinite(d) else 'loses the object'
            cells.append(f'{apart}, {100.0 * share:.1f} %')
        table.add_row(name, *cells)
    Console(width=170).print(table)


if __name__ == '__main__':
    main()
