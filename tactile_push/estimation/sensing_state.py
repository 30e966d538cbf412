# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What active sensing knows after one control period, as numbers with names."""

import math

from tactile_push.estimation.active_sensing import ActiveSensing
from tactile_push.estimation.contradictions import CONTRADICTIONS
from tactile_push.estimation.object_estimator import ObjectEstimate


def sensing_values(estimate: ObjectEstimate, sensing: ActiveSensing) -> dict[str, float]:
    """Return all that is known after a control period by name.

    Parameters
    ----------
    estimate : ObjectEstimate
        What is known of the object.
    sensing : ActiveSensing
        The active sensing, after the control period.

    Returns
    -------
    dict of str to float
        The numbers by name, SI units. Unknown means are NaN; bounds are then the prior's.
    """
    known = sensing.readings > 0 and not estimate.contradiction
    values = {}
    for name in ('d', 'c', 'mu_c'):
        quantity = getattr(estimate, name)
        values[name] = quantity.mean if known else math.nan
        values[f'{name}_lower'], values[f'{name}_upper'] = quantity.lower, quantity.upper
        values[f'{name}_least'], values[f'{name}_most'] = quantity.least, quantity.most
    edge = estimate.edges[estimate.edge] if estimate.edges else None
    return {
        **values,
        'theta': estimate.theta,
        'edge': math.nan if edge is None else float(edge.number),
        'edge_weight': math.nan if edge is None else float(estimate.weights[estimate.edge]),
        'surprise': estimate.surprise,
        'contradiction': float(CONTRADICTIONS.index(estimate.contradiction)),
        'readings': float(sensing.readings),
        'age': sensing.age,
    }


def tells_pose(estimate: ObjectEstimate, sensing: ActiveSensing) -> bool:
    """Return whether a control period brought a new pose of the object.

    Parameters
    ----------
    estimate : ObjectEstimate
        What is known of the object.
    sensing : ActiveSensing
        The active sensing, after the control period.

    Returns
    -------
    bool
        Whether there was a reading and it agreed with the object.
    """
    return sensing.took and not estimate.contradiction
