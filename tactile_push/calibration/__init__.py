# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""From touches at known places of the tip to the parameters of the sensor's node."""
