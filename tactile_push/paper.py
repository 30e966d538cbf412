# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The paper's objects, gains, tolerances and published figures, in SI units.

K. M. Lynch, H. Maekawa and K. Tanie, "Manipulation and active sensing by pushing using tactile
feedback", IROS 1992.
"""

import math
from collections.abc import Iterable
from dataclasses import dataclass

Range = tuple[float, float]

# The rig (Section V.A).
FINGER_RADIUS = 0.0135  # effective radius of the finger's disk [m]
BELT_SPEED = 0.005  # v_y [m/s]
CONTROL_RATE = 10.0  # [Hz]
CONTROL_PERIOD = 1.0 / CONTROL_RATE  # one step [s]
PHI_MIN, PHI_MAX = math.radians(33.0), math.radians(147.0)  # bounds of the law (18) [rad]

# The objects, named as the parameter `object` of `sim_plant` names them.
BLOCK, DISK = 'block', 'disk'
OTHER = 'other'  # an object that is known not to be one of them
BLOCK_EDGE, BLOCK_DEPTH = 0.05, 0.0475  # the pushed edge and the side that stands on it [m]
BLOCK_L = BLOCK_DEPTH / 2.0  # from the pushed edge to the centre of mass [m]
BLOCK_CORNERS = (
    (-BLOCK_EDGE / 2.0, -BLOCK_L),
    (BLOCK_EDGE / 2.0, -BLOCK_L),
    (BLOCK_EDGE / 2.0, BLOCK_L),
    (-BLOCK_EDGE / 2.0, BLOCK_L),
)  # from the centre of mass, counterclockwise from the pushed edge [m]
DISK_RADIUS = 0.0285  # also from the tangent to the centre of mass [m]
C_MAX, C_UNIFORM, C_MIN = 0.0345, 0.0187, 0.0067  # c of the block's supports, as printed [m]

# Open loop (fig. 7).
FIGURE_7_D = -0.005  # contact at the start [m]; theta starts at 0
FIGURE_7_PUSHES = 200

# The control law (fig. 8, Section V.B) and its gains [rad/rad].
KP, KD = 0.05, 5.0  # the best on the real finger
FIGURE_8_GAINS = ((0.02, 2.0), (KP, KD), (0.2, 10.0))
THETA_INITIAL, D_INITIAL = math.radians(20.0), -0.006  # at the start [rad], [m]
THETA_DESIRED = math.radians(-10.0)  # of the block [rad]

# The real finger (Section V.C).
TOLERANCE = math.radians(3.0)  # theta counts as settled this near to its desired value [rad]
DISK_TOLERANCE = math.radians(1.0)  # the same for the disk [rad]
TRANSLATING_STEP = 400  # the object translates from this step on: the ranges are read off there


@dataclass(frozen=True)
class PaperFigures:
    """What the paper publishes of an experiment with the real finger."""

    figure: str  #: its number
    object: str  #: what was pushed, as the parameter `object` of `sim_plant` names it
    theta_desired: float  #: desired angle of the edge [rad]
    band: float  #: how near to it counts as settled [rad]
    settle_step: int  #: step from which theta stays so near
    theta_range: Range | None = None  #: of theta from step `TRANSLATING_STEP` on [rad]
    phi_range: Range | None = None  #: of phi from there on [rad]
    d_range: Range | None = None  #: bounds on d that follow by (17) [m]
    known_step: int | None = None  #: from which they hold; the paper knows nothing of d before


FIGURE_9 = PaperFigures(
    '9',
    BLOCK,
    THETA_DESIRED,
    TOLERANCE,
    settle_step=173,
    theta_range=(math.radians(-10.4), math.radians(-8.9)),
    phi_range=(math.radians(80.2), math.radians(85.8)),
    d_range=(0.0003, 0.0021),
    known_step=TRANSLATING_STEP,
)
FIGURE_10 = PaperFigures('10', DISK, 0.0, DISK_TOLERANCE, settle_step=110)
PAPER = (FIGURE_9, FIGURE_10)


def paper_figures(theta_desired: float, pushed: str | None) -> PaperFigures | None:
    """Return what the paper publishes of the same experiment, None if it has no such one.

    `theta_desired` is the desired angle [rad], `pushed` is `BLOCK`, `DISK`, `OTHER` or, if it is
    not known, None.
    """
    for paper in PAPER:
        near = abs(theta_desired - paper.theta_desired) < math.radians(0.5)
        if near and pushed in (None, paper.object):
            return paper
    return None


def object_with(corners: Iterable[tuple[float, float]], disk_radius: float) -> str:
    """Return which object has these corners from its centre of mass [m], or this radius [m].

    A radius of 0 stands for an object with corners.
    """
    if disk_radius > 0.0:
        return DISK if math.isclose(disk_radius, DISK_RADIUS) else OTHER
    same = sorted(corners) == sorted(BLOCK_CORNERS)
    return BLOCK if same else OTHER
