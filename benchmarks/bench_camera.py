# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""How fast a contact is found in images of 640 x 480 pixels on one core: `make bench`."""

import math
import time
from array import array

import cv2
import numpy as np
import pytest

from tactile_push.pipeline.images import Images
from tactile_push.simulation.dome_image import DomeImages, DomeView
from tactile_push.tactile import NO_CONTACT, Reading
from tactile_push.tactile.dome_camera import DomeCamera
from tactile_push.tactile.image_contact import (
    IMAGES_OF_REFERENCE,
    ImageContactFinder,
    ImageContactSettings,
)

GOAL = 60.0  # images a second
VIEW = DomeView(focal_length=260.0, dead=0.05)
CAMERA = DomeCamera(
    *(VIEW.width, VIEW.height, (319.5, 239.5), (math.pi, 0.0, 0.0)),
    *((260.0, -10.0, 0.0), (0.0, 0.0, -1.0)),
)


def raw(image):
    """Return what `image` has of a picture, as rclpy has it."""
    height, width = image.shape
    return '', 'mono8', height, width, width, array('B', image.tobytes())


def coloured(image):
    """Return the same in colours."""
    height, width = image.shape
    data = np.repeat(image[..., None], 3, axis=2)
    return '', 'rgb8', height, width, 3 * width, array('B', data.tobytes())


def compressed(image):
    """Return the same as JPEG."""
    return '', array('B', cv2.imencode('.jpg', image)[1].tobytes())


@pytest.mark.parametrize('kind', [raw, coloured, compressed])
@pytest.mark.parametrize('touched', [False, True])
def test_contact_is_found_sixty_times_a_second(benchmark, kind, touched):
    """Take images one after the other, from the message's bytes to the reading's fields."""
    threads = cv2.getNumThreads()
    cv2.setNumThreads(1)
    dome = DomeImages(VIEW)
    finder = ImageContactFinder(CAMERA, ImageContactSettings())
    step = Images(finder, lambda sec, nanosec: sec + 1e-9 * nanosec)
    take = step.compressed if kind is compressed else step.image
    for number in range(IMAGES_OF_REFERENCE):
        take((1, number), *kind(dome.image(NO_CONTACT)))
    finder.take_reference()
    reading = Reading(0.5, 1.0, 2.0) if touched else NO_CONTACT
    messages = [kind(dome.image(reading)) for _ in range(20)]
    used = []

    def see():
        began = time.process_time()
        for number, message in enumerate(messages):
            seen = take((2 + len(used), number), *message)
            (_, _) = next(seen.outputs())
        used.append((time.process_time() - began) / len(messages))

    try:
        benchmark.pedantic(see, rounds=10, iterations=1, warmup_rounds=1)
    finally:
        cv2.setNumThreads(threads)
    per_image = min(used)
    rate = 1.0 / per_image
    print(f'\n    {1e3 * per_image:.2f} ms of a core an image: {rate:.0f} Hz, goal {GOAL:g} Hz')
    assert rate >= GOAL
