# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Faults of a camera in the finger tip."""

from array import array
from collections.abc import Callable

import numpy as np
import numpy.typing as npt
from sensor_msgs.msg import Image

from tactile_push.interface import CAMERA, CAMERA_SENSOR, IMAGE

from .bench import Bench, spoiled_until_stopped
from .promise import SILENT, Setup, fault

SEEN = Setup(relay=IMAGE, sensor=CAMERA)


def _stops(bench: Bench, words: str, alter: Callable[[Image], Image | None]) -> None:
    spoiled_until_stopped(bench, CAMERA_SENSOR, words, alter)


def _repainted(
    message: Image, paint: Callable[[npt.NDArray[np.uint8]], npt.NDArray[np.generic]]
) -> Image:
    """Return the message with another picture."""
    old = np.frombuffer(message.data, np.uint8).reshape(message.height, message.width)
    new = np.clip(paint(old), 0, 255).astype(np.uint8)
    message.height, message.width = new.shape
    message.step = message.width
    message.data = array('B', new.tobytes())
    return message


@fault('camera silent', SILENT, setup=SEEN)
def camera_silent(bench: Bench) -> None:
    """Contact silent; ERROR; pushes on."""
    _stops(bench, 'no images', lambda message: None)


@fault('camera sends black', SILENT, setup=SEEN)
def camera_black(bench: Bench) -> None:
    """Contact silent; ERROR says why; pushes on."""
    _stops(bench, 'all pixels alike', lambda image: _repainted(image, lambda old: 0 * old))


@fault('lamp in the tip goes out', SILENT, setup=SEEN)
def lamp_out(bench: Bench) -> None:
    """Contact silent; ERROR says why; pushes on."""
    _stops(bench, 'dark', lambda image: _repainted(image, lambda old: 0.1 * old))


@fault('camera is blinded', SILENT, setup=SEEN)
def camera_blinded(bench: Bench) -> None:
    """Contact silent; ERROR says why; pushes on."""
    _stops(bench, 'saturated', lambda image: _repainted(image, lambda old: 5.0 * old + 150.0))


@fault('exposure changes', SILENT, setup=SEEN)
def exposure_changes(bench: Bench) -> None:
    """Contact silent; ERROR says why; pushes on."""
    _stops(bench, 'changed all over', lambda image: _repainted(image, lambda old: 1.4 * old))


@fault('images of another size', SILENT, setup=SEEN)
def images_of_another_size(bench: Bench) -> None:
    """Contact silent; ERROR says why; pushes on."""
    _stops(bench, 'another size', lambda image: _repainted(image, lambda old: old[::2, ::2]))


@fault('images turned by a right angle', SILENT, setup=SEEN)
def images_turned(bench: Bench) -> None:
    """Contact silent; ERROR says why; pushes on."""
    _stops(bench, 'another size', lambda image: _repainted(image, np.rot90))


@fault('camera hangs', SILENT, setup=SEEN)
def camera_hangs(bench: Bench) -> None:
    """Contact silent, as the same image comes again and again; ERROR says why; pushes on."""
    first: list[array[int]] = []

    def hang(message: Image) -> Image:
        if not first:
            first.append(message.data)
        message.data = first[0]
        return message

    _stops(bench, 'the same image again', hang)
