# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Simulated pushes for the tests of estimators."""

import math
from dataclasses import dataclass

import numpy as np

from support.pushed_block import pushed
from tactile_push.control import PushLaw, finger_velocity
from tactile_push.mechanics import Outline, Slider
from tactile_push.simulation import Rig, RigConfig

NOISE = math.radians(0.2)
BELT = 0.005
PERIOD = 0.1
BLOCK = ((-0.025, -0.02375), (0.025, -0.02375), (0.025, 0.02375), (-0.025, 0.02375))
PLATE = ((-0.04, -0.01), (0.04, -0.01), (0.04, 0.01), (-0.04, 0.01))
TRIANGLE = ((-0.03, -0.015), (0.04, -0.02), (-0.01, 0.035))
RADIUS = 0.0135


@dataclass(frozen=True)
class Push:
    """The finger's motion up to a reading, and what is true then."""

    theta: float  # the reading
    v_x: float
    spin: float
    duration: float
    d: float
    x: float  # centre of mass from the finger's disk [m]
    y: float
    angle: float  # of the object [rad]


def rig_of(vertices, edge, theta, d, mu_c=math.inf, c=0.0187, tip_turns=False):
    """Push an edge of a polygon, numbered from its first corner."""
    corners = np.roll(np.array(vertices), -edge, axis=0)
    slider = Slider(Outline.polygon(corners), c)
    return Rig(RigConfig(slider, mu_c, theta, d, tip_turns=tip_turns))


def pushes(rig, steps, seed, noise=NOISE, belt_stops=None):
    """Let the paper's law push, as long as the contact is on the edge it starts on."""
    rng = np.random.default_rng(seed)
    law = PushLaw(0.05, 5.0, math.radians(-10.0))
    length = rig.config.slider.outline.pieces[0, 3]
    x, psi, made = 0.0, rig.psi, []
    for k in range(steps + 1):
        theta, pose = rig.theta + noise * rng.standard_normal(), rig.object_in_finger_disk
        v_x, x = (rig.finger_x - x) / PERIOD, rig.finger_x
        spin, psi = (rig.psi - psi) / PERIOD, rig.psi
        duration = PERIOD if k else 0.0
        made.append(Push(theta, v_x, spin, duration, rig.d, pose.x, pose.y, pose.angle))
        running = belt_stops is None or k < belt_stops
        rig.step(finger_velocity(law.update(theta), BELT), PERIOD, running)
        if not rig.touching or not 0.0 <= rig.sigma <= length:
            break
    return made


def pushes_by_a_tip(seed, steps=400, turn=0.0, stands_from=math.inf):
    """Let the law push the block with a tip that turns by `turn` [rad/m], of which nobody tells.

    From step `stands_from` on the object stands still.
    """
    rng = np.random.default_rng(seed)
    theta, d, c = rng.uniform((-0.35, -0.01, 0.012), (0.35, 0.01, 0.025))
    law, slider = PushLaw(0.05, 5.0, math.radians(-10.0)), Slider(Outline.polygon(BLOCK), c)
    v_x, made = 0.0, []
    for k in range(steps + 1):
        reading = theta + NOISE * rng.standard_normal()
        duration = PERIOD if k else 0.0
        made.append(Push(reading, v_x, 0.0, duration, d, math.nan, math.nan, theta))
        v_x = finger_velocity(law.update(reading), BELT)
        if k < stands_from:
            theta, d = pushed(slider, theta, d, math.inf, v_x, spin=turn * v_x)
        if abs(d) > BLOCK[1][0] - 0.001:
            break
    return made


def follow(estimator, made):
    """Give the estimates, one a push."""
    return [estimator.push(one.theta, one.v_x, BELT, one.duration, one.spin) for one in made]
