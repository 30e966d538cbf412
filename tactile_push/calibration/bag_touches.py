# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What bags of touches have in common, whatever the sensor."""

from collections.abc import Collection, Mapping, Sequence
from pathlib import Path

from tactile_push.bags import BagReader
from tactile_push.bags.topic import Topic
from tactile_push.calibration.touch_table import KnownTouch, read_table


def only_topic(bag: BagReader, kinds: Mapping[str, Mapping[str, str]], what: str) -> Topic:
    """Return the only topic of some types.

    Parameters
    ----------
    bag : BagReader
        The bag.
    kinds : mapping of str to mapping
        Fields that are read, by type.
    what : str
        What such a topic is about, for the message.

    Returns
    -------
    Topic
        The topic.

    Raises
    ------
    ValueError
        If there is none or there are several, or if its messages do not have the fields.
    """
    topics = [topic for topic in bag.topics.values() if topic.type_name in kinds]
    if len(topics) != 1:
        names = ', '.join(topic.name for topic in topics) or 'none'
        raise ValueError(f'expected one topic of {what}, got {names}')
    (topic,) = topics
    if trouble := topic.trouble(kinds[topic.type_name]):
        raise ValueError(trouble)
    return topic


def touches_in_order(table: Path) -> list[KnownTouch]:
    """Return those lines of a table in which something touches the tip.

    Parameters
    ----------
    table : Path
        The table, as `read_table` reads it; it raises the same errors.

    Returns
    -------
    list of KnownTouch
        The touches.
    """
    return [touch for touch in read_table(table) if touch.touched]


def check_count(table: Path, touches: Sequence[KnownTouch], found: int) -> None:
    """Refuse a table that has another number of touches than the bag.

    Parameters
    ----------
    table, touches : Path, sequence of KnownTouch
        The table and its touches.
    found : int
        How many the bag has.

    Raises
    ------
    ValueError
        If the numbers differ.
    """
    if found != len(touches):
        raise ValueError(f'{table}: expected {found} touches as in the bag, got {len(touches)}')


def only_frame(frames: Collection[str]) -> str:
    """Return the frame of all messages.

    Parameters
    ----------
    frames : collection of str
        Frames of the messages, each once.

    Returns
    -------
    str
        The frame; '' if there are no messages.

    Raises
    ------
    ValueError
        If there are several, so that the messages are of several sensors.
    """
    if len(frames) > 1:
        raise ValueError(f'expected messages in one frame, got {", ".join(sorted(frames))}')
    return next(iter(frames), '')
