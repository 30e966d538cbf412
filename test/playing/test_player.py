# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The player with real subscribers, in a domain of its own for each test."""

import math
import time
from types import SimpleNamespace

import pytest
from mcap.writer import Writer

rclpy = pytest.importorskip('rclpy')

from rclpy.context import Context  # noqa: E402
from rclpy.executors import SingleThreadedExecutor  # noqa: E402
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy  # noqa: E402
from rclpy.serialization import serialize_message  # noqa: E402
from rosgraph_msgs.msg import Clock  # noqa: E402
from std_msgs.msg import Int64, String  # noqa: E402

from support.bag_copies import with_topics  # noqa: E402
from support.foreign_topics import NAMESAKES, OTHERS  # noqa: E402
from tactile_push.bags import BagWriter  # noqa: E402
from tactile_push.bags.reader import BagError, BagReader  # noqa: E402
from tactile_push.playing import player as playing  # noqa: E402
from tactile_push.playing.player import PATIENCE, QUIET, Player  # noqa: E402
from tactile_push.playing.schedule import part_of  # noqa: E402
from tactile_push.testing.processes import claim_domain  # noqa: E402

EPOCH = 1_700_000_000_000_000_000  # [ns]
MS = 10**6
INT64 = 'std_msgs/msg/Int64'
INT64_HASH = 'RIHS01_8cd1048c2f186b6bd9a92472dc1ce51723c0833a221e2b7aecfff111774f4b49'


def write(path, milliseconds, topic='/number', **options):
    """Write a bag of numbers, each the time at which it is due."""
    with BagWriter(path) as bag:
        bag.add_topic(topic, INT64, **options)
        for ms in milliseconds:
            time = EPOCH + ms * MS
            bag.write(topic, serialize_message(Int64(data=time)), time, time)
    return BagReader(path)


class Graph:
    """A node that plays and one that listens, which run while the test spins them."""

    def __init__(self, monkeypatch):
        self.monkeypatch = monkeypatch
        self.context = Context()
        domain, self.lock = claim_domain()
        rclpy.init(context=self.context, domain_id=domain)
        self.node = rclpy.create_node('player', context=self.context)
        self.listener = rclpy.create_node('listener', context=self.context)
        self.executor = SingleThreadedExecutor(context=self.context)
        self.executor.add_node(self.node)
        self.executor.add_node(self.listener)
        self.heard = []
        self.sent = []
        self.expects = False
        self.ended = []
        self.warnings = []
        logger = SimpleNamespace(info=lambda text: None, warning=self.warnings.append)
        self.node.get_logger = lambda: logger
        self.player = None

    def listen(self, message_type, topic, depth=1000, **policies):
        """Note topic, message and when it came, in the order in which they come.

        Messages of two topics may overtake each other on their way: when they were sent is noted
        beside it.
        """
        self.expects = True

        def note(message, info):
            self.heard.append((topic, message, time.monotonic()))
            self.sent.append((info['source_timestamp'], topic, message))

        self.listener.create_subscription(
            message_type, topic, note, QoSProfile(depth=depth, **policies)
        )

    def play_when_quiet(self, part, **options):
        """Make a player that begins when users' players do."""
        self.player = Player(self.node, part, lambda: self.ended.append(True), **options)
        return self.player

    def play(self, part, **options):
        """Make a player that begins as soon as all who listen are matched, if anybody does."""
        self.set_patience(math.inf, math.inf)
        self.play_when_quiet(part, **options)
        topics = [subscription.topic_name for subscription in self.listener.subscriptions]
        self.spin_until(lambda: all(map(self.node.count_subscribers, topics)))
        self.set_patience(0.0, math.inf if topics else 0.0)
        return self.player

    def set_patience(self, quiet, patience):
        self.monkeypatch.setattr(playing, 'QUIET', quiet)
        self.monkeypatch.setattr(playing, 'PATIENCE', patience)

    def spin_until(self, condition):
        deadline = time.monotonic() + 60.0
        while not condition():
            assert time.monotonic() < deadline, 'the condition did not come true in a minute'
            self.executor.spin_once(timeout_sec=0.02)

    def spin_to_the_end(self):
        """Run until the play is over and all that was published for the listener has come."""
        self.spin_until(lambda: self.ended)
        assert self.player.error is None
        if self.expects:
            self.spin_until(lambda: len(self.numbers()) >= self.player.published)

    def spin_for(self, seconds):
        until = time.monotonic() + seconds
        self.spin_until(lambda: time.monotonic() >= until)

    def numbers(self):
        return [message.data for _, message, _ in self.heard if isinstance(message, Int64)]

    def shut_down(self):
        if self.player is not None:
            self.player.stop()
        self.executor.shutdown()
        self.node.destroy_node()
        self.listener.destroy_node()
        rclpy.shutdown(context=self.context)
        self.lock.close()


