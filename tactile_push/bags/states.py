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
from pathlib import Path

import numpy as np
import numpy.typing as npt
from mcap.reader import make_reader
from mcap_ros2.decoder import DecoderFactory


def read_states(bag: str | os.PathLike[str], topic: str) -> dict[str, npt.NDArray[np.float64]]:
    """Read the positions of a topic of type sensor_msgs/JointState.

    Parameters
    ----------
    bag : path
        Folder of the bag.
    topic : str
        Full name of the topic.

    Returns
    -------
    dict of str to ndarray, shape (N,)
        The positions by joint name, in the order of the bag, and 'stamp' [s] by header.
    """
    rows: list[tuple[float, ...]] = []
    names: list[str] = []
    for file in sorted(Path(bag).glob('*.mcap')):
        with file.open('rb') as stream:
            reader = make_reader(stream, decoder_factories=[DecoderFactory()])
            for _, _, _, state in reader.iter_decoded_messages(topics=[topic]):
                names = list(state.name)
                stamp = state.header.stamp
                rows.append((stamp.sec + stamp.nanosec * 1e-9, *state.position))
    columns = np.array(rows, dtype=float).reshape(len(rows), 1 + len(names)).T
    return dict(zip(['stamp', *names], columns, strict=True))
