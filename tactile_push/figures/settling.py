# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""How soon theta is at its angle by all that is known, and by law (18)."""

import math

import matplotlib.figure
import numpy as np

from tactile_push.control import PushLaw, settle_step
from tactile_push.figures.style import BLACK, BLUE, GREY, ONE_COLUMN, new_figure, styled
from tactile_push.paper import KD, KP, THETA_DESIRED, TOLERANCE
from tactile_push.simulation import Rollout, experiment, paper_block
from tactile_push.simulation.by_touch import LAG, faults_of
from tactile_push.simulation.settled_run import settled_run

STEPS = 300
NOISE = math.radians(0.2)


@styled
def settling_figure() -> matplotlib.figure.Figure:
    """Draw theta and phi of the block of figure 8 under law (18) and under the law that settles.

    The start, the limit surface and, for law (18), the gains of figure 8, through the rig with its
    finger, which lags by 0.1 s, and its sensor, which errs by 0.2 degrees. The law that settles is
    told the outline and which edge is pushed, and believes what active sensing finds of the rest.
    The band is 3 degrees about theta_d; the dotted lines are the steps from which theta stays
    within.

    The law that settles turns the block as fast as the bound of phi allows, 147 degrees, from step
    2 on and is there by step 24. Law (18) takes until step 192: it pushes the less the nearer theta
    is.

    Returns
    -------
    matplotlib.figure.Figure
        The figure, one column wide.
    """
    figure = new_figure(ONE_COLUMN, 3.8)
    upper, lower = figure.subplots(2, 1, sharex=True)
    wanted, band = math.degrees(THETA_DESIRED), math.degrees(TOLERANCE)
    upper.axhspan(wanted - band, wanted + band, color='0.92', zorder=0.0)
    step = np.arange(STEPS + 1)
    runs = {'law (18)': (_by_law_18(), BLACK), 'settle': (_settled(), BLUE)}
    for label, (run, color) in runs.items():
        upper.plot(step, np.degrees(run.theta), color=color, label=label)
        lower.plot(step, np.degrees(run.phi) - 90.0, color=color, linewidth=0.8)
        settled = settle_step(run.theta, THETA_DESIRED, TOLERANCE)
        if settled is not None:
            for axes in (upper, lower):
                axes.axvline(settled, color=color, linewidth=0.6, linestyle=':')
            upper.annotate(str(settled), (settled + 3.0, 17.0), color=color)
    upper.annotate(r'$\theta_d$', (294.0, -10.4), color=GREY, va='top', ha='right')
    upper.set_ylabel(r'$\theta$ [°]')
    lower.set_ylabel(r'$\phi - 90°$ [°]')
    lower.set(xlabel='step $k$ (0.1 s each)', xlim=(0, STEPS))
    upper.legend(loc='center right')
    return figure


def _by_law_18() -> Rollout:
    law = PushLaw(KP, KD, THETA_DESIRED)
    return experiment(paper_block(), law, STEPS, faults=faults_of(NOISE, LAG))


def _settled() -> Rollout:
    return settled_run(paper_block(), THETA_DESIRED, STEPS, noise=NOISE)
