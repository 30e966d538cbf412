# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Mechanics of a pushed object: Sections I and II of the paper."""

from tactile_push.mechanics import numba_settings  # noqa: F401, before numba itself

# isort: split
from tactile_push.mechanics.body import Body, Finger, Pose
from tactile_push.mechanics.commanded_point import CENTRE, CONTACT, POLE, added_way
from tactile_push.mechanics.contact import clearance, contact, tangent_angle
from tactile_push.mechanics.exact_motion import exact_pushed_twist
from tactile_push.mechanics.friction import (
    check_friction,
    friction_cone,
    translation_contacts,
    voted_rotation,
)
from tactile_push.mechanics.limit_surface import (
    EllipsoidalLimitSurface,
    ExactLimitSurface,
    LimitSurface,
)
from tactile_push.mechanics.motion import (
    FREE,
    MODES,
    SLIP_LEFT,
    SLIP_RIGHT,
    STICK,
    contact_mode,
    contact_velocity,
    motion_cone,
    pushed_twist,
    slipping_twist,
    sticking_twist,
    twist_under_force,
)
from tactile_push.mechanics.outline import Outline
from tactile_push.mechanics.push import move_finger, push, push_rates
from tactile_push.mechanics.slider import Slider
from tactile_push.mechanics.support import Support

__all__ = [
    'CENTRE',
    'CONTACT',
    'FREE',
    'MODES',
    'POLE',
    'SLIP_LEFT',
    'SLIP_RIGHT',
    'STICK',
    'Body',
    'EllipsoidalLimitSurface',
    'ExactLimitSurface',
    'Finger',
    'LimitSurface',
    'Outline',
    'Pose',
    'Slider',
    'Support',
    'added_way',
    'check_friction',
    'clearance',
    'contact',
    'contact_mode',
    'contact_velocity',
    'exact_pushed_twist',
    'friction_cone',
    'motion_cone',
    'move_finger',
    'push',
    'push_rates',
    'pushed_twist',
    'slipping_twist',
    'sticking_twist',
    'tangent_angle',
    'translation_contacts',
    'twist_under_force',
    'voted_rotation',
]