@pytest.fixture
def graph(monkeypatch):
    graph = Graph(monkeypatch)
    yield graph
    graph.shut_down()


def due(*milliseconds):
    return [EPOCH + ms * MS for ms in milliseconds]


def test_all_messages_come_in_order_and_none_too_early(graph, tmp_path):
    graph.listen(Int64, '/number')
    bag = write(tmp_path / 'bag', range(0, 400, 10))
    graph.play(part_of(bag), rate=2.0)
    graph.spin_to_the_end()
    assert graph.numbers() == due(*range(0, 400, 10))
    assert graph.player.published == 40
    # The last is due 195 ms after the first, which may have been held up but did not come early.
    assert graph.heard[-1][2] - graph.heard[0][2] > 0.15
    assert graph.player.position == pytest.approx(0.39)
    assert not graph.warnings


def test_clock_says_each_messages_time_before_it_and_never_goes_back(graph, tmp_path):
    graph.listen(Clock, '/clock')
    graph.listen(Int64, '/number')
    bag = write(tmp_path / 'bag', [5, 5, 17, 40])
    graph.play(part_of(bag), clock_rate=100.0)
    graph.spin_to_the_end()

    def told():
        return [
            message.clock.sec * 10**9 + message.clock.nanosec
            for topic, message, _ in graph.heard
            if topic == '/clock'
        ]

    graph.spin_until(lambda: due(40)[0] in told())
    # From the bag's beginning on every 10 ms, and before messages in between.
    assert sorted(set(told())) == due(5, 15, 17, 25, 35, 40)
    assert told() == sorted(told())
    assert graph.numbers() == due(5, 5, 17, 40)
    now = 0
    for _, topic, message in sorted(graph.sent, key=lambda sent: sent[0]):
        if topic == '/clock':
            now = message.clock.sec * 10**9 + message.clock.nanosec
        else:
            assert message.data <= now


@pytest.mark.parametrize('reliability', ['best_effort', 'reliable'])
def test_last_message_that_nobody_acknowledges_has_time_to_arrive(
    graph, tmp_path, monkeypatch, reliability
):
    monkeypatch.setattr(playing, 'LAST_FLIGHT', 0.7)
    graph.listen(Int64, '/number', reliability=ReliabilityPolicy.BEST_EFFORT)
    offer = {'depth': 10, 'reliability': reliability, 'durability': 'volatile'}
    graph.play(part_of(write(tmp_path / 'bag', [5, 10], qos=[offer])))
    graph.spin_until(lambda: len(graph.numbers()) == 2)
    graph.spin_until(lambda: graph.ended)
    assert time.monotonic() - graph.heard[-1][2] > 0.6


def test_clock_is_repeated_while_time_stands_still(graph, tmp_path):
    graph.listen(Clock, '/clock')
    player = graph.play(part_of(write(tmp_path / 'bag', [5, 60_000])), clock_rate=1.0, paused=True)
    graph.spin_until(lambda: graph.heard)
    assert player.waiting
    graph.set_patience(0.0, 0.0)
    graph.spin_until(lambda: not player.waiting)
    player.step()
    seen = len(graph.heard)
    graph.spin_until(lambda: len(graph.heard) > seen + 3)
    told = {message.clock.sec * 10**9 + message.clock.nanosec for _, message, _ in graph.heard}
    assert told == set(due(5))


