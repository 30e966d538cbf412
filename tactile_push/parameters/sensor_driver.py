# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The parameters of `sensor_driver`."""

from dataclasses import dataclass

from tactile_push.parameters import shared
from tactile_push.parameters.parameter import NodeParameters, parameter


@dataclass(frozen=True)
class SensorDriverParameters(NodeParameters):
    """Where the sensor is, and how long it may be silent."""

    # fmt: off
    device: str = parameter(shared.DEVICE, '',
        'where the sensor is: /dev/ttyUSB0, a pseudo terminal, socket://host:port, or any other '
        'URL of pyserial', read_only=True)
    baud_rate: int = parameter(115200, 'bit/s',
        'speed of a serial line', 50, 4000000, read_only=True)
    silence_timeout: float = parameter(0.3, 's',
        'this long without a reading is an error, by the steady clock', 0.01, 60.0)
    autostart: bool = shared.autostart
    # fmt: on
