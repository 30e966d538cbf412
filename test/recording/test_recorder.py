# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The recorder with real publishers, in a domain and a namespace of its own for each test."""

import errno
import os
import time
import uuid

import pytest
import yaml
from mcap.exceptions import EndOfFile
from mcap.reader import NonSeekingReader, make_reader
from mcap_ros2.decoder import DecoderFactory

rclpy = pytest.importorskip('rclpy')

from geometry_msgs.msg import PoseStamped, TwistStamped  # noqa: E402
from rclpy.context import Context  # noqa: E402
from rclpy.duration import Duration  # noqa: E402
from rclpy.executors import SingleThreadedExecutor  # noqa: E402
from rclpy.parameter import Parameter  # noqa: E402
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy  # noqa: E402
from rclpy.serialization import deserialize_message, serialize_message  # noqa: E402
from rclpy.topic_endpoint_info import TopicEndpointInfo  # noqa: E402
from rclpy.type_hash import TypeHash  # noqa: E402
from rosgraph_msgs.msg import Clock  # noqa: E402
from sensor_msgs.msg import JointState  # noqa: E402
from visualization_msgs.msg import Marker, MarkerArray  # noqa: E402

from tactile_push.bags import BagWriter  # noqa: E402
from tactile_push.recording import recorder as recording  # noqa: E402
from tactile_push.recording.recorder import Recorder, common_type_hash, message_class  # noqa: E402
from tactile_push.testing.processes import claim_domain  # noqa: E402

# type_hashes in share/sensor_msgs/msg/JointState.json of ROS 2 Jazzy.
JOINT_STATE_HASH = 'RIHS01_a13ee3a330e346c9d87b5aa18d24e11690752bd33a0350f11c5882bc9179260e'

RELIABLE = QoSProfile(depth=1000)
BEST_EFFORT = QoSProfile(depth=1000, reliability=ReliabilityPolicy.BEST_EFFORT)
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class Graph:
    """A node that publishes and a node that records, which only runs while the test spins it."""

    def __init__(self, use_sim_time=False):
        self.context, self.elsewhere = Context(), Context()
        domain, self.lock = claim_domain()
        rclpy.init(context=self.context, domain_id=domain)
        rclpy.init(context=self.elsewhere, domain_id=domain)
        self.stranger = rclpy.create_node('stranger', context=self.elsewhere)
        namespace = f'test_{uuid.uuid4().hex}'
        self.name = f'/{namespace}/'
        self.plant = rclpy.create_node('plant', context=self.context, namespace=namespace)
        self.node = rclpy.create_node(
            'recorder',
            context=self.context,
            namespace=namespace,
            parameter_overrides=[Parameter('use_sim_time', value=use_sim_time)],
        )
        self.executor = SingleThreadedExecutor(context=self.context)
        self.executor.add_node(self.node)

    def spin_until(self, condition):
        """Run the recording node until the condition holds."""
        deadline = time.monotonic() + 60
        while not condition():
            assert time.monotonic() < deadline, 'the condition did not come true in a minute'
            self.executor.spin_once(timeout_sec=0.02)

    def publisher(self, message_type, topic, profile=RELIABLE):
        """Return a publisher of the plant."""
        return self.plant.create_publisher(message_type, topic, profile)

    def shut_down(self):
        """End both nodes."""
        self.executor.shutdown()
        self.node.destroy_node()
        self.plant.destroy_node()
        self.stranger.destroy_node()
        rclpy.shutdown(context=self.context)
        self.lock.close()
        rclpy.shutdown(context=self.elsewhere)


@pytest.fixture
def use_sim_time():
    """Return whether the recording node uses simulated time; tests may override it."""
    return False


@pytest.fixture
def graph(use_sim_time):
    """Return the two nodes."""
    graph = Graph(use_sim_time)
    yield graph
    graph.shut_down()


@pytest.fixture
def writer(tmp_path):
    """Return the bag to record into."""
    with BagWriter(tmp_path / 'bag') as writer:
        yield writer


