# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Fuzzing: what comes from the device and what comes as messages, spoiled in every way."""
