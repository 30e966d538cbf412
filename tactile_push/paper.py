# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What the paper tells of its real finger (Section V.C), to stand beside a bag's figures."""

import math
from dataclasses import dataclass

Range = tuple[float, float]


@dataclass(frozen=True)
class PaperFigures:
    """What the paper tells of a real finger.

    Parameters
    ----------
    figure : str
        Number of the figure.
    object : str
        The parameter `object` of `sim_plant` that stands for what was pushed.
    theta_desired, band : float
        Desired angle, and how near to it counts as settled [rad].
    settle_step : int
        Step after which it was so near.
    theta_range, phi_range : tuple of float, optional
        Least and greatest angle from step 400 on [rad].
    d_range : tuple of float, optional
        Bounds on d that follow by (17) [m].
    known_step : int, optional
        Step from which on they hold: before, the paper knows nothing of d.
    """

    figure: str
    object: str
    theta_desired: float
    band: float
    settle_step: int
    theta_range: Range | None = None
    phi_range: Range | None = None
    d_range: Range | None = None
    known_step: int | None = None


PAPER = (
    PaperFigures(
        '9',
        'block',
        math.radians(-10.0),
        math.radians(3.0),
        173,
        (math.radians(-10.4), math.radians(-8.9)),
        (math.radians(80.2), math.radians(85.8)),
        (0.0003, 0.0021),
        400,
    ),
    PaperFigures('10', 'disk', 0.0, math.radians(1.0), 110),
)


def paper_figures(theta_desired: float, pushed: str | None) -> PaperFigures | None:
    """Return what the paper has to compare with, if it has.

    Parameters
    ----------
    theta_desired : float
        Desired angle [rad].
    pushed : str or None
        What is pushed, if it is known: the parameter `object` of `sim_plant`.

    Returns
    -------
    PaperFigures or None
        Those of the figure of the same experiment.
    """
    for paper in PAPER:
        near = abs(theta_desired - paper.theta_desired) < math.radians(0.5)
        if near and pushed in (None, paper.object):
            return paper
    return None