@pytest.fixture
def path(tmp_path):
    """Return the path of the MCAP file of the bag."""
    return tmp_path / 'bag' / 'bag_0.mcap'


def matched(*publishers):
    """Return a condition: each publisher has a subscription."""
    return lambda: all(publisher.get_subscription_count() for publisher in publishers)


def read_bag(path):
    """Return topic, MCAP message and decoded message of everything in a closed bag."""
    with open(path, 'rb') as stream:
        reader = make_reader(stream, decoder_factories=[DecoderFactory()])
        return [
            (channel.topic, message, decoded)
            for _, channel, message, decoded in reader.iter_decoded_messages()
        ]


def read_channels(path):
    """Return the channels of a closed bag by topic, and its schemas by number."""
    with open(path, 'rb') as stream:
        summary = make_reader(stream).get_summary()
    return {channel.topic: channel for channel in summary.channels.values()}, summary.schemas


def test_messages_are_recorded_as_they_are(graph, writer, path):
    recorder = Recorder(graph.node, ['tactile', 'contact', 'finger/cmd_vel'], writer)
    tactile = graph.publisher(JointState, 'tactile')
    contact = graph.publisher(PoseStamped, 'contact')
    command = graph.publisher(TwistStamped, 'finger/cmd_vel')
    graph.spin_until(matched(tactile, contact, command))
    sent = {'tactile': [], 'contact': [], 'finger/cmd_vel': []}
    for i in range(100):
        reading = JointState(name=['azimuth', 'elevation'], position=[0.01 * i, float('nan')])
        reading.header.stamp.sec = i
        pose = PoseStamped()
        pose.header.frame_id = 'finger_disk'
        pose.pose.position.x = 0.1 * i
        twist = TwistStamped()
        twist.twist.linear.x = -0.1 * i
        for publisher, topic, message in (
            (tactile, 'tactile', reading),
            (contact, 'contact', pose),
            (command, 'finger/cmd_vel', twist),
        ):
            # In bytes, since two serializations of a message may differ in their padding.
            data = serialize_message(message)
            publisher.publish(data)
            sent[topic].append(data)
    graph.spin_until(lambda: sum(recorder.counts.values()) == 300)
    recorder.stop()
    writer.close()

    assert recorder.counts == {graph.name + topic: 100 for topic in sent}
    messages = read_bag(path)
    for topic, originals in sent.items():
        recorded = [entry for entry in messages if entry[0] == graph.name + topic]
        assert [message.data for _, message, _ in recorded] == originals
    readings = [decoded for topic, _, decoded in messages if topic == graph.name + 'tactile']
    assert [reading.header.stamp.sec for reading in readings] == list(range(100))
    assert [reading.position[0] for reading in readings] == [0.01 * i for i in range(100)]
    poses = [decoded for topic, _, decoded in messages if topic == graph.name + 'contact']
    assert [pose.pose.position.x for pose in poses] == [0.1 * i for i in range(100)]
    assert {pose.header.frame_id for pose in poses} == {'finger_disk'}


def test_recording_ends_for_all_topics_at_the_same_time(graph, writer, monkeypatch):
    recorder = Recorder(graph.node, ['contact', 'tactile'], writer)
    contact = graph.publisher(PoseStamped, 'contact')
    tactile = graph.publisher(JointState, 'tactile')
    graph.spin_until(matched(contact, tactile))
    take_all = recording.take_all

    def take_slowly(topic, subscription):
        yield from take_all(topic, subscription)
        for publisher, message in ((contact, PoseStamped()), (tactile, JointState())):
            publisher.publish(message)
            assert publisher.wait_for_all_acked(Duration(seconds=30))

    monkeypatch.setattr(recording, 'take_all', take_slowly)
    recorder.stop()
    assert recorder.counts == {graph.name + topic: 0 for topic in ('contact', 'tactile')}


