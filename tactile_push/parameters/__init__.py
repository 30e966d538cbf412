# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What can be set, for nodes that run and for runs without nodes."""

from tactile_push.parameters.config_file import config_file
from tactile_push.parameters.parameter import Parameter, values_of

__all__ = ['Parameter', 'config_file', 'values_of']
