# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What is right, wrong or missing about a running finger, and what to do about it."""

from tactile_push.doctor.checks import findings
from tactile_push.doctor.finding import MISSING, RIGHT, WRONG, Finding
from tactile_push.doctor.snapshot import Endpoint, Heard, Snapshot

__all__ = [
    'MISSING',
    'RIGHT',
    'WRONG',
    'Endpoint',
    'Finding',
    'Heard',
    'Snapshot',
    'findings',
]