def test_type_hash_and_qos_are_those_of_the_publishers(graph, writer, path):
    publishers = [
        graph.publisher(JointState, 'tactile'),
        graph.publisher(JointState, 'tactile', BEST_EFFORT),
        graph.publisher(MarkerArray, 'markers', LATCHED),
    ]
    graph.spin_until(
        lambda: (
            len(graph.node.get_publishers_info_by_topic('tactile')) == 2
            and graph.node.get_publishers_info_by_topic('markers')
        )
    )
    recorder = Recorder(graph.node, ['tactile', 'markers'], writer)
    graph.spin_until(matched(*publishers))
    recorder.stop()
    writer.close()

    channels, schemas = read_channels(path)
    tactile, markers = channels[graph.name + 'tactile'], channels[graph.name + 'markers']
    assert schemas[tactile.schema_id].name == 'sensor_msgs/msg/JointState'
    assert schemas[markers.schema_id].name == 'visualization_msgs/msg/MarkerArray'
    assert tactile.metadata['topic_type_hash'] == JOINT_STATE_HASH
    offers = yaml.safe_load(tactile.metadata['offered_qos_profiles'])
    assert sorted(offer['reliability'] for offer in offers) == ['best_effort', 'reliable']
    forever = {'sec': 9223372036, 'nsec': 854775807}
    (offer,) = yaml.safe_load(markers.metadata['offered_qos_profiles'])
    # The middleware does not tell the history of a publisher.
    assert offer == {
        'history': 'unknown',
        'depth': 0,
        'reliability': 'reliable',
        'durability': 'transient_local',
        'deadline': forever,
        'lifespan': forever,
        'liveliness': 'automatic',
        'liveliness_lease_duration': forever,
        'avoid_ros_namespace_conventions': False,
    }


def test_missing_until_a_publisher_appears(graph, writer):
    tactile = graph.publisher(JointState, 'tactile')
    recorder = Recorder(graph.node, ['tactile', 'contact'], writer)
    graph.spin_until(matched(tactile))
    assert recorder.missing() == [graph.name + 'contact']
    contact = graph.publisher(PoseStamped, 'contact')
    graph.spin_until(matched(contact))
    assert recorder.missing() == []
    contact.publish(PoseStamped())
    graph.spin_until(lambda: recorder.counts[graph.name + 'contact'] == 1)
    recorder.stop()


def test_burst_is_recorded_whole(graph, writer):
    tactile = graph.publisher(JointState, 'tactile')
    recorder = Recorder(graph.node, ['tactile'], writer)
    graph.spin_until(matched(tactile))
    for i in range(900):
        tactile.publish(JointState(position=[float(i)]))
    graph.spin_until(lambda: recorder.counts[graph.name + 'tactile'] == 900)
    recorder.stop()


def test_latched_message_from_before_the_recording_is_recorded(graph, writer, path):
    markers = graph.publisher(MarkerArray, 'markers', LATCHED)
    markers.publish(MarkerArray(markers=[Marker(ns='belt', id=3)]))
    recorder = Recorder(graph.node, ['markers'], writer)
    graph.spin_until(lambda: recorder.counts[graph.name + 'markers'] == 1)
    recorder.stop()
    writer.close()
    ((_, _, decoded),) = read_bag(path)
    assert [(marker.ns, marker.id) for marker in decoded.markers] == [('belt', 3)]


def test_publishers_of_different_quality_are_both_recorded(graph, writer, path):
    first = graph.publisher(JointState, 'tactile')
    recorder = Recorder(graph.node, ['tactile'], writer)
    graph.spin_until(matched(first))
    # Too little for a subscription that asks for reliable delivery, as the first one allowed.
    second = graph.publisher(JointState, 'tactile', BEST_EFFORT)
    graph.spin_until(matched(first, second))

    def received(value, publisher):
        """Publish until it arrives: delivery is best effort."""
        publisher.publish(JointState(position=[value]))
        graph.executor.spin_once(timeout_sec=0.02)
        writer.flush()
        return value in read_unfinished_positions(path)

    graph.spin_until(lambda: received(1.0, first))
    graph.spin_until(lambda: received(2.0, second))
    recorder.stop()