def test_bag_that_ends_after_all_time_that_a_message_can_tell_is_refused(graph, tmp_path):
    with BagWriter(tmp_path / 'bag') as bag:
        bag.add_topic('/number', INT64)
        bag.write('/number', serialize_message(Int64()), 2**31 * 10**9, 0)
    with pytest.raises(BagError, match='/clock cannot hold a time'):
        graph.play(part_of(BagReader(tmp_path / 'bag')), clock_rate=1.0)


def test_loop_starts_over_until_it_is_stopped(graph, tmp_path):
    graph.listen(Int64, '/number')
    graph.play(part_of(write(tmp_path / 'bag', [0, 10, 20])), loop=True)
    graph.spin_until(lambda: len(graph.heard) >= 10)
    assert graph.numbers()[:10] == (due(0, 10, 20) * 4)[:10]
    assert 0.0 <= graph.player.position <= 0.02
    graph.player.stop()
    seen = graph.player.published
    graph.spin_until(lambda: len(graph.heard) == seen)
    assert not graph.ended


def test_pause_step_and_going_on(graph, tmp_path):
    graph.listen(Int64, '/number')
    player = graph.play(part_of(write(tmp_path / 'bag', [0, 1, 2, 3])), paused=True)
    assert player.step() is None  # the play has not begun
    graph.spin_until(lambda: not player.waiting)
    graph.spin_for(0.2)
    assert graph.heard == []
    assert player.paused
    for count in (1, 2):
        assert player.step().log_time == EPOCH + (count - 1) * MS
        graph.spin_until(lambda count=count: len(graph.heard) == count)
    graph.spin_for(0.2)
    assert len(graph.heard) == 2
    assert player.position == pytest.approx(0.001)
    player.pause(False)
    graph.spin_to_the_end()
    assert graph.numbers() == due(0, 1, 2, 3)


def test_step_is_refused_unless_paused(graph, tmp_path):
    player = graph.play(part_of(write(tmp_path / 'bag', [0, 60_000])))
    graph.spin_until(lambda: player.published == 1)
    assert player.step() is None
    player.pause(True)
    assert player.step().log_time == EPOCH + 60_000 * MS
    assert player.step() is None  # but the end comes
    graph.spin_to_the_end()


def test_waits_for_subscribers_that_are_there_and_then_for_quiet(graph, tmp_path):
    graph.listen(Int64, '/number', reliability=ReliabilityPolicy.BEST_EFFORT)
    began = time.monotonic()
    player = graph.play_when_quiet(part_of(write(tmp_path / 'bag', [0])))
    graph.spin_to_the_end()
    assert graph.numbers() == due(0)
    assert time.monotonic() - began >= QUIET
    assert not player.waiting
    assert not graph.warnings


def test_does_not_wait_for_ever_for_nobody(graph, tmp_path):
    began = time.monotonic()
    graph.play_when_quiet(part_of(write(tmp_path / 'bag', [0])))
    graph.spin_to_the_end()
    assert time.monotonic() - began >= PATIENCE
    assert graph.warnings == ['playing, but nobody listens']


def test_subscriber_that_cannot_be_served_is_not_waited_for(graph, tmp_path):
    offer = {'reliability': 'best_effort', 'durability': 'volatile'}
    graph.listen(Int64, '/number', reliability=ReliabilityPolicy.RELIABLE)
    bag = write(tmp_path / 'bag', [0], qos=[offer])
    graph.expects = False
    graph.play(part_of(bag))
    graph.set_patience(0.0, 0.0)
    graph.spin_to_the_end()
    assert graph.heard == []
    assert graph.warnings == ['playing, but nobody listens']


def test_late_subscriber_of_a_latched_topic_gets_what_was_played(graph, tmp_path):
    offer = {'reliability': 'reliable', 'durability': 'transient_local'}
    bag = write(tmp_path / 'bag', [0, 1, 60_000], qos=[offer])
    player = graph.play(part_of(bag))
    graph.spin_until(lambda: player.published == 2)
    graph.listen(Int64, '/number', durability=DurabilityPolicy.TRANSIENT_LOCAL)
    graph.spin_until(lambda: len(graph.heard) == 2)
    assert graph.numbers() == due(0, 1)


