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
"""Bags: MCAP files that `ros2 bag`, Foxglove, PlotJuggler and rosbags open.

Nothing here needs ROS but `tactile_push.bags.recorder`, which is therefore not imported here.
"""

from tactile_push.bags.definitions import schema_text
from tactile_push.bags.reader import BagError, BagReader, Message, Topic
from tactile_push.bags.writer import BagWriter

__all__ = ['BagError', 'BagReader', 'BagWriter', 'Message', 'Topic', 'schema_text']
