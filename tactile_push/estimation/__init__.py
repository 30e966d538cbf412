# Copyright 2026 The tactile_push authors
#
# Licensed under the Apache License, Version 2.0 (the "License");
# you may not use this file except in compliance with the License.
# You may obtain a copy of the License at
#
#     http://www.apache.org/licenses/LICENSE-2.0
#
# Unless required by applicable law or agreed to in writing, software
# distributed under the License is distributed on an "AS IS" BASIS,
# WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
# See the License for the specific language governing permissions and
# limitations under the License.
"""Active sensing: where on the object the finger is (Section III).

What needs compiled mathematics is imported when it is first asked for.
"""

import importlib
import typing

from tactile_push.estimation.translation import (
    bounds_of_translation,
    centre_on_ray,
    contact_of_translation,
    translates,
)

if typing.TYPE_CHECKING:
    from tactile_push.estimation.contact_estimator import ContactEstimator, Estimate, Quantity
    from tactile_push.estimation.guaranteed import GuaranteedSet, ModelBounds
    from tactile_push.estimation.pose import object_pose
    from tactile_push.estimation.prior import Prior
    from tactile_push.estimation.rays import (
        Intersection,
        ParallelRaysError,
        Ray,
        intersect_rays,
    )

__all__ = [
    'ContactEstimator',
    'Estimate',
    'GuaranteedSet',
    'Intersection',
    'ModelBounds',
    'ParallelRaysError',
    'Prior',
    'Quantity',
    'Ray',
    'bounds_of_translation',
    'centre_on_ray',
    'contact_of_translation',
    'intersect_rays',
    'object_pose',
    'translates',
]

_COMPILED = {
    'ContactEstimator': 'contact_estimator',
    'Estimate': 'contact_estimator',
    'GuaranteedSet': 'guaranteed',
    'ModelBounds': 'guaranteed',
    'Prior': 'prior',
    'Quantity': 'contact_estimator',
    'Intersection': 'rays',
    'ParallelRaysError': 'rays',
    'Ray': 'rays',
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
