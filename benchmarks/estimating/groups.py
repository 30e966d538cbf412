# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Kinds of experiments: what is pushed, what is sensed, what the estimator is told."""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from tactile_push.control import PushLaw, finger_velocity
from tactile_push.estimation import Edge, ObjectEstimator, edges_of
from tactile_push.mechanics import Outline, Slider, Support
from tactile_push.mechanics.compiled import Array
from tactile_push.simulation import Faults, Rig, RigConfig, Servo

STEPS = (10, 20, 60, 173, 400)
BELT_SPEED, PERIOD, RADIUS = 0.005, 0.1, 0.0135
C = (0.005, 0.036)
TENTH = 0.085  # standard deviation of l and r, as a share, that covers errors of a tenth


def rectangle(width: float, height: float) -> tuple[tuple[float, float], ...]:
    """Give the corners of a rectangle about its centre."""
    x, y = width / 2.0, height / 2.0
    return ((-x, -y), (x, -y), (x, y), (-x, y))


BLOCK = rectangle(0.05, 0.0475)
TRIANGLE = ((-0.03, -0.015), (0.04, -0.02), (-0.01, 0.035))  # about its centroid
HEXAGON = tuple((0.03 * math.cos(a), 0.03 * math.sin(a)) for a in np.arange(6) * math.pi / 3.0)


@dataclass(frozen=True)
class Group:
    """Experiments of one kind."""

    name: str
    mu_c: float = math.inf
    noise: float = math.radians(0.2)
    vertices: tuple[tuple[float, float], ...] = BLOCK
    c: tuple[float, float] = C
    support: Callable[[Outline], Support] | None = None
    lag: float = 0.0  # of the finger [s]
    commanded: bool = False  # whether the estimator gets commands and the lag, not the motion
    outlier: float = 0.0
    sticks: bool = False  # whether the prior knows that the contact sticks
    start: tuple[float, float] | None = None  # theta [rad] and d [m]; by chance without
    edge_known: bool = True  # else any edge is pushed, and the estimator does not know which
    l_error: float | None = None  # by how much l is wrong, either way, as a share
    r_error: float | None = None  # both by chance without, with the deviations that are told
    shares: float = 0.0  # standard deviations of l and r that it is told, as a share
    tilt: float = 0.0  # mu_s times the height of the push above the exact support [m]
    tilt_max: float = 0.0  # the greatest tilt that the estimator is told [m]
    rivals: bool = False  # whether the particle filter is tried, too

    @property
    def edges(self) -> tuple[Edge, ...]:
        """The edges that the estimator is told."""
        edges = edges_of(self.vertices)
        return edges[:1] if self.edge_known else edges

    def estimator(self) -> ObjectEstimator:
        """Give the estimator with all that it is told."""
        return ObjectEstimator(
            self.edges,
            self.noise,
            c=C,
            mu_c=(math.inf, math.inf) if self.sticks else (0.0, math.inf),
            l_share=self.shares,
            radius=RADIUS,
            radius_share=self.shares,
            outlier=max(self.outlier, 1e-3),
            tilt=self.tilt_max,
        )


def uniform(outline: Outline) -> Support:
    """Give uniform pressure, by 100 points."""
    return Support.uniform(outline, 100)


def rim(outline: Outline) -> Support:
    """Give all load on the rim, by 100 points."""
    return Support.rim(outline, 100)


