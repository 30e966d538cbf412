# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Runs a bag's messages through the nodes' code again, without nodes and without waiting."""

from tactile_push.replay.comparison import Comparison, ReplayedTick, SensedTick
from tactile_push.replay.estimate import estimate
from tactile_push.replay.object_history import ObjectFigures
from tactile_push.replay.replay import replay

__all__ = ['Comparison', 'ObjectFigures', 'ReplayedTick', 'SensedTick', 'estimate', 'replay']
