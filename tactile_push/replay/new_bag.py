# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""A bag like another one, in which some topics are made again."""

import os
import shutil
from collections.abc import Iterator, Mapping
from contextlib import contextmanager

from tactile_push.bags import BagReader, BagWriter, Message, schema_text


@contextmanager
def new_bag(
    out: str | os.PathLike[str], bag: BagReader, made_again: Mapping[str, str]
) -> Iterator[BagWriter]:
    """Write a bag with the topics and notes of another one; unless all goes well, none is left.

    Parameters
    ----------
    out : path
        Folder of the bag to write, not there yet.
    bag : BagReader
        The other one.
    made_again : mapping of str to str
        Types of topics that the bag shall have even if the other one does not, by full name.

    Yields
    ------
    BagWriter
        The bag, without messages.

    Raises
    ------
    OSError
        If it cannot be written; with its name.
    """
    writer = BagWriter(out)
    try:
        with writer:
            _begin(writer, bag, made_again)
            yield writer
    except BaseException as error:
        shutil.rmtree(out, ignore_errors=True)
        if isinstance(error, OSError) and error.filename is None:
            raise OSError(error.errno, error.strerror, os.fspath(out)) from None
        raise


def _begin(writer: BagWriter, bag: BagReader, made_again: Mapping[str, str]) -> None:
    for topic in bag.topics.values():
        writer.add_topic(
            topic.name,
            topic.type_name,
            qos=topic.qos,
            type_hash=topic.type_hash,
            definition=topic.definition,
        )
    for name, type_name in made_again.items():
        if name not in bag.topics:
            writer.add_topic(name, type_name, definition=schema_text(type_name))
    for key, text in bag.notes.items():
        writer.note(key, text)


def copy(writer: BagWriter, message: Message) -> None:
    """Write a message as it lies in another bag.

    Parameters
    ----------
    writer : BagWriter
        The bag to write.
    message : Message
        The message.
    """
    writer.write(message.topic, message.data, message.log_time, message.publish_time)