def read_unfinished_positions(path):
    """Return the first position of each joint state in a bag that is still being written."""
    positions = []
    with open(path, 'rb') as stream, pytest.raises(EndOfFile):
        for _, _, message in NonSeekingReader(stream).iter_messages(log_time_order=False):
            positions.append(deserialize_message(message.data, JointState).position[0])
    return positions


def test_silent_topic_is_flushed_without_further_messages(graph, writer, path):
    tactile = graph.publisher(JointState, 'tactile')
    recorder = Recorder(graph.node, ['tactile'], writer)
    graph.spin_until(matched(tactile))
    tactile.publish(JointState(position=[4.0]))
    graph.spin_until(lambda: recorder.counts[graph.name + 'tactile'] == 1)
    graph.spin_until(lambda: read_unfinished_positions(path) == [4.0])
    recorder.stop()


def test_times_are_those_of_sending_and_receiving(graph, writer, path):
    tactile = graph.publisher(JointState, 'tactile')
    recorder = Recorder(graph.node, ['tactile'], writer)
    graph.spin_until(matched(tactile))
    before = time.time_ns()
    tactile.publish(JointState())
    graph.spin_until(lambda: recorder.counts[graph.name + 'tactile'] == 1)
    after = time.time_ns()
    recorder.stop()
    writer.close()
    ((_, message, _),) = read_bag(path)
    assert before <= message.publish_time <= message.log_time <= after


def clock_message(time_ns):
    """Return a tick of simulated time."""
    message = Clock()
    message.clock.sec, message.clock.nanosec = divmod(time_ns, 10**9)
    return message


@pytest.mark.parametrize('use_sim_time', [True])
def test_times_of_reception_are_simulated_if_the_node_uses_simulated_time(graph, writer, path):
    clock = graph.publisher(Clock, '/clock')
    tactile = graph.publisher(JointState, 'tactile')
    markers = graph.publisher(MarkerArray, 'markers', LATCHED)
    recorder = Recorder(graph.node, ['tactile', '/clock', 'markers'], writer)
    # The node's own clock, the recorder and the recording listen to the clock.
    graph.spin_until(lambda: clock.get_subscription_count() == 3 and matched(tactile, markers)())
    start = time.time_ns()
    tactile.publish(JointState(position=[0.0]))
    markers.publish(MarkerArray(markers=[Marker(id=7)]))
    clock.publish(clock_message(0))
    ticks = [1_000_000_001, 1_500_000_000, 40_000_000_000]
    for i, tick in enumerate(ticks, start=1):
        clock.publish(clock_message(tick))
        # However late the process gets to it: what counts is when it was received.
        tactile.publish(JointState(position=[float(i)]))
        time.sleep(0.001)
    graph.spin_until(lambda: recorder.counts[graph.name + 'tactile'] == len(ticks))
    graph.spin_until(lambda: recorder.counts['/clock'] == len(ticks))
    graph.spin_until(lambda: recorder.counts[graph.name + 'markers'] == 1)
    recorder.stop()
    writer.close()
    end = time.time_ns()

    messages = read_bag(path)
    tactile_times = [
        (message.log_time, decoded.position[0])
        for topic, message, decoded in messages
        if topic == graph.name + 'tactile'
    ]
    # Until simulated time runs, nothing is recorded but what is latched.
    assert tactile_times == [(tick, float(i)) for i, tick in enumerate(ticks, start=1)]
    clocks = [
        (message.log_time, decoded.clock.sec * 10**9 + decoded.clock.nanosec)
        for topic, message, decoded in messages
        if topic == '/clock'
    ]
    assert clocks == [(tick, tick) for tick in ticks]
    (latched,) = (message for topic, message, _ in messages if topic == graph.name + 'markers')
    assert latched.log_time == ticks[0]
    # As rosbag2's recorder.cpp has it: the sender's stamp is the middleware's.
    assert all(start <= message.publish_time <= end for _, message, _ in messages)


