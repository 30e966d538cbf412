# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""One topic heard by what is no node."""

import time

import pytest

rclpy = pytest.importorskip('rclpy')

from rclpy.context import Context  # noqa: E402
from rclpy.qos import QoSProfile, ReliabilityPolicy  # noqa: E402
from std_msgs.msg import Int64, String  # noqa: E402

from tactile_push.bags import BagReader, BagWriter  # noqa: E402
from tactile_push.recording.hearing import Hearing  # noqa: E402
from tactile_push.testing.processes import claim_domain  # noqa: E402

PATIENCE = 60.0  # [s]
NUMBERS = ('std_msgs/msg/Int64',)


@pytest.fixture
def stranger(monkeypatch):
    """Return a node of somebody else, in a domain that hearing joins, too."""
    domain, lock = claim_domain()
    monkeypatch.setenv('ROS_DOMAIN_ID', str(domain))
    context = Context()
    rclpy.init(context=context)
    node = rclpy.create_node('stranger', context=context, namespace='left')
    yield node
    node.destroy_node()
    rclpy.shutdown(context=context)
    lock.close()


def take_until(hearing, condition, act=lambda: None):
    """Take messages until a condition holds of all so far."""
    taken, deadline = [], time.monotonic() + PATIENCE
    while not condition(taken):
        assert time.monotonic() < deadline
        act()
        taken += hearing.take()
        time.sleep(0.01)
    return taken


def test_messages_are_taken_in_order_and_go_into_a_bag_as_they_came(stranger, tmp_path):
    best_effort = QoSProfile(depth=10, reliability=ReliabilityPolicy.BEST_EFFORT)
    numbers = stranger.create_publisher(Int64, 'number', best_effort)
    sent = iter(range(10**6))
    with Hearing('left/number', NUMBERS, 100) as hearing:
        taken = take_until(
            hearing,
            lambda taken: len(taken) >= 3,
            lambda: numbers.publish(Int64(data=next(sent))),
        )
        values = [hearing.content(message).data for message in taken]
        assert values == [values[0] + k for k in range(len(values))]
        assert hearing.topic == '/left/number'
        with BagWriter(tmp_path / 'bag') as bag:
            hearing.add_topic(bag)
            for message in taken:
                bag.write(hearing.topic, message.data, message.received, message.sent)
    with BagReader(tmp_path / 'bag') as bag:
        assert [bag.decode(message).data for message in bag.messages()] == values
        assert bag.topics['/left/number'].type_name == NUMBERS[0]


def test_topic_of_another_type_is_not_heard(stranger):
    stranger.create_publisher(String, '/text', 10)
    stranger.create_publisher(Int64, '/number', 10)
    with Hearing('text', NUMBERS, 10) as text, Hearing('number', NUMBERS, 10) as number:
        take_until(number, lambda taken: number.type_name)
        assert text.take() == []
        assert text.type_name == ''


def test_bad_name_is_refused(stranger):
    with pytest.raises(ValueError, match="expected the name of a topic, got '1x'"):
        Hearing('1x', NUMBERS, 10)
