# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Manipulation and active sensing by pushing with tactile feedback alone.

After K. M. Lynch, H. Maekawa and K. Tanie, IROS 1992.
"""