def test_nothing_is_recorded_after_stop(graph, writer):
    tactile = graph.publisher(JointState, 'tactile')
    recorder = Recorder(graph.node, ['tactile'], writer)
    graph.spin_until(matched(tactile))
    recorder.stop()
    recorder.stop()
    graph.spin_until(lambda: not tactile.get_subscription_count())
    tactile.publish(JointState())
    assert list(graph.node.subscriptions) == []
    assert recorder.counts == {graph.name + 'tactile': 0}


@pytest.fixture
def often(monkeypatch):
    """Let recorders look for topics a hundred times a second."""
    monkeypatch.setattr(recording, '_SEARCH_PERIOD', 0.01)


@pytest.fixture
def errors(graph):
    """Return the list of the errors that the recording node logs."""
    errors = []
    graph.node.get_logger().error = errors.append
    return errors


def add_to_graph(graph, topic, type_names):
    """Let the recording node see publishers that are not there; return its looks at them."""
    names_and_types = graph.node.get_topic_names_and_types
    publishers = graph.node.get_publishers_info_by_topic
    looks = []

    def get_topic_names_and_types():
        looks.append(topic)
        return [*names_and_types(), (topic, type_names)]

    def get_publishers_info_by_topic(name):
        if name == topic:
            return [TopicEndpointInfo(topic_type=type_name) for type_name in type_names]
        return publishers(name)

    graph.node.get_topic_names_and_types = get_topic_names_and_types
    graph.node.get_publishers_info_by_topic = get_publishers_info_by_topic
    return looks


@pytest.mark.usefixtures('often')
def test_type_that_is_not_installed_is_reported_once_and_stays_missing(graph, writer, errors):
    tactile = graph.publisher(JointState, 'tactile')
    looks = add_to_graph(graph, graph.name + 'strange', ['nowhere_msgs/msg/Thing'])
    recorder = Recorder(graph.node, ['strange', 'tactile'], writer)
    graph.spin_until(matched(tactile))
    tactile.publish(JointState())
    graph.spin_until(lambda: recorder.counts[graph.name + 'tactile'] == 1 and len(looks) > 12)
    assert recorder.missing() == [graph.name + 'strange']
    recorder.stop()
    (error,) = errors
    assert f'{graph.name}strange' in error
    assert 'nowhere_msgs/msg/Thing' in error


@pytest.mark.usefixtures('often')
def test_one_of_two_types_is_recorded_and_the_other_reported_once(graph, writer, path, errors):
    first = graph.publisher(JointState, 'tactile')
    recorder = Recorder(graph.node, ['tactile', 'contact'], writer)
    graph.spin_until(matched(first))
    second = graph.stranger.create_publisher(PoseStamped, graph.name + 'tactile', RELIABLE)
    graph.spin_until(lambda: errors)
    second.publish(PoseStamped())
    first.publish(JointState(position=[3.0]))
    graph.spin_until(lambda: recorder.counts[graph.name + 'tactile'] == 1)
    contact = graph.publisher(PoseStamped, 'contact')
    graph.spin_until(matched(contact))
    looks = recorder._looks
    graph.spin_until(lambda: recorder._looks > looks + 12)
    recorder.stop()
    writer.close()
    (error,) = errors
    assert f'{graph.name}tactile' in error
    assert 'geometry_msgs/msg/PoseStamped' in error
    ((_, _, decoded),) = read_bag(path)
    assert list(decoded.position) == [3.0]


def test_of_several_types_the_one_that_is_installed_is_recorded(graph, writer, path, errors):
    types = ['nowhere_msgs/msg/Thing', 'sensor_msgs/msg/JointState']
    add_to_graph(graph, graph.name + 'tactile', types)
    recorder = Recorder(graph.node, ['tactile'], writer)
    assert recorder.missing() == []
    recorder.stop()
    writer.close()
    channels, schemas = read_channels(path)
    assert schemas[channels[graph.name + 'tactile'].schema_id].name == 'sensor_msgs/msg/JointState'
    (error,) = errors
    assert 'nowhere_msgs/msg/Thing' in error