@pytest.mark.parametrize('named', [(), ('number',), ('/number',)])
def test_topic_without_a_leading_slash_is_played_as_with_one(graph, tmp_path, named):
    graph.listen(Int64, '/number')
    graph.play(part_of(write(tmp_path / 'bag', [0, 1], topic='number'), named))
    graph.spin_to_the_end()
    assert graph.numbers() == due(0, 1)


OFFERS = [
    {'deadline': 5, 'lifespan': 'infinite'},
    {'deadline': {'sec': 'one'}, 'liveliness_lease_duration': [1]},
    {'depth': 'ten', 'reliability': ['reliable']},
    {'depth': -1, 'avoid_ros_namespace_conventions': 'no'},
]


@pytest.mark.parametrize('offer', OFFERS, ids=str)
def test_quality_of_service_written_by_hand_is_warned_of_and_the_default_played(
    graph, tmp_path, offer
):
    graph.listen(Int64, '/number')
    write(tmp_path / 'bag', [0], qos=[offer])
    warnings = []
    bag = BagReader(tmp_path / 'bag', warnings.append)
    graph.play(part_of(bag))
    graph.spin_to_the_end()
    assert graph.numbers() == due(0)
    assert len(warnings) == len(offer)
    for key, line in zip(offer, warnings, strict=True):
        assert f'bag: quality of service of /number: {key}: expected ' in line


def test_topic_gets_a_new_name(graph, tmp_path):
    graph.listen(Int64, '/left/number')
    bag = write(tmp_path / 'bag', [0])
    graph.play(part_of(bag), names={'/number': '/left/number'})
    graph.spin_to_the_end()
    assert graph.numbers() == due(0)
    assert graph.node.count_publishers('/number') == 0


def write_strange(path, with_number):
    """Write a bag whose topics cannot be published here, or one of them can."""
    topics = {
        '/unknown': ('nowhere_msgs/msg/Thing', ''),
        '/other': (INT64, INT64_HASH[:-1] + '0'),
        '/no-name': (INT64, INT64_HASH),
    }
    if with_number:
        topics['/number'] = (INT64, INT64_HASH)
    with open(path, 'wb') as stream:
        mcap = Writer(stream)
        mcap.start(profile='ros2', library='test')
        for topic, (type_name, type_hash) in topics.items():
            schema = mcap.register_schema(type_name, 'ros2msg', b'int64 data')
            channel = mcap.register_channel(topic, 'cdr', schema, {'topic_type_hash': type_hash})
            mcap.add_message(channel, EPOCH, serialize_message(Int64(data=EPOCH)), EPOCH)
        mcap.finish()
    return BagReader(path)


def test_topics_that_cannot_be_published_are_left_out_with_one_warning(graph, tmp_path):
    graph.listen(Int64, '/number')
    graph.listen(Int64, '/other')
    graph.play(part_of(write_strange(tmp_path / 'bag.mcap', with_number=True)))
    graph.spin_to_the_end()
    assert [topic for topic, _, _ in graph.heard] == ['/number']
    (warning,) = graph.warnings
    for words in ('/unknown', 'nowhere_msgs/msg/Thing is not installed', '/other', '/no-name'):
        assert words in warning


def test_topics_of_types_that_ros_does_not_know_are_left_out_with_one_warning(graph, tmp_path):
    graph.listen(Int64, '/number')
    bag = write(tmp_path / 'bag', [0])
    mixed = with_topics(bag.path, tmp_path / 'mixed', *OTHERS, *NAMESAKES[1:3])
    graph.play(part_of(BagReader(mixed)))
    graph.spin_to_the_end()
    assert graph.numbers() == due(0)
    (warning,) = graph.warnings
    for words in (
        "/scene (expected a message type package/msg/Type, got 'foxglove::SceneUpdate')",
        "/bare (expected a message type package/msg/Type, got '')",
        "/module (expected a message type package/msg/Type, got 'std_msgs/msg/_bool')",
        "/service (expected a message type package/msg/Type, got 'std_srvs/srv/Empty')",
        "/glove/tactile (expected a message type package/msg/Type, got '')",
        '/text (expected messages in cdr, got json)',
    ):
        assert words in warning


OTHER_NUMBERS = [
    'int32 data',
    'int64 value',
    'int64[] data',
    'int64 data\nint64 more',
    'string data',
]


