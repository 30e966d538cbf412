# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The demonstrations: real nodes in processes of their own against a simulated plant."""