def test_all_topics_are_found_as_they_appear_but_hidden_ones(graph, writer, path):
    tactile = graph.publisher(JointState, 'tactile')
    hidden = graph.publisher(JointState, '_hidden')
    recorder = Recorder(graph.node, None, writer)
    graph.spin_until(matched(tactile))
    contact = graph.publisher(PoseStamped, 'contact')
    graph.spin_until(matched(contact))
    for publisher, message in ((tactile, JointState()), (contact, PoseStamped())):
        publisher.publish(message)
    hidden.publish(JointState())
    mine = {graph.name + 'tactile': 1, graph.name + 'contact': 1}
    graph.spin_until(
        lambda: {t: n for t, n in recorder.counts.items() if t.startswith(graph.name)} == mine
    )
    # Of the nodes themselves.
    assert {'/rosout', '/parameter_events'} <= set(recorder.counts)
    assert not hidden.get_subscription_count()
    assert recorder.missing() == []
    recorder.stop()


def test_messages_are_in_the_file_in_the_order_in_which_they_were_received(graph, writer, path):
    topics = ['a', 'b', 'c']
    publishers = [graph.publisher(JointState, topic) for topic in topics]
    recorder = Recorder(graph.node, topics, writer)
    graph.spin_until(matched(*publishers))
    for i in range(90):
        publishers[i % 3].publish(JointState(position=[float(i)]))
    graph.spin_until(lambda: sum(recorder.counts.values()) == 90)
    recorder.stop()
    writer.close()
    with open(path, 'rb') as stream:
        times = [
            message.log_time
            for _, _, message in NonSeekingReader(stream).iter_messages(log_time_order=False)
        ]
    assert times == sorted(times)
    assert len(times) == 90


def test_what_was_received_before_the_stop_is_recorded(graph, writer, path):
    tactile = graph.publisher(JointState, 'tactile')
    recorder = Recorder(graph.node, ['tactile'], writer)
    graph.spin_until(matched(tactile))
    for _ in range(50):
        tactile.publish(JointState())
    deadline = time.monotonic() + 60
    # The node does not run any more; the middleware goes on by itself.
    while recorder.counts[graph.name + 'tactile'] < 50 and time.monotonic() < deadline:
        recorder._take()
        time.sleep(0.001)
    tactile.publish(JointState())
    time.sleep(0.2)  # to arrive; the test would fail without, never pass wrongly
    recorder.stop()
    assert recorder.counts[graph.name + 'tactile'] == 51


A, B = TypeHash(1, b'a' * 32), TypeHash(1, b'b' * 32)
UNKNOWN = TypeHash(0)


@pytest.mark.parametrize(
    'hashes, expected',
    [
        ([A], 'RIHS01_' + '61' * 32),
        ([A, A], 'RIHS01_' + '61' * 32),
        ([UNKNOWN, A], 'RIHS01_' + '61' * 32),
        ([UNKNOWN], ''),
        ([A, B], ''),
    ],
)
def test_type_hash_is_the_one_that_publishers_agree_on(hashes, expected):
    # As type_description_hash_for_topic in rosbag2's recorder.cpp.
    publishers = [TopicEndpointInfo(topic_type_hash=type_hash) for type_hash in hashes]
    assert common_type_hash(publishers) == expected


def test_error_of_the_disk_is_raised_to_whoever_spins(graph, writer, monkeypatch):
    tactile = graph.publisher(JointState, 'tactile')
    recorder = Recorder(graph.node, ['tactile'], writer)
    graph.spin_until(matched(tactile))

    def fail(descriptor, data):
        raise OSError(errno.ENOSPC, 'No space left on device')

    monkeypatch.setattr(os, 'write', fail)
    tactile.publish(JointState())
    with pytest.raises(OSError, match='No space left'):
        graph.spin_until(lambda: False)
    with pytest.raises(OSError, match='No space left'):
        writer.flush()
    recorder.stop()


def test_message_class():
    assert message_class('sensor_msgs/msg/JointState') is JointState
    for type_name in ('sensor_msgs/msg/Nothing', 'nowhere_msgs/msg/Thing'):
        with pytest.raises(LookupError, match=type_name):
            message_class(type_name)
