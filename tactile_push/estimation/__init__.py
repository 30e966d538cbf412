# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Active sensing: where on the object the finger is (Section III).

What needs compiled mathematics is imported when it is first asked for.
"""

import importlib
import typing

from tactile_push.estimation.finger_motion import FingerMotion
from tactile_push.estimation.translation import (
    bounds_of_translation,
    centre_on_ray,
    contact_of_translation,
    surface_direction,
    translates,
)

if typing.TYPE_CHECKING:
    from tactile_push.estimation.active_sensing import ActiveSensing
    from tactile_push.estimation.contact_estimator import ContactEstimator, Estimate, Quantity
    from tactile_push.estimation.contradictions import CONTRADICTIONS
    from tactile_push.estimation.disk_estimator import DiskEstimator
    from tactile_push.estimation.edges import Edge, edges_of
    from tactile_push.estimation.object_estimator import ObjectEstimate, ObjectEstimator
    from tactile_push.estimation.prior import Prior
    from tactile_push.estimation.rays import ParallelRaysError, Ray, intersect_rays
    from tactile_push.estimation.sensing_state import sensing_values, tells_pose

__all__ = [
    'CONTRADICTIONS',
    'ActiveSensing',
    'ContactEstimator',
    'DiskEstimator',
    'Edge',
    'Estimate',
    'FingerMotion',
    'ObjectEstimate',
    'ObjectEstimator',
    'ParallelRaysError',
    'Prior',
    'Quantity',
    'Ray',
    'bounds_of_translation',
    'centre_on_ray',
    'contact_of_translation',
    'edges_of',
    'intersect_rays',
    'sensing_values',
    'surface_direction',
    'tells_pose',
    'translates',
]

_COMPILED = {
    'active_sensing': ('ActiveSensing',),
    'contact_estimator': ('ContactEstimator', 'Estimate', 'Quantity'),
    'contradictions': ('CONTRADICTIONS',),
    'disk_estimator': ('DiskEstimator',),
    'edges': ('Edge', 'edges_of'),
    'object_estimator': ('ObjectEstimate', 'ObjectEstimator'),
    'prior': ('Prior',),
    'rays': ('ParallelRaysError', 'Ray', 'intersect_rays'),
    'sensing_state': ('sensing_values', 'tells_pose'),
}


def __getattr__(name: str) -> typing.Any:
    """Import one of the names that need compiled mathematics."""
    for module, names in _COMPILED.items():
        if name in names:
            value = getattr(importlib.import_module(f'{__name__}.{module}'), name)
            globals()[name] = value
            return value
    raise AttributeError(f'module {__name__!r} has no attribute {name!r}')
