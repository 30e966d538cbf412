# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The estimator, as the parameters of `active_sensing` describe the object."""

import numpy as np

from tactile_push.estimation import (
    ActiveSensing,
    DiskEstimator,
    FingerMotion,
    ObjectEstimator,
    edges_of,
)
from tactile_push.parameters.active_sensing import ActiveSensingParameters


def make_sensing(p: ActiveSensingParameters) -> ActiveSensing:
    """Make active sensing that knows nothing yet.

    Raises
    ------
    ValueError
        If the outline is none, has no such edge, or if a range is empty.
    """
    for name in ('c', 'mu_c'):
        low, high = getattr(p, f'{name}_min'), getattr(p, f'{name}_max')
        if not (low < high or (name == 'mu_c' and low == high)):
            raise ValueError(f'{name}_max: expected more than {name}_min = {low:g}, got {high:g}')
    estimator: ObjectEstimator | DiskEstimator
    if p.disk_radius > 0.0:
        estimator = DiskEstimator(p.disk_radius, p.noise, radius=p.finger_radius)
    else:
        edges = edges_of(_points(p.vertices))
        if p.edge >= len(edges):
            raise ValueError(f'edge: expected -1 to {len(edges) - 1}, got {p.edge}')
        if p.edge >= 0:
            edges = edges[p.edge : p.edge + 1]
        estimator = ObjectEstimator(
            edges,
            p.noise,
            c=(p.c_min, p.c_max),
            mu_c=(p.mu_c_min, p.mu_c_max),
            l_share=p.l_share,
            radius=p.finger_radius,
        )
    motion = FingerMotion(p.finger_lag, p.finger_delay)
    return ActiveSensing(estimator, motion, p.belt_speed, p.contact_timeout)


def _points(vertices: list[float]) -> np.ndarray:
    if len(vertices) % 2 or len(vertices) < 6:
        raise ValueError(
            f'vertices: expected x and y of three corners or more, got {len(vertices)} numbers'
        )
    return np.array(vertices).reshape(-1, 2)
