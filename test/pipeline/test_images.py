# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import math

import pytest

cv2 = pytest.importorskip('cv2', reason="pip install 'tactile_push[camera]'")

from support.dome import CAMERA, HEIGHT, WIDTH, DomePainter  # noqa: E402
from tactile_push.interface import TACTILE  # noqa: E402
from tactile_push.pipeline.images import Images  # noqa: E402
from tactile_push.tactile.image_contact import (  # noqa: E402
    IMAGES_OF_REFERENCE,
    ImageContactFinder,
    ImageContactSettings,
)

PAINTER = DomePainter()


@pytest.fixture
def images():
    """Return the step with a reference."""
    step = Images(
        ImageContactFinder(CAMERA, ImageContactSettings()), lambda sec, ns: sec + 1e-9 * ns
    )
    for number in range(IMAGES_OF_REFERENCE):
        assert send(step, (5, number)).refusal == 'no reference'
    step.finder.take_reference()
    return step


def send(step, stamp, **touch):
    image = PAINTER.image(**touch)
    return step.image(stamp, 'cam', 'mono8', HEIGHT, WIDTH, WIDTH, image.tobytes())


def only(outputs):
    ((topic, fields),) = outputs
    assert topic == TACTILE
    return fields


def test_contact_has_the_stamp_of_the_image(images):
    fields = only(send(images, (7, 123456789), azimuth=0.5, elevation=0.9).outputs())
    assert fields['header']['stamp'] == {'sec': 7, 'nanosec': 123456789}
    assert fields['name'] == ['azimuth', 'elevation', 'normal_force']
    assert fields['position'][:2] == pytest.approx([0.5, 0.9], abs=0.02)
    assert math.isnan(fields['effort'][2])


def test_no_contact_is_not_a_number(images):
    fields = only(send(images, (7, 0)).outputs())
    assert all(map(math.isnan, fields['position']))


def test_compressed_image_is_as_good(images):
    picture = cv2.imencode('.png', PAINTER.image(azimuth=0.5, elevation=0.9))[1]
    fields = only(images.compressed((7, 0), 'cam', picture.tobytes()).outputs())
    assert fields['position'][:2] == pytest.approx([0.5, 0.9], abs=0.02)


@pytest.mark.parametrize(
    ('seen', 'refusal'),
    [
        (lambda step: send(step, (-1, 0)), 'negative stamp'),
        (lambda step: step.image((7, 0), 'cam', 'mono16', 1, 1, 2, b'00'), 'encoding other than'),
        (lambda step: step.image((7, 0), 'cam', 'mono8', 1, 2, 2, b'01'), 'another size'),
        (lambda step: step.compressed((7, 0), 'cam', b''), 'compressed image cannot be decoded'),
    ],
)
def test_refused_image_gives_nothing(images, seen, refusal):
    came = seen(images)
    assert came.refusal.startswith(refusal)
    assert list(came.outputs()) == []


def test_image_of_another_camera_than_the_calibrated_one_is_refused():
    step = Images(
        ImageContactFinder(CAMERA, ImageContactSettings()), lambda sec, ns: float(sec), 'other'
    )
    assert send(step, (5, 0)).refusal == 'another frame'
    step = Images(step.finder, lambda sec, ns: float(sec), 'cam')
    assert send(step, (5, 0)).refusal == 'no reference'
