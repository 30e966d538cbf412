# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What can be seen of a running graph from outside, as plain values."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any


@dataclass(frozen=True)
class Endpoint:
    """A publisher or a subscription of a topic."""

    node: str  #: name of its node, full if it is in another namespace than the finger
    type_name: str  #: type of the messages
    reliable: bool  #: whether it offers, or asks for, every message
    latched: bool = False  #: whether it keeps, or asks for, messages from before


@dataclass(frozen=True)
class Heard:
    """What was heard of a topic for a while."""

    count: int  #: messages
    seconds: float  #: for how long the doctor listened, by the clock of the nodes [s]
    ages: tuple[float, ...] = ()  #: of the messages by their stamps when they came [s]
    frames: frozenset[str] = frozenset()  #: frames that the messages name
    #: positions by name in each message, of a sensor_msgs/JointState
    values: tuple[Mapping[str, float], ...] = ()

    @property
    def rate(self) -> float:
        """Messages a second [Hz]; NaN if the clock stood."""
        return self.count / self.seconds if self.seconds > 0.0 else math.nan

    @property
    def names(self) -> frozenset[str]:
        """Names of all positions."""
        return frozenset().union(*self.values)


@dataclass(frozen=True)
class Snapshot:
    """A finger's part of a running graph; topics and nodes are named without its namespace."""

    nodes: tuple[str, ...]  #: that run; two of the same name stand twice
    #: state of each managed node that answered, such as 'active'
    states: Mapping[str, str] = field(default_factory=dict)
    #: publishers by topic
    publishers: Mapping[str, tuple[Endpoint, ...]] = field(default_factory=dict)
    #: subscriptions by topic
    subscriptions: Mapping[str, tuple[Endpoint, ...]] = field(default_factory=dict)
    #: what was heard by topic
    heard: Mapping[str, Heard] = field(default_factory=dict)
    #: values of the parameters of each node that answered
    parameters: Mapping[str, Mapping[str, Any]] = field(default_factory=dict)
    #: level (0 well, 1 warning, 2 error or worse) and message that each node reports of itself
    health: Mapping[str, tuple[int, str]] = field(default_factory=dict)
