# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Results of the demonstration that are made up."""

import numpy as np

from tactile_push.demo.turning import DISTANCES, RIGS, RigResult
from tactile_push.report.merit import push_figures


def result(name, known_step):
    """Return what comes out if theta settles exactly at step 192."""
    steps = np.arange(450.0)
    states = {
        'time': 0.1 * steps,
        'theta': RIGS[name].theta_desired + np.where(steps < 192, 0.1, 0.0),
        'theta_desired': np.full(450, RIGS[name].theta_desired),
        'phi': np.full(450, 1.44),
        'state': np.full(450, 2.0),
        'ticks_lost': np.zeros(450),
    }
    push = push_figures(states, RIGS[name].band, DISTANCES[name], name)
    return RigResult(push, -0.17, 1.44, 0.001, known_step, 10.0)


def results(known_step):
    """Return the results of both rigs."""
    return {'block': result('block', known_step), 'disk': result('disk', 0)}
