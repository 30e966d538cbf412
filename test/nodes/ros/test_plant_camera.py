# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What the camera of a simulated finger sees; the rig is `sim_plant`'s."""

import sys

import numpy as np
import pytest
from sensor_msgs.msg import Image

pytest.importorskip('cv2', reason="pip install 'tactile_push[camera]'")

from tactile_push.interface import IMAGE, TRUE_STATE
from tactile_push.nodes.ros.parameters import ConfigurationError
from tactile_push.nodes.sim_plant import SimPlant
from tactile_push.parameters.simulated_camera import HEIGHT, WIDTH
from tactile_push.pipeline.stamps import stamp_of


@pytest.fixture
def plant(bench, tmp_path):
    """Return what starts the plant with a device of its own."""
    return lambda **parameters: bench.start(
        SimPlant,
        **{'device': tmp_path / 'sensor', 'sensor_rate': 50.0, 'publish_image': True, **parameters},
    )


def picture(message):
    return (
        np.frombuffer(message.data, np.uint8).reshape(message.height, message.width).astype(float)
    )


def test_first_images_show_an_untouched_tip_and_later_ones_the_contact(bench, plant):
    plant(untouched_images=5, theta_initial=0.3, d_initial=0.0)
    bench.hear(Image, IMAGE)
    bench.until(lambda: len(bench.heard[IMAGE]) > 10)
    first, *_, last = bench.heard[IMAGE]
    assert (first.width, first.height, first.encoding) == (WIDTH, HEIGHT, 'mono8')
    assert first.header.frame_id == 'fingertip'
    assert stamp_of(first) < stamp_of(last)
    change = picture(last) - picture(first)
    rows, columns = np.nonzero(change > 40.0)
    # Turned counterclockwise by 0.3, the edge touches the tip left of the pole.
    assert len(rows) > 100
    assert columns.mean() < 0.45 * WIDTH
    assert rows.mean() == pytest.approx((HEIGHT - 1) / 2.0, abs=3.0)


def test_without_opencv_it_is_refused(plant, monkeypatch):
    monkeypatch.setitem(sys.modules, 'cv2', None)
    with pytest.raises(
        ConfigurationError, match='^parameter publish_image: needs OpenCV: pip inst'
    ):
        plant()


def test_images_are_published_only_if_that_is_asked_for(bench, plant):
    plant(publish_image=False)
    assert TRUE_STATE in bench.topics()[0]
    assert IMAGE not in bench.topics()[0]
