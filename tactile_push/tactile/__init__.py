# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""From a reading of the tactile sensor to a contact in the plane of motion (Section V.A)."""

from tactile_push.tactile.contact_finder import REFUSALS, ContactFinder
from tactile_push.tactile.hemisphere import (
    Contact,
    ReadingRejectedError,
    contact_of_reading,
    reading_of_contact,
)
from tactile_push.tactile.jumps import JUMP_TOLERANCE, MAX_THETA_RATE
from tactile_push.tactile.linear_axis import LinearAxis
from tactile_push.tactile.planar_finger import FingerPose, OutOfReachError, PlanarFinger
from tactile_push.tactile.reading import NO_CONTACT, NotUntouchedError, Reading
from tactile_push.tactile.reading_state import reading_values
from tactile_push.tactile.wrench import WrenchContact, angle_noise, contact_of_wrench
from tactile_push.tactile.wrench_reader import (
    WRENCH_REFUSALS,
    Touch,
    WrenchReader,
    WrenchSensing,
)

__all__ = [
    'JUMP_TOLERANCE',
    'MAX_THETA_RATE',
    'NO_CONTACT',
    'REFUSALS',
    'WRENCH_REFUSALS',
    'Contact',
    'ContactFinder',
    'FingerPose',
    'LinearAxis',
    'NotUntouchedError',
    'OutOfReachError',
    'PlanarFinger',
    'Reading',
    'ReadingRejectedError',
    'Touch',
    'WrenchContact',
    'WrenchReader',
    'WrenchSensing',
    'angle_noise',
    'contact_of_reading',
    'contact_of_wrench',
    'reading_of_contact',
    'reading_values',
]
