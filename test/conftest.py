# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What the tests make in their own process talks on this machine alone, as the nodes do."""

import os

from tactile_push.testing.processes import loopback

os.environ.update(loopback())
