# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""A topic as a bag describes it."""

from collections.abc import Mapping
from dataclasses import dataclass

from tactile_push.bags.fields import fields_of, trouble_with
from tactile_push.bags.metadata import ROS_ENCODINGS


@dataclass(frozen=True)
class Topic:
    """A topic of a bag."""

    name: str  #: full name, with a leading slash even if the bag leaves it out
    type_name: str  #: message type, such as ``'sensor_msgs/msg/JointState'``; empty if unknown
    definition: str  #: the type's definition with those of all its parts, as the bag has it
    qos: tuple[dict, ...]  #: each publisher's quality of service, in the words of rosbag2
    type_hash: str  #: hash of the type after REP-2011; empty if the bag does not have it
    encodings: tuple[str, str]  #: of the messages and of the schema, such as ``('cdr', 'ros2msg')``

    @property
    def decodes(self) -> bool:
        """Whether its messages can be decoded: they are CDR, and the bag has a ROS 2 definition."""
        return self.encodings == ROS_ENCODINGS

    @property
    def in_words(self) -> str:
        """How its messages are encoded."""
        return f'message encoding {self.encodings[0]!r}, schema encoding {self.encodings[1]!r}'

    def trouble(self, expected: Mapping[str, str]) -> str:
        """Say why fields cannot be read from its messages.

        Parameters
        ----------
        expected : mapping of str to str
            Kinds of the fields by path, as `tactile_push.bags.fields` names them; none to check
            the definition alone.

        Returns
        -------
        str
            One line; empty if they can be read.
        """
        if not self.decodes:
            return (
                f"{self.name} cannot be decoded: expected message encoding 'cdr', schema encoding "
                f"'ros2msg', got {self.in_words}"
            )
        try:
            found = trouble_with(fields_of(self.type_name, self.definition), expected)
        except ValueError as error:
            found = str(error)
        return f'the definition of {self.type_name} for {self.name} {found}' if found else ''
