# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Read a topic of joint states as columns."""

import os

import numpy as np
import numpy.typing as npt

from tactile_push.bags.reader import BagReader
from tactile_push.bags.sources import BagError

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
