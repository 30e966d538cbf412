# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The soak: hours of simulated time with random faults, and what must be true at the end."""
