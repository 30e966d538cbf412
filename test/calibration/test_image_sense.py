# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import math

import numpy as np
import pytest

pytest.importorskip('cv2', reason="pip install 'tactile_push[camera]'")

from support.dome import DomePainter, place
from tactile_push.calibration.image_sense import ImageSense
from tactile_push.tactile import NotUntouchedError, ReadingRejectedError

TOUCH = {'azimuth': 0.5, 'elevation': 0.9, 'size': 5.0}


@pytest.fixture
def painter():
    return DomePainter()


@pytest.fixture
def sense(painter):
    sense = ImageSense(12.0)
    sense.take_free([painter.image() for _ in range(10)])
    return sense


def test_touch_is_told_from_the_untouched_tip(sense, painter):
    assert sense.sight(painter.image())[:2] == (False, True)
    assert sense.sight(painter.image(**TOUCH))[:2] == (True, False)


def moved(sense, one, other):
    return np.max(np.abs(sense.sight(one).features - sense.sight(other).features))


def test_touch_has_moved_when_it_moves_by_two_pixels_or_grows_by_half(sense, painter):
    here = painter.image(**TOUCH)
    assert moved(sense, here, painter.image(**TOUCH)) < 1.0
    assert moved(sense, here, painter.image(**(TOUCH | {'elevation': 0.9 + 2.0 / 36.0}))) > 1.0
    assert moved(sense, here, painter.image(**(TOUCH | {'size': 7.5}))) > 1.0


def test_words_say_where_the_touch_is(sense, painter):
    words = sense.words([painter.image(**TOUCH)])
    column, row = place(TOUCH['azimuth'], TOUCH['elevation'])
    seen = [float(word.rstrip(',')) for word in words.split() if word.rstrip(',').isdigit()]
    assert seen[:2] == pytest.approx([column, row], abs=1.5)
    assert seen[2] == pytest.approx(math.pi * TOUCH['size'] ** 2, rel=0.5)


def test_tip_that_is_touched_meanwhile_is_not_untouched(painter):
    images = [painter.image() for _ in range(9)] + [painter.image(**TOUCH)]
    with pytest.raises(NotUntouchedError, match='the image changes'):
        ImageSense(12.0).take_free(images)


def test_image_of_another_size_is_refused(sense, painter):
    small = painter.image()[:-1]
    with pytest.raises(ReadingRejectedError, match='another size'):
        sense.sight(small)
    with pytest.raises(NotUntouchedError, match='one size'):
        sense.take_free([painter.image(), small])
