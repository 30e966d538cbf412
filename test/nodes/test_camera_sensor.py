# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The camera sensor's node: images in, readings out."""

import math
import sys

import pytest
from rclpy.lifecycle import TransitionCallbackReturn
from rclpy.time import Time
from sensor_msgs.msg import CompressedImage, Image, JointState
from std_srvs.srv import Trigger

cv2 = pytest.importorskip('cv2', reason="pip install 'tactile_push[camera]'")

from support.dome import HEIGHT, WIDTH, DomePainter, parameters  # noqa: E402
from support.node_bench import declared_topics  # noqa: E402
from tactile_push.interface import (  # noqa: E402
    CAMERA_SENSOR,
    COMPRESSED_IMAGE,
    IMAGE,
    TACTILE,
    TAKE_REFERENCE,
)
from tactile_push.nodes.camera_sensor import CameraSensor, main  # noqa: E402
from tactile_push.nodes.ros.diagnostics import ERROR, OK, WARN  # noqa: E402
from tactile_push.nodes.ros.parameters import ConfigurationError  # noqa: E402

PERIOD = 20_000_000  # [ns]
TOUCH = {'azimuth': 0.5, 'elevation': 0.9}
NO_REFERENCE = ERROR, 'no reference: lift the finger and call camera_sensor/take_reference'


class Camera:
    """A camera and the node that sees its images."""

    def __init__(self, bench, **others):
        self.bench = bench
        self.node = bench.start(CameraSensor, **parameters(**others))
        bench.hear(JointState, TACTILE)
        self.publisher = bench.publisher(Image, IMAGE)
        self.client = bench.peer.create_client(Trigger, TAKE_REFERENCE)
        self.painter = DomePainter()
        self.now = 1000 * 10**9

    def send(self, change=lambda message: None, **touch):
        self.now += PERIOD
        image = self.painter.image(**touch)
        message = Image(height=HEIGHT, width=WIDTH, step=WIDTH, encoding='mono8')
        message.header.stamp = Time(nanoseconds=self.now).to_msg()
        message.data.frombytes(image.tobytes())
        change(message)
        self.publisher.publish(message)

    def refer(self, **touch):
        """Show images until there could be a reference, ask for it, and return the answer."""
        before = self.node._counted['images']
        self.bench.until(
            lambda: self.node._counted['images'] >= before + 12, lambda: self.send(**touch)
        )
        self.bench.until(self.client.service_is_ready)
        answer = self.client.call_async(Trigger.Request())
        self.bench.until(answer.done, lambda: self.send(**touch))
        return answer.result()

    def until(self, health, **touch):
        self.bench.until(lambda: self.bench.health == health, lambda: self.send(**touch))


def touches(bench):
    """Return the readings heard so far that have a contact."""
    return [message for message in bench.heard[TACTILE] if math.isfinite(message.position[0])]


def test_topics_are_those_of_the_interface(bench):
    bench.start(CameraSensor, **parameters())
    gives, takes = declared_topics(CAMERA_SENSOR)
    assert bench.topics() == (gives, takes - {COMPRESSED_IMAGE})


def test_images_become_readings_with_their_stamps(bench):
    camera = Camera(bench)
    camera.until(NO_REFERENCE)
    assert bench.heard[TACTILE] == []
    answer = camera.refer()
    assert (answer.success, answer.message) == (True, '')
    camera.until((OK, 'no contact'))
    camera.until((OK, 'contact'), **TOUCH)
    bench.until(lambda: touches(bench))
    message = touches(bench)[-1]
    assert message.name == ['azimuth', 'elevation', 'normal_force']
    assert list(message.position[:2]) == pytest.approx([0.5, 0.9], abs=0.02)
    stamp = message.header.stamp.sec * 10**9 + message.header.stamp.nanosec
    assert stamp % PERIOD == 0
    assert math.isnan(bench.heard[TACTILE][0].position[0])


def test_compressed_images_are_taken_instead_if_that_is_asked_for(bench):
    node = bench.start(CameraSensor, **parameters(image_transport='compressed'))
    bench.hear(JointState, TACTILE)
    publisher = bench.publisher(CompressedImage, COMPRESSED_IMAGE)
    assert bench.topics()[1] == {COMPRESSED_IMAGE}
    painter, client = DomePainter(), bench.peer.create_client(Trigger, TAKE_REFERENCE)

    def send(**touch):
        message = CompressedImage(format='png')
        message.data.frombytes(cv2.imencode('.png', painter.image(**touch))[1].tobytes())
        publisher.publish(message)

    bench.until(lambda: node._counted['images'] >= 12 and client.service_is_ready(), send)
    answer = client.call_async(Trigger.Request())
    bench.until(answer.done, send)
    bench.until(lambda: touches(bench), lambda: send(**TOUCH))


