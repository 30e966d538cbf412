# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""From what is known of an object to what the law that places believes."""

import math

from tactile_push.control.placing.law import Belief
from tactile_push.control.placing.learning import Spread
from tactile_push.control.placing.model import Pushed
from tactile_push.estimation import ObjectEstimate
from tactile_push.mechanics import friction_cone

NARROWEST = 1e-5  # standard deviation of d [m]; with 0 nothing could be learned


def belief_of(
    estimate: ObjectEstimate, x: float, turning: float, noise: float, reading: float
) -> Belief:
    """Return what is believed at a reading: the means under the most likely edge.

    Parameters
    ----------
    estimate : ObjectEstimate
        Of an object with edges, without a contradiction.
    x, turning : float
        Centre of the finger's disk across the belt [m], and by how much the tip turns there for
        each metre [rad/m].
    noise, reading : float
        Standard deviation of the readings of theta [rad], and the belt between two of them [m].

    Returns
    -------
    Belief
        What is believed.
    """
    known, edge = estimate.estimates[estimate.edge], estimate.edges[estimate.edge]
    cos_alpha, sin_alpha = friction_cone(known.mu_c.mean)
    pushed = Pushed(known.l, known.radius, known.pressure, cos_alpha, sin_alpha, turning, 0.0)
    theta_variance, d_variance = known.covariance[0, 0], known.covariance[1, 1]
    spread = Spread(
        math.sqrt(theta_variance),
        max(math.sqrt(max(d_variance, 0.0)), NARROWEST),
        math.log(known.c.upper / known.c.lower) / 4.0,  # a 95 % interval is four deviations wide
        noise,
        reading,
    )
    return Belief(x, known.theta, known.d.mean, pushed, edge.d, spread)
