# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The recorder node beside a disk that fails."""

import errno
import time

import pytest

rclpy = pytest.importorskip('rclpy')

from rclpy.executors import SingleThreadedExecutor  # noqa: E402
from rclpy.qos import QoSProfile  # noqa: E402
from sensor_msgs.msg import JointState  # noqa: E402

from tactile_push.bags import disk  # noqa: E402
from tactile_push.interface import TACTILE  # noqa: E402
from tactile_push.nodes.bag_recorder import BagRecorder  # noqa: E402
from tactile_push.testing.processes import claim_domain  # noqa: E402


@pytest.fixture
def node(tmp_path):
    """Return a recorder of one topic."""
    domain, lock = claim_domain()
    settings = [f'output:={tmp_path / "bag"}', f'topics:=[{TACTILE}]']
    arguments = [word for setting in settings for word in ('-p', setting)]
    rclpy.init(args=['--ros-args', *arguments], domain_id=domain)
    yield BagRecorder()
    rclpy.shutdown()
    lock.close()


def test_recorder_says_how_much_it_recorded_though_messages_wait_for_a_full_disk(
    node, monkeypatch, capfd
):
    def fail(descriptor, data):
        raise OSError(errno.ENOSPC, 'No space left on device')

    publisher = node.create_publisher(JointState, TACTILE, QoSProfile(depth=100))
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    deadline = time.monotonic() + 60
    while not publisher.get_subscription_count():
        assert time.monotonic() < deadline
        executor.spin_once(timeout_sec=0.02)
    monkeypatch.setattr(disk.os, 'write', fail)
    with pytest.raises(OSError, match='No space left'):
        while time.monotonic() < deadline:
            publisher.publish(JointState())
            executor.spin_once(timeout_sec=0.02)
    executor.shutdown()
    for _ in range(100):  # and some of them have arrived before the recorder ends
        publisher.publish(JointState())
        time.sleep(0.002)
    with pytest.raises(OSError, match='No space left'):
        node.destroy_node()
    assert 'recorded at most ' in capfd.readouterr().err
