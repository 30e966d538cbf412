# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Every command and node in surroundings and with input that somebody else has made odd."""
