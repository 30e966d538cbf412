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
"""Time series of a bag's joint states, by name."""

import os

import numpy as np
import numpy.typing as npt

from tactile_push.bags.mcap_sources import BagError
from tactile_push.bags.reader import BagReader

_JOINT_STATE = 'sensor_msgs/msg/JointState'


def read_states(bag: str | os.PathLike[str], topic: str) -> dict[str, npt.NDArray[np.float64]]:
    """Read the positions of a topic of type sensor_msgs/JointState.

    Parameters
    ----------
    bag : path
        Folder of the bag, or its file.
    topic : str
        Full name of the topic.

    Returns
    -------
    dict of str to ndarray, shape (N,)
        The positions by joint name, in the order of the bag, and 'stamp' [s] by header.

    Raises
    ------
    BagError
        If the bag cannot be read, the topic has another type, or its names or their number
        change.
    """
    rows: list[tuple[float, ...]] = []
    names: list[str] = []
    with BagReader(bag) as reader:
        if topic in reader.topics and reader.topics[topic].type_name != _JOINT_STATE:
            raise BagError(
                f'{bag}: {topic} is of type {reader.topics[topic].type_name}, '
                f'expected {_JOINT_STATE}'
            )
        for message in reader.messages([topic]):
            state = reader.decode(message)
            if not rows:
                names = list(state.name)
            if list(state.name) != names or len(state.position) != len(names):
                raise BagError(
                    f'{bag}: {topic} has the names {state.name} and {len(state.position)} '
                    f'positions, expected as many of each and the names {names}'
                )
            stamp = state.header.stamp
            rows.append((stamp.sec + stamp.nanosec * 1e-9, *state.position))
    columns = np.array(rows, dtype=float).reshape(len(rows), 1 + len(names)).T
    return dict(zip(['stamp', *names], columns, strict=True))
