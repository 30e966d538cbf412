# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""One finger's way from a reading to a command and an estimate, without ROS.

The live nodes, `tactile_push.replay` and `tactile_push.simulation.experiment` run the same steps:

`tactile`, `joint_states` -> `Geometry` -> contact -> `Control` -> command -> `Sensing` -> pose

`finger/cmd_vel`, `joint_states` -> `Servo` -> joint velocities, of a finger that takes those

A step takes a message as its stamp, names and positions, and returns what came of it; `outputs`
are the topics on which that is published, each with the fields of its message. `named` decides what
an odd message means. `Sensing` needs compiled mathematics and is imported when it is asked for.
"""

import importlib
import typing

from tactile_push.pipeline.control import Control, edge_angle
from tactile_push.pipeline.geometry import Felt, Geometry
from tactile_push.pipeline.messages import Fields, Output
from tactile_push.pipeline.named import by_name
from tactile_push.pipeline.servo import Moment, Servo
from tactile_push.pipeline.stamps import Seconds, Stamp

if typing.TYPE_CHECKING:
    from tactile_push.pipeline.sensing import Sensed, Sensing

__all__ = [
    'Control',
    'Felt',
    'Fields',
    'Geometry',
    'Moment',
    'Output',
    'Seconds',
    'Sensed',
    'Sensing',
    'Servo',
    'Stamp',
    'by_name',
    'edge_angle',
]


def __getattr__(name: str) -> typing.Any:
    """Import one of the names that need compiled mathematics."""
    if name in ('Sensed', 'Sensing'):
        value = getattr(importlib.import_module('tactile_push.pipeline.sensing'), name)
        globals()[name] = value
        return value
    raise AttributeError(f'module {__name__!r} has no attribute {name!r}')
