# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Recorded topics against their declaration in `tactile_push.interface`."""

from tactile_push.bags import BagReader
from tactile_push.interface import TOPICS


def topics_as_declared(folder, lacking=()):
    """Check types and fields of the package's topics in a bag and return the topics' names.

    A bag of an earlier version lacks the fields `lacking`, which that version did not have. A
    sensor that sends sentences measures no tangential force.
    """
    seen = set()
    with BagReader(folder) as bag:
        for message in bag.messages():
            topic = message.topic if message.topic in TOPICS else message.topic.lstrip('/')
            if topic in seen or topic not in TOPICS:
                continue
            seen.add(topic)
            assert bag.topics[message.topic].type_name == TOPICS[topic].type_name
            if TOPICS[topic].fields:
                absent = {*lacking, 'tangential_force'}
                declared = (name for name in TOPICS[topic].field_names if name not in absent)
                assert tuple(bag.decode(message).name) == tuple(declared)
    return seen
