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
"""Mechanics of a pushed object: Sections I and II of the paper."""

from tactile_push.mechanics.friction import (
    check_friction,
    friction_cone,
    translation_contacts,
    voted_rotation,
)
from tactile_push.mechanics.limit_surface import EllipsoidalLimitSurface
from tactile_push.mechanics.motion import (
    FREE,
    MODES,
    SLIP_LEFT,
    SLIP_RIGHT,
    STICK,
    contact_rates,
    contact_velocity,
    motion_cone,
    pushed_twist,
    slipping_twist,
    sticking_twist,
    twist_under_force,
)
from tactile_push.mechanics.outline import Disk, Edge, Outline, Pose
from tactile_push.mechanics.push import push, push_rates
from tactile_push.mechanics.support import c_points, c_uniform_circle, c_uniform_rectangle

__all__ = [
    'FREE',
    'MODES',
    'SLIP_LEFT',
    'SLIP_RIGHT',
    'STICK',
    'Disk',
    'Edge',
    'EllipsoidalLimitSurface',
    'Outline',
    'Pose',
    'c_points',
    'c_uniform_circle',
    'c_uniform_rectangle',
    'check_friction',
    'contact_rates',
    'contact_velocity',
    'friction_cone',
    'motion_cone',
    'push',
    'push_rates',
    'pushed_twist',
    'slipping_twist',
    'sticking_twist',
    'translation_contacts',
    'twist_under_force',
    'voted_rotation',
]
