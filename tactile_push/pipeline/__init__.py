# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""One finger's way from a reading to a command and an estimate, without ROS.

The live nodes, `tactile_push.replay` and `tactile_push.simulation.experiment` run the same steps:

`tactile`, `joint_states` -> `Geometry` -> contact -> `Control` -> command -> `Sensing` -> pose

A step takes a message as its stamp, names and positions, and returns what came of it; `outputs`
are the topics on which that is published, each with the fields of its message. `named` decides what
an odd message means.
"""

from tactile_push.pipeline.control import Control, edge_angle
from tactile_push.pipeline.geometry import Felt, Geometry
from tactile_push.pipeline.messages import Fields, Output
from tactile_push.pipeline.named import by_name
from tactile_push.pipeline.sensing import Sensed, Sensing
from tactile_push.pipeline.stamps import Seconds, Stamp

__all__ = [
    'Control',
    'Felt',
    'Fields',
    'Geometry',
    'Output',
    'Seconds',
    'Sensed',
    'Sensing',
    'Stamp',
    'by_name',
    'edge_angle',
]
