# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""`tactile_push calibrate` asks for touches on a terminal and takes them off real topics."""

import math
from pathlib import Path

import numpy as np
import pytest
from geometry_msgs.msg import WrenchStamped
from sensor_msgs.msg import Image

pytest.importorskip('cv2', reason="pip install 'tactile_push[camera]'")

from support.dome import HEIGHT, WIDTH, DomePainter
from support.on_terminal import OnTerminal
from support.touches import unit, wrench
from tactile_push.bags import BagReader
from tactile_push.calibration.bag_images import images_in_bag
from tactile_push.calibration.bag_wrenches import wrenches_in_bag
from tactile_push.calibration.coverage import suggested_touches
from tactile_push.nodes.ros.qos import SENSOR_DATA
from tactile_push.testing import NodeProcesses, Observer

TIP = np.array([0.0, 0.001, 0.03])
OFFSET = 3.0  # of the sensor's force along z [N]
SIDEWAYS = (0.3, 0.1)  # [N]


class Person:
    """Does what the command asks for on its terminal, while messages go on."""

    def __init__(self, observer, command, publish):
        self.observer, self.command, self.publish = observer, command, publish
        self.place = None  # where the tip is touched

    def until(self, words):
        def said():
            self.publish(self.place)
            return self.command.says(words)

        self.observer.wait_for(said, words)

    def answer(self, words, keys):
        """Wait for words, press keys and forget what was said."""
        self.until(words)
        self.command.said = ''
        self.command.type(keys)

    def start(self):
        self.answer('nothing may touch the tip: Enter', '\n')
        self.until('touch 1 of 21: pole')

    def touch(self, number, keys):
        self.place = suggested_touches()[number]
        self.answer('Enter keeps it', keys)

    def lift(self, words):
        self.place = None
        self.until(words)


def only_folder(where: Path) -> Path:
    (folder,) = where.glob('touches_*')
    return folder


def test_wrenches_are_kept_repeated_and_skipped_and_then_fitted(
    nodes: NodeProcesses, observer: Observer, tmp_path: Path
):
    publisher = observer.node.create_publisher(WrenchStamped, '/ft/wrench', SENSOR_DATA)

    def publish(place):
        message = WrenchStamped()
        force, moment = np.zeros(3), np.zeros(3)
        if place is not None:
            force, moment = wrench(unit(*place), 2.0, SIDEWAYS, 0.0, TIP)
        parts = (message.wrench.force, force), (message.wrench.torque, moment)
        for part, values in parts:
            part.x, part.y, part.z = values.tolist()
        message.wrench.force.z += OFFSET
        publisher.publish(message)

    words = ['calibrate', 'wrench', '--topic', 'ft/wrench', '-o', 'tip.yaml']
    with OnTerminal(words, nodes.environment, tmp_path) as command:
        person = Person(observer, command, publish)
        person.start()
        person.place = suggested_touches()[0]
        person.until('felt 2.02 N')  # sqrt(2² + 0.3² + 0.1²)
        person.touch(0, 'r')
        person.lift('touch 1 of 21: pole')
        person.touch(0, '\n')
        person.lift('touch 2 of 21: ')
        command.type('s')
        person.lift('touch 3 of 21: ')
        person.touch(2, '\n')
        person.lift('touch 4 of 21: ')
        command.type('q')
        observer.wait_for(command.ended, 'the end')
        assert command.status == 1
        assert command.attributes() == command.before
        assert 'touches: expected one in each region of the tip, got none at ' in command.said
        assert 'left, elevation 25° to 50°' in command.said
    assert not (tmp_path / 'tip.yaml').exists()
    folder = only_folder(tmp_path)
    with BagReader(folder) as bag:
        found = wrenches_in_bag(bag, folder / 'touches.csv')
    places = [suggested_touches()[number] for number in (0, 2)]
    assert [touch[:2] for touch in found.touches] == [pytest.approx(place) for place in places]
    expected = [wrench(unit(*place), 2.0, SIDEWAYS, 0.0, TIP)[0] for place in places]
    assert found.forces == pytest.approx(np.array(expected), abs=1e-9)


def test_images_are_kept_until_ctrl_c(nodes: NodeProcesses, observer: Observer, tmp_path: Path):
    publisher = observer.node.create_publisher(Image, '/image', SENSOR_DATA)
    painter = DomePainter()

    def publish(place):
        image = painter.image(*(place or (math.nan, math.nan)), size=5.0)
        message = Image(height=HEIGHT, width=WIDTH, step=WIDTH, encoding='mono8')
        message.data.frombytes(image.tobytes())
        publisher.publish(message)

    with OnTerminal(['calibrate', 'camera'], nodes.environment, tmp_path) as command:
        person = Person(observer, command, publish)
        observer.wait_for(lambda: command.says('no messages on /image'), 'the silence')
        person.start()
        person.touch(0, '\n')
        person.lift('touch 2 of 21: ')
        command.type('\x03')  # Ctrl-C
        observer.wait_for(command.ended, 'the end')
        assert command.status == 130
        assert command.attributes() == command.before
        assert 'Traceback' not in command.said
    folder = only_folder(tmp_path)
    with BagReader(folder) as bag:
        found = images_in_bag(bag, folder / 'touches.csv', 12.0)
    assert len(found.images) == 1
