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
"""The tactile sensor: from its bytes to a contact in the plane of motion (Section V.A)."""

from tactile_push.tactile.contact_finder import REFUSALS, ContactFinder
from tactile_push.tactile.finger import FingerPose, OutOfReachError, PlanarFinger, pole_angle
from tactile_push.tactile.hemisphere import (
    Contact,
    ReadingRejectedError,
    contact_of_reading,
    normalized_angle,
    reading_of_contact,
)
from tactile_push.tactile.jumps import JUMP_TOLERANCE, MAX_THETA_RATE, JumpGuard
from tactile_push.tactile.orientation import (
    covariance_in_space,
    quaternion_of_yaw,
    yaw_of_quaternion,
)
from tactile_push.tactile.pole_history import BELIEVED, PoleHistory
from tactile_push.tactile.reading import NO_CONTACT, Reading
from tactile_push.tactile.record import reading_values
from tactile_push.tactile.sentence import Sentence, SentenceError, checksum, decode, encode
from tactile_push.tactile.stream import SentenceStream

__all__ = [
    'BELIEVED',
    'JUMP_TOLERANCE',
    'MAX_THETA_RATE',
    'NO_CONTACT',
    'REFUSALS',
    'Contact',
    'ContactFinder',
    'FingerPose',
    'JumpGuard',
    'OutOfReachError',
    'PlanarFinger',
    'PoleHistory',
    'Reading',
    'ReadingRejectedError',
    'Sentence',
    'SentenceError',
    'SentenceStream',
    'checksum',
    'contact_of_reading',
    'covariance_in_space',
    'decode',
    'encode',
    'normalized_angle',
    'pole_angle',
    'quaternion_of_yaw',
    'reading_of_contact',
    'reading_values',
    'yaw_of_quaternion',
]
