# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""A node within the test's process, and a peer that hears and sends what it should."""

import json
import time

import rclpy
from rclpy.executors import SingleThreadedExecutor

from tactile_push.interface import TOPICS
from tactile_push.nodes.ros.qos import PUBLISHED
from tactile_push.testing.processes import claim_domain

PATIENCE = 60.0  # for what should come at once [s]
NOT_ITS_OWN = ('/rosout', '/clock', '/diagnostics', '/parameter_events')


class NodeBench:
    """Makes one node in a ROS domain of its own, and talks with it.

    `heard` has the messages of each topic that `hear` named.
    """

    def __init__(self):
        self._domain, self._lock = claim_domain()
        self._executor = None
        self._nodes = []
        self.heard = {}

    def start(self, node_class, **parameters):
        """Make the node with given parameters, as a command line gives them, and return it."""
        given = {name: json.dumps(value, default=str) for name, value in parameters.items()}
        words = [word for name, text in given.items() for word in ('-p', f'{name}:={text}')]
        rclpy.init(args=['--ros-args', *words], domain_id=self._domain)
        self.node = node_class()
        self._nodes.append(self.node)
        self.peer = rclpy.create_node('peer', use_global_arguments=False)
        self._nodes.append(self.peer)
        self._executor = SingleThreadedExecutor()
        for node in self._nodes:
            self._executor.add_node(node)
        return self.node

    def hear(self, kind, *topics):
        """Subscribe to topics, and wait until the node knows."""
        for topic in topics:
            self.heard[topic] = []
            self.peer.create_subscription(kind, topic, self.heard[topic].append, PUBLISHED)
        self.until(lambda: all(self.node.count_subscribers(topic) for topic in topics))

    def publisher(self, kind, topic):
        """Return a publisher that the node hears."""
        publisher = self.peer.create_publisher(kind, topic, PUBLISHED)
        self.until(publisher.get_subscription_count)
        return publisher

    def until(self, condition, meanwhile=lambda: None):
        """Let both run until a condition holds, and do something meanwhile."""
        deadline = time.monotonic() + PATIENCE
        while not condition():
            assert time.monotonic() < deadline
            meanwhile()
            self._executor.spin_once(timeout_sec=0.02)

    def values(self, topic):
        """Return the positions by name in the last message heard of a topic."""
        message = self.heard[topic][-1]
        return dict(zip(message.name, message.position, strict=True))

    @property
    def health(self):
        """The node's level and state in words."""
        health = self.node._health()
        return health.level, health.message

    def topics(self):
        """Return the names of the topics that the node publishes, and of those that it hears."""
        place = self.node.get_name(), self.node.get_namespace()
        return tuple(
            {
                name.removeprefix('/')
                for name, _ in of_node(*place)
                if name not in NOT_ITS_OWN and not name.startswith(f'/{place[0]}/transition')
            }
            for of_node in (
                self.peer.get_publisher_names_and_types_by_node,
                self.peer.get_subscriber_names_and_types_by_node,
            )
        )

    def close(self):
        """End the nodes and their context."""
        if self._executor is not None:
            self._executor.shutdown()
        for node in self._nodes:
            node.destroy_node()
        rclpy.try_shutdown()
        self._lock.close()


def declared_topics(name):
    """Return the topics that a node gives and those that it takes, as the interface says."""
    own = [topic for topic in TOPICS.values() if topic.name not in NOT_ITS_OWN]
    gives = {topic.name for topic in own if name in topic.givers}
    return gives, {topic.name for topic in own if name in topic.takers}
