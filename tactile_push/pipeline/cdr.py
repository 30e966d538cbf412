# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Writes the messages of the package as CDR, without ROS and always with the same bytes.

Little endian, version 1 (OMG DDS-RTPS 10.2): each number begins at a multiple of its size after the
four bytes of encapsulation header. What lies between is 0; ROS leaves it as it finds it.
"""

import struct
from collections.abc import Mapping, Sequence

Stamp = tuple[int, int]  # [s, ns]

_LITTLE_ENDIAN = b'\x00\x01\x00\x00'


def encode_joint_state(stamp: Stamp, values: Mapping[str, float]) -> bytes:
    """Write a sensor_msgs/JointState that has names and positions only.

    Parameters
    ----------
    stamp : tuple of int
        Its time [s, ns].
    values : mapping of str to float
        Positions by name.

    Returns
    -------
    bytes
        The message.
    """
    body = _header(stamp, '')
    _align(body, 4)
    body += struct.pack('<I', len(values))
    for name in values:
        _add_string(body, name)
    _add_doubles(body, list(values.values()))
    body += struct.pack('<II', 0, 0)  # no velocity, no effort
    return _LITTLE_ENDIAN + body


def encode_pose(
    stamp: Stamp, frame: str, position: Sequence[float], turn: Sequence[float]
) -> bytes:
    """Write a geometry_msgs/PoseStamped.

    Parameters
    ----------
    stamp : tuple of int
        Its time [s, ns].
    frame : str
        Its frame.
    position : sequence of float, length 3
        x, y, z [m].
    turn : sequence of float, length 4
        Quaternion x, y, z, w.

    Returns
    -------
    bytes
        The message.
    """
    body = _header(stamp, frame)
    _align(body, 8)
    return _LITTLE_ENDIAN + body + struct.pack('<7d', *position, *turn)


def encode_unsure_pose(
    stamp: Stamp,
    frame: str,
    position: Sequence[float],
    turn: Sequence[float],
    covariance: Sequence[float],
) -> bytes:
    """Write a geometry_msgs/PoseWithCovarianceStamped.

    Parameters
    ----------
    stamp : tuple of int
        Its time [s, ns].
    frame : str
        Its frame.
    position : sequence of float, length 3
        x, y, z [m].
    turn : sequence of float, length 4
        Quaternion x, y, z, w.
    covariance : sequence of float, length 36
        Of x, y, z and the rotations about them, row by row.

    Returns
    -------
    bytes
        The message.
    """
    return encode_pose(stamp, frame, position, turn) + struct.pack('<36d', *covariance)


def encode_twist(stamp: Stamp, frame: str, v_x: float) -> bytes:
    """Write a geometry_msgs/TwistStamped along x.

    Parameters
    ----------
    stamp : tuple of int
        Its time [s, ns].
    frame : str
        Its frame.
    v_x : float
        Velocity [m/s].

    Returns
    -------
    bytes
        The message.
    """
    body = _header(stamp, frame)
    _align(body, 8)
    return _LITTLE_ENDIAN + body + struct.pack('<6d', v_x, 0.0, 0.0, 0.0, 0.0, 0.0)


def _header(stamp: Stamp, frame: str) -> bytearray:
    body = bytearray(struct.pack('<iI', *stamp))
    _add_string(body, frame)
    return body


def _add_string(body: bytearray, text: str) -> None:
    _align(body, 4)
    data = text.encode() + b'\0'
    body += struct.pack('<I', len(data)) + data


def _add_doubles(body: bytearray, values: Sequence[float]) -> None:
    _align(body, 4)
    body += struct.pack('<I', len(values))
    if values:
        _align(body, 8)
        body += struct.pack(f'<{len(values)}d', *values)


def _align(body: bytearray, size: int) -> None:
    body += bytes(-len(body) % size)