FIGURE_8 = (math.radians(20.0), -0.006)
HALF_A_DEGREE = math.radians(0.5)
GROUPS = (
    Group('figure 8, sticks, 0.2°', sticks=True, start=FIGURE_8, rivals=True),
    Group('figure 8, sticks, 0.5°', noise=HALF_A_DEGREE, sticks=True, start=FIGURE_8),
    Group('figure 8, l and r uncertain', sticks=True, start=FIGURE_8, shares=TENTH),
    Group('sticks, 0.2°', sticks=True, rivals=True),
    Group('sticks, 0.5°', noise=HALF_A_DEGREE, sticks=True),
    *(Group(f'mu_c {mu_c:g}', mu_c) for mu_c in (0.0, 0.1, 0.2, 0.3, 0.5, 1.0, math.inf)),
    *(Group(f'noise {a:g}°', noise=math.radians(a)) for a in (0.1, 0.5, 1.0)),
    Group('c 0.5 to 1 cm', c=(0.005, 0.01)),
    Group('c 2.5 to 3.6 cm', c=(0.025, 0.036)),
    Group('wide, 8 x 4 cm', 0.5, vertices=rectangle(0.08, 0.04)),
    Group('deep, 4 x 6 cm', 0.5, vertices=rectangle(0.04, 0.06)),
    Group('triangle', 0.5, vertices=TRIANGLE),
    Group('hexagon', 0.5, vertices=HEXAGON),
    Group('exact corners', support=Support.corners),
    Group('exact rim', support=rim),
    Group('exact uniform', support=uniform),
    Group('exact corners, mu_c 0.3', 0.3, support=Support.corners),
    Group('exact uniform, mu_c 0.3', 0.3, support=uniform),
    Group('exact corners, mu_c 0', 0.0, support=Support.corners),
    Group('exact uniform, mu_c 0', 0.0, support=uniform),
    *(
        Group(
            f'{place}, mu_c {mu_c:g}, tilt {1e3 * tilt:g} of {1e3 * told:g} mm',
            mu_c,
            support=support,
            tilt=tilt,
            tilt_max=told,
            shares=TENTH,
        )
        for place, support in (('corners', Support.corners), ('uniform', uniform))
        for mu_c in (0.1, 0.5)
        for tilt, told in ((0.005, 0.0), (0.005, 0.008), (0.0, 0.008))
    ),
    Group('lag 0.1 s, measured', lag=0.1),
    Group('lag 0.3 s, known', lag=0.3, commanded=True),
    Group('outliers 1 %', outlier=0.01),
    Group('outliers 5 %', outlier=0.05),
    Group('l and r uncertain', shares=TENTH),
    Group('l wrong by 10 %, certain', l_error=0.1),
    Group('l wrong by 10 %, uncertain', l_error=0.1, shares=TENTH),
    Group('r wrong by 10 %, certain', r_error=0.1),
    Group('r wrong by 10 %, uncertain', r_error=0.1, shares=TENTH),
    Group('both wrong by 10 %, uncertain', 0.5, l_error=0.1, r_error=0.1, shares=TENTH),
    Group('any edge', edge_known=False, shares=TENTH),
    Group('any edge, 8 x 2 cm', vertices=rectangle(0.08, 0.02), edge_known=False, shares=TENTH),
    Group('any edge, triangle', 0.5, vertices=TRIANGLE, edge_known=False, shares=TENTH),
    Group(
        'any edge, exact uniform',
        0.5,
        vertices=rectangle(0.08, 0.02),
        support=uniform,
        edge_known=False,
        shares=TENTH,
    ),
)


@dataclass(frozen=True)
class Run:
    """One experiment, as long as finger and sensor can follow the contact on the pushed edge."""

    edge: int  # number of the pushed edge
    c: float
    reading: Array
    measured: Array  # the finger's mean velocity since the last reading [m/s]
    command: Array  # the same as commanded
    theta: Array
    d: Array
    phi: Array


def error_of(stated: float | None, share: float, rng: np.random.Generator) -> float:
    """Draw by how much l or r is wrong, within three standard deviations, as a share."""
    if stated is None:
        return share * float(np.clip(rng.standard_normal(), -3.0, 3.0))
    return float(rng.choice((-1.0, 1.0))) * stated


def experiment(group: Group, rng: np.random.Generator) -> Run:
    """Push an object that is drawn by chance, under the paper's law."""
    edges = edges_of(group.vertices)
    lengths = np.array([edge.length for edge in group.edges])
    edge = edges[int(rng.choice(len(lengths), p=lengths / lengths.sum()))]
    corners = np.roll(np.array(group.vertices), -edge.number, axis=0)
    turn = np.array([math.cos(edge.angle), math.sin(edge.angle)])
    # Its neighbours and the far side go with it, for the outline to stay convex.
    across = corners @ np.array([-turn[1], turn[0]])
    stretched = across * (1.0 + error_of(group.l_error, group.shares, rng))
    corners = corners + np.outer(stretched - across, (-turn[1], turn[0]))
    outline = Outline.polygon(corners)
    slider = Slider(outline, rng.uniform(*group.c))
    if group.support is not None:
        slider = Slider.on(outline, group.support(outline), exact=True, tilt=group.tilt)
    middle, half = sum(edge.d) / 2.0, edge.length / 2.0
    theta, d = rng.uniform(-0.4, 0.4), middle + rng.uniform(-0.8, 0.8) * half
    if group.start is not None:
        theta, d = group.start
    radius = RADIUS * (1.0 + error_of(group.r_error, group.shares, rng))
    rig = Rig(
        RigConfig(slider, group.mu_c, theta, d, radius=radius, tip_turns=False),
        Faults(servo=Servo(group.lag)),
    )
    law = PushLaw(0.05, 5.0, math.radians(-10.0))
    rows, x, command = [], 0.0, 0.0
    for _ in range(STEPS[-1] + 1):
        reading = rig.theta + group.noise * rng.standard_normal()
        if rng.random() < group.outlier:
            reading = rng.uniform(-math.pi / 2.0, math.pi / 2.0)
        rows.append((reading, (rig.finger_x - x) / PERIOD, command, rig.theta, rig.d, law.phi))
        x = rig.finger_x
        command = finger_velocity(law.update(reading), BELT_SPEED)
        rig.step(command, PERIOD)
        on_edge = rig.touching and 0.0 <= rig.sigma <= edge.length
        if not on_edge or abs(rig.theta) > math.pi / 2.0 or rig.at_workspace_limit:
            break
    return Run(edge.number, slider.c, *np.array(rows).T)
