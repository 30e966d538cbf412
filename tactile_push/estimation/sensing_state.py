# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What active sensing knows after one control period, as numbers with names."""

import math

from tactile_push.estimation.active_sensing import ActiveSensing
from tactile_push.estimation.contradictions import CONTRADICTIONS
from tactile_push.estimation.object_estimator import ObjectEstimate

# What is told of the likeliest edge.
OF_EDGE = (
    *('theta_deviation', 'd_deviation', 'log_c_deviation', 'l', 'radius'),
    *('c_squared', 'growth', 'shape', 'tilt'),
    *('moment_along', 'moment_mixed', 'moment_across', 'edge_start', 'edge_end'),
)


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
        **_belief_values(estimate, known),
        'noise': sensing.noise,
    }


def _belief_values(estimate: ObjectEstimate, known: bool) -> dict[str, float]:
    """Return what it takes to plan pushes at the likeliest edge; NaN for what is not known."""
    if not estimate.edges:
        return dict.fromkeys(OF_EDGE, math.nan)
    one, (start, end) = estimate.estimates[estimate.edge], estimate.edges[estimate.edge].d
    theta_variance, d_variance = one.covariance[0, 0], one.covariance[1, 1]
    pressure = one.pressure
    values = (
        math.sqrt(max(theta_variance, 0.0)),
        math.sqrt(max(d_variance, 0.0)),
        math.log(one.c.upper / one.c.lower) / 4.0,  # a 95 % interval is four deviations wide
        *(one.l, one.radius),
        *(pressure.c_squared, pressure.growth, pressure.shape, pressure.tilt),
        *map(float, pressure.moments),
    )
    told = values if known else (math.nan,) * len(values)
    return dict(zip(OF_EDGE, (*told, start, end), strict=True))


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
