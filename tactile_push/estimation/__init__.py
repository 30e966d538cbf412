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
    translates,
)

if typing.TYPE_CHECKING:
    from tactile_push.estimation.active_sensing import ActiveSensing
    from tactile_push.estimation.bank import Liberties
    from tactile_push.estimation.contact_estimator import ContactEstimator, Estimate, Quantity
    from tactile_push.estimation.contradictions import CONTRADICTIONS
    from tactile_push.estimation.disk_estimator import DiskEstimator
    from tactile_push.estimation.edges import Edge, edges_of
    from tactile_push.estimation.guaranteed import GuaranteedSet, ModelBounds
    from tactile_push.estimation.object_estimator import ObjectEstimate, ObjectEstimator
    from tactile_push.estimation.pose import object_pose
    from tactile_push.estimation.prior import Prior
    from tactile_push.estimation.rays import (
        Intersection,
        ParallelRaysError,
        Ray,
        intersect_rays,
    )
    from tactile_push.estimation.sensing_state import sensing_values, tells_pose

__all__ = [
    'CONTRADICTIONS',
    'ActiveSensing',
    'ContactEstimator',
    'DiskEstimator',
    'Edge',
    'Estimate',
    'FingerMotion',
    'GuaranteedSet',
    'Intersection',
    'Liberties',
    'ModelBounds',
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
    'object_pose',
    'sensing_values',
    'tells_pose',
    'translates',
]

_COMPILED = {
    'ActiveSensing': 'active_sensing',
    'sensing_values': 'sensing_state',
    'tells_pose': 'sensing_state',
    'CONTRADICTIONS': 'contradictions',
    'ContactEstimator': 'contact_estimator',
    'DiskEstimator': 'disk_estimator',
    'Edge': 'edges',
    'Estimate': 'contact_estimator',
    'GuaranteedSet': 'guaranteed',
    'Liberties': 'bank',
    'ModelBounds': 'guaranteed',
    'ObjectEstimate': 'object_estimator',
    'ObjectEstimator': 'object_estimator',
    'Prior': 'prior',
    'Quantity': 'contact_estimator',
    'Intersection': 'rays',
    'ParallelRaysError': 'rays',
    'Ray': 'rays',
    'edges_of': 'edges',
    'intersect_rays': 'rays',
    'object_pose': 'pose',
}


def __getattr__(name: str) -> typing.Any:
    """Import one of the names that need compiled mathematics."""
    if name not in _COMPILED:
        raise AttributeError(f'module {__name__!r} has no attribute {name!r}')
    value = getattr(importlib.import_module(f'{__name__}.{_COMPILED[name]}'), name)
    globals()[name] = value
    return value
