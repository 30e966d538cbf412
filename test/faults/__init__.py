# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The fault table: real nodes, one fault after the other, and whether each promise is held."""

# isort: off
# The table has the rows in the order of these imports.
from . import process_rows, device_rows, topic_rows, parameter_rows, lifecycle_rows  # noqa: F401
from . import joint_rows, wrench_rows, camera_rows, clock_rows, pair_rows  # noqa: F401
from . import servo_rows, place_rows  # noqa: F401

# isort: on
from .promise import FAULTS

__all__ = ['FAULTS']