def test_reference_in_contact_is_refused_with_the_reason(bench):
    camera = Camera(bench)
    assert camera.refer().success
    answer = camera.refer(**TOUCH)
    assert not answer.success
    assert answer.message.startswith('in contact; lift the finger')


def test_reference_without_images_or_without_being_active_is_refused(bench):
    camera = Camera(bench, silence_timeout=0.1)
    bench.until(lambda: bench.health == (ERROR, 'no images on image'))
    request, response = Trigger.Request(), Trigger.Response()
    asked = camera.node._on_untouched
    assert asked(request, response).message == 'no images on image'
    assert camera.node.trigger_deactivate() == TransitionCallbackReturn.SUCCESS
    assert bench.health == (OK, 'inactive')
    assert asked(request, response).message == 'the node is not active'


def test_first_images_are_the_reference_if_that_is_asked_for(bench):
    camera = Camera(bench, reference_at_start=True)
    camera.until((OK, 'no contact'))
    camera.until((OK, 'contact'), **TOUCH)


def encode(message):
    message.encoding = 'mono16'


def shorten(message):
    del message.data[-1]


def shrink(message):
    message.height -= 1
    del message.data[-WIDTH:]


def turn(message):
    message.height, message.width, message.step = WIDTH, HEIGHT, HEIGHT


def blacken(message):
    message.data = bytes(len(message.data))


@pytest.mark.parametrize(
    ('change', 'words'),
    [
        (encode, 'encoding other than mono8, rgb8 or bgr8'),
        (shorten, 'other number of bytes than its size says'),
        (shrink, 'another size than calibrated'),
        (turn, 'another size than calibrated'),
        (blacken, 'all pixels alike'),
    ],
)
def test_images_that_tell_nothing_are_an_error_that_says_why(bench, change, words):
    camera = Camera(bench)
    assert camera.refer().success
    bench.until(
        lambda: bench.health == (ERROR, f'images refused: {words}'), lambda: camera.send(change)
    )
    readings = camera.node._counted['readings']
    assert camera.node._counted[f'refused: {words}'] > 0
    camera.send(change)
    camera.until((OK, 'no contact'))
    assert camera.node._counted['readings'] > readings


def test_camera_other_than_the_calibrated_one_is_an_error_that_names_it(bench):
    camera = Camera(bench, calibrated_frame='left_camera')
    camera.until((ERROR, 'images refused: another frame than left_camera'))
    bench.until(
        lambda: bench.health == NO_REFERENCE,
        lambda: camera.send(lambda message: setattr(message.header, 'frame_id', 'left_camera')),
    )


def test_some_refused_images_are_a_warning(bench):
    camera = Camera(bench, silence_timeout=60.0)
    assert camera.refer().success
    camera.until((OK, 'no contact'))
    camera.node._diagnostics.rates['refused: dark'] = 1.0
    assert bench.health == (WARN, 'no contact, some images refused')


def test_new_configuration_forgets_the_reference_and_a_new_activation_does_not(bench):
    camera = Camera(bench)
    assert camera.refer().success
    node = camera.node
    for transition in (node.trigger_deactivate, node.trigger_activate):
        assert transition() == TransitionCallbackReturn.SUCCESS
    camera.until((OK, 'no contact'))
    for transition in (
        *(node.trigger_deactivate, node.trigger_cleanup),
        *(node.trigger_configure, node.trigger_activate),
    ):
        assert transition() == TransitionCallbackReturn.SUCCESS
    camera.until(NO_REFERENCE)


@pytest.mark.parametrize(
    ('values', 'refusal'),
    [
        ({'image_width': 0}, 'parameter image_width: expected the file that `tactile_push calib'),
        ({'radial': [1.0]}, 'parameter radial: expected 3 finite numbers'),
        ({'image_transport': 'theora'}, 'parameter image_transport: expected one of raw, compr'),
        ({'treshold': 5.0}, 'parameter treshold: unknown, did you mean threshold?'),
    ],
)
def test_a_bad_parameter_is_refused(bench, values, refusal):
    with pytest.raises(ConfigurationError) as refused:
        bench.start(CameraSensor, **parameters(**values))
    assert str(refused.value).startswith(refusal)


def test_without_opencv_the_node_says_how_to_get_it(monkeypatch, capsys):
    monkeypatch.setitem(sys.modules, 'cv2', None)
    assert main() == 2
    assert capsys.readouterr().err == (
        "camera_sensor: needs OpenCV: pip install 'tactile_push[camera]'\n"
    )
