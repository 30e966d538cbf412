# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Waits for conditions that threads and processes bring about."""

import time

PATIENCE = 60.0  # a bound on hanging, not an expectation [s]


def wait_for(condition, what):
    """Return what the condition gives, once it holds."""
    deadline = time.monotonic() + PATIENCE
    while not (outcome := condition()):
        assert time.monotonic() < deadline, f'waited {PATIENCE:g} s in vain for {what}'
        time.sleep(0.01)
    return outcome
