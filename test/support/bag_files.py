# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Bags for tests, written by mcap's writer and not by this package."""

import io
import random
import struct

from mcap.writer import CompressionType, Writer

CLOCK = 'rosgraph_msgs/msg/Clock'
CLOCK_DEFINITION = f"""builtin_interfaces/Time clock
{'=' * 80}
MSG: builtin_interfaces/Time
int32 sec
uint32 nanosec
"""

SECOND = 10**9


def clock_message(nanoseconds):
    """Return a rosgraph_msgs/Clock in little-endian CDR."""
    return b'\0\1\0\0' + struct.pack('<iI', *divmod(nanoseconds, SECOND))


def mcap_bytes(messages, *, chunk_size=200, finish=True, **options):
    """Return an MCAP file of Clock messages.

    Parameters
    ----------
    messages : list of tuple
        Topic, log time, publish time and data.
    """
    stream = io.BytesIO()
    options.setdefault('compression', CompressionType.ZSTD)
    writer = Writer(stream, chunk_size=chunk_size, **options)
    writer.start('ros2', 'test')
    schema = writer.register_schema(CLOCK, 'ros2msg', CLOCK_DEFINITION.encode())
    channels = {}
    for topic, log_time, publish_time, data in messages:
        if topic not in channels:
            metadata = {'offered_qos_profiles': '', 'topic_type_hash': ''}
            channels[topic] = writer.register_channel(topic, 'cdr', schema, metadata)
        writer.add_message(channels[topic], log_time, data, publish_time)
    if finish:
        writer.finish()
    return stream.getvalue()


def some_messages(count, seed=0):
    """Return messages of three topics, 10 ms apart."""
    choice = random.Random(seed)
    return [
        (f'/clock{choice.randrange(3)}', time, time - 1_000, clock_message(choice.getrandbits(60)))
        for time in range(5 * SECOND, 5 * SECOND + count * SECOND // 100, SECOND // 100)
    ]


def as_tuples(messages):
    """Return what a reader gave in the form of `some_messages`."""
    return [(each.topic, each.log_time, each.publish_time, each.data) for each in messages]
