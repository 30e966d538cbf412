# Copyright 2026 The tactile_push authors
#
# Licensed under the Apache License, Version 2.0 (the "License");
# you may not use this file except in compliance with the License.
# You may obtain a copy of the License at
#
#     http://www.apache.org/licenses/LICENSE-2.0
#
# Unless required by applicable law or agreed to in writing, software
# distributed under the License is distributed on an "AS IS" BASIS,
# WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
# See the License for the specific language governing permissions and
# limitations under the License.
"""Runs a bag's messages through the nodes' code again, without nodes and without waiting."""

from tactile_push.replay.comparison import Comparison, ReplayedTick, SensedTick
from tactile_push.replay.estimate import estimate
from tactile_push.replay.object_history import ObjectFigures
from tactile_push.replay.replay import replay

__all__ = ['Comparison', 'ObjectFigures', 'ReplayedTick', 'SensedTick', 'estimate', 'replay']
