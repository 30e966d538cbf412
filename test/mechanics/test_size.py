# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
import pytest

from tactile_push.mechanics import Outline
from tactile_push.mechanics.size import check_metres


@pytest.mark.parametrize(
    ('outline', 'around'),
    [
        (Outline.rectangle(50.0, 47.5), '195'),
        (Outline.circle(30.0), '188'),
        (Outline.ellipse(4.0, 2.0), '19.4'),
    ],
)
def test_object_in_millimetres_is_refused_with_its_size(outline, around):
    words = f'vertices: expected metres, got an object {around} m around; are these millimetres?'
    with pytest.raises(ValueError) as refused:
        check_metres('vertices', outline)
    assert str(refused.value) == words


@pytest.mark.parametrize('length', [0.005, 0.05, 1.0])
def test_object_in_metres_is_believed(length):
    check_metres('vertices', Outline.rectangle(length, length))
    check_metres('radius', Outline.circle(length / 2.0))
