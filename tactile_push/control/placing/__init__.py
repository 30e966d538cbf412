# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Placing: an object is brought to a place and an angle, and let go in passing.

docs/placing.md has the theory.
"""
