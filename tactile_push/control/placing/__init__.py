# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Placing: an object is brought to a place and an angle, and let go in passing.

docs/placing.md has the theory. What needs compiled mathematics is imported from its own module.
"""

from tactile_push.control.placing.stages import ENDS, REASONS, REFUSALS, STAGES, VERDICTS

__all__ = ['ENDS', 'REASONS', 'REFUSALS', 'STAGES', 'VERDICTS']
