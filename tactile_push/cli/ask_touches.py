# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Asks on the terminal for touches of a running sensor, and keeps them in a bag."""

import time
from collections.abc import Callable
from contextlib import closing
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any

from tactile_push.cli.arguments import Refused
from tactile_push.interface import (
    CAMERA,
    COMPRESSED_IMAGE_TYPE,
    IMAGE,
    IMAGE_TYPE,
    WRENCH,
    WRENCH_TYPE,
)
from tactile_push.needs_ros import ros_is_missing

if TYPE_CHECKING:
    from tactile_push.calibration.asking import Asking, Sense
    from tactile_push.recording.hearing import Hearing

PERIOD = 0.02  # between looks for keys and messages [s]
PATIENCE = 1.0  # without a message until the person is told [s]
END_OF_INPUT = '\x04'  # Ctrl-D
IMAGES, WRENCHES = 5, 1000  # that wait to be looked at; old images are of no use


def ask_touches(sensor: str, topic: str | None, threshold: float) -> Path:
    """Ask for touches until there are enough or the person ends it, and return their bag."""
    from tactile_push.calibration.asking import Asking
    from tactile_push.calibration.kept_touches import KeptTouches
    from tactile_push.playing.terminal import Terminal

    terminal = Terminal(lambda: None, lambda: None)
    if not terminal.answers:
        raise Refused('expected FOLDER|BAG, or a terminal on which to ask for touches')
    if ros_is_missing('tactile_push calibrate'):
        raise Refused('')
    from tactile_push.recording.hearing import Hearing

    camera = sensor == CAMERA
    types = (IMAGE_TYPE, COMPRESSED_IMAGE_TYPE) if camera else (WRENCH_TYPE,)
    name, depth = topic or (IMAGE if camera else WRENCH), IMAGES if camera else WRENCHES
    folder = Path(f'touches_{datetime.now():%Y_%m_%d-%H_%M_%S}')
    try:
        hearing = Hearing(name, types, depth)
    except ValueError as error:
        raise Refused(f'--topic: {error}') from None
    kept = KeptTouches(folder, hearing.topic, hearing.add_topic)
    with closing(terminal), closing(hearing), closing(kept):
        asking = Asking(_sense(camera, threshold), kept, terminal.say)
        terminal.say(f'each touch that you keep goes into {folder}')
        _ask(terminal, hearing, asking, _reader(hearing, camera))
    if not folder.exists():
        raise Refused('no touches', status=1)
    return folder


def _sense(camera: bool, threshold: float) -> 'Sense[Any]':
    if camera:
        from tactile_push.calibration.image_sense import ImageSense

        return ImageSense(threshold)
    from tactile_push.calibration.wrench_sense import WrenchSense

    return WrenchSense()


def _reader(hearing: 'Hearing', camera: bool) -> Callable[[Any], Any]:
    """Return a function that reads the content of a message."""
    if camera:
        from tactile_push.calibration.bag_images import image_of

        return lambda content: image_of(hearing.type_name, content)
    from tactile_push.calibration.bag_wrenches import wrench_of

    return wrench_of


def _ask(
    terminal: Any, hearing: 'Hearing', asking: 'Asking[Any, Any]', read: Callable[[Any], Any]
) -> None:
    from tactile_push.tactile import ReadingRejectedError

    heard = time.monotonic()
    while not asking.done:
        for key in terminal.read_keys():
            if key == END_OF_INPUT:
                raise Refused('keys: expected Enter, s, r or q, got the end of the input')
            asking.key(key)
        for message in hearing.take():
            heard = time.monotonic()
            if asking.listens:
                try:
                    value = read(hearing.content(message))
                except ReadingRejectedError as reason:
                    asking.trouble = str(reason)
                else:
                    asking.message(message.received * 1e-9, value, message)
        silent = time.monotonic() - heard > PATIENCE or not hearing.type_name
        trouble = f'no messages on {hearing.topic}' if silent else asking.trouble
        terminal.show(trouble or asking.line)
        time.sleep(PERIOD)