@pytest.mark.parametrize('definition', OTHER_NUMBERS)
def test_type_that_the_bag_defines_otherwise_is_left_out_without_a_hash_too(
    graph, tmp_path, definition
):
    write(tmp_path / 'bag', [0], definition=definition)
    with pytest.raises(BagError, match='no topic of the bag can be published'):
        graph.play(part_of(BagReader(tmp_path / 'bag')))
    assert '/number (std_msgs/msg/Int64 is installed in another version)' in graph.warnings[0]


@pytest.mark.parametrize('definition', ['# a number\nint64   data  # of it', '', 'int64 data['])
def test_type_that_may_be_the_same_is_played(graph, tmp_path, definition):
    graph.listen(Int64, '/number')
    write(tmp_path / 'bag', [0], definition=definition)
    graph.play(part_of(BagReader(tmp_path / 'bag')))
    graph.spin_to_the_end()
    assert graph.numbers() == due(0)


def test_bag_without_anything_that_can_be_published_is_refused(graph, tmp_path):
    with pytest.raises(BagError, match='bag.mcap: no topic of the bag can be published'):
        graph.play(part_of(write_strange(tmp_path / 'bag.mcap', with_number=False)))


def test_what_is_not_cdr_is_not_published(graph, tmp_path):
    with open(tmp_path / 'bag.mcap', 'wb') as stream:
        mcap = Writer(stream)
        mcap.start(profile='', library='test')
        schema = mcap.register_schema(INT64, 'jsonschema', b'{}')
        mcap.add_message(mcap.register_channel('/number', 'json', schema), EPOCH, b'{}', EPOCH)
        mcap.finish()
    with pytest.raises(BagError, match='bag.mcap: no topic of the bag can be published'):
        graph.play(part_of(BagReader(tmp_path / 'bag.mcap')))
    assert '/number (expected messages in cdr, got json)' in graph.warnings[0]


def test_first_message_that_does_not_decode_is_told_and_played(graph, tmp_path):
    data = serialize_message(Int64(data=7))
    with BagWriter(tmp_path / 'bag') as bag:
        bag.add_topic('/number', INT64)
        bag.add_topic('/cut', INT64)
        for k in range(3):
            bag.write('/number', data, EPOCH + k, EPOCH + k)
            bag.write('/cut', data[:9], EPOCH + k, EPOCH + k)
    heard = []
    graph.listener.create_subscription(Int64, '/cut', heard.append, 10, raw=True)
    graph.play(part_of(BagReader(tmp_path / 'bag')))
    graph.spin_to_the_end()
    graph.spin_until(lambda: len(heard) == 3)
    assert heard == [data[:9]] * 3
    (warning,) = [warning for warning in graph.warnings if 'decode' in warning]
    assert warning.startswith('/cut: the first message does not decode')


def test_bag_that_cannot_be_read_further_ends_the_play_with_the_error(graph, tmp_path):
    graph.listen(Int64, '/number')
    bag = write(tmp_path / 'bag', [0, 1, 2])
    read = bag.messages

    def cut_off(*choice):
        yield from list(read(*choice))[:2]
        raise BagError('here it ends')

    part = part_of(bag)
    bag.messages = cut_off
    player = graph.play(part)
    graph.spin_until(lambda: graph.ended)
    assert str(player.error) == 'here it ends'
    graph.spin_until(lambda: len(graph.heard) == 2)


def test_bytes_are_published_as_they_are(graph, tmp_path):
    data = serialize_message(String(data='déjà vu'))
    with BagWriter(tmp_path / 'bag') as bag:
        bag.add_topic('/text', 'std_msgs/msg/String')
        bag.write('/text', data, EPOCH, EPOCH)
    heard = []
    graph.listener.create_subscription(String, '/text', heard.append, 10, raw=True)
    graph.play(part_of(BagReader(tmp_path / 'bag')))
    graph.spin_to_the_end()
    graph.spin_until(lambda: heard)
    assert heard == [data]


def test_stop_before_the_play_begins(graph, tmp_path):
    player = graph.play(part_of(write(tmp_path / 'bag', [0])))
    player.stop()
    player.stop()
    assert player.published == 0
    assert player.waiting
