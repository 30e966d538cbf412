# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What a comparison of two bags finds, and what it tolerates."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any


@dataclass(frozen=True)
class Tolerances:
    """How far apart two numbers may be and still count as equal.

    An infinite tolerance leaves a field out, whatever it holds and whichever bag has it. A field is
    named by its whole path or by a part of it that reaches to its beginning or end:
    ``'twist.linear.x'``, ``'twist.linear'``, ``'linear.x'``. If several fit, the last one counts.
    """

    default: float = 0.0  # for all numbers, in their units; a time is in seconds
    fields: Mapping[tuple[str, str], float] = field(default_factory=dict)  # by topic and field

    def of(self, topic: str, path: str) -> float:
        """Return the tolerance of a field, given its topic and whole path, in the field's unit."""
        for (name, part), tolerance in reversed([*self.fields.items()]):
            if name == topic and is_part(part, path):
                return tolerance
        return self.default


def is_part(part: str, path: str) -> bool:
    """Return whether a part of a path, which reaches to its beginning or end, names the field."""
    return part == path or path.endswith(f'.{part}') or path.startswith((f'{part}.', f'{part}['))


@dataclass(frozen=True)
class Difference:
    """A place at which two messages differ."""

    key: int  # what the messages have in common: their stamp [ns], or their place in the topic
    where: str  # path of the field with the places in arrays
    a: Any
    b: Any
    distance: float  # how far apart the values are; infinite where that has no size


@dataclass
class FieldDiff:
    """The differences in one field of a topic."""

    first: Difference
    largest: Difference
    messages: int = 0  # pairs of messages that differ in the field

    def add(self, difference: Difference) -> None:
        """Add a difference."""
        if difference.key < self.first.key:
            self.first = difference
        least = (-self.largest.distance, self.largest.key)
        if (-difference.distance, difference.key) < least:
            self.largest = difference


@dataclass
class TopicDiff:
    """The differences of a topic."""

    name: str
    types: tuple[str | None, str | None]  # in each bag; None where the topic is missing
    counts: tuple[int, int]  # messages in each bag
    by_stamp: bool = False  # messages are paired by their stamps, otherwise by their order
    compared: int = 0  # pairs of messages
    different: int = 0  # pairs that differ in a field that both have
    only_a: int = 0  # messages without a partner in the other bag
    only_b: int = 0
    first_only_a: int | None = None  # stamp [ns] or place of the first of them
    first_only_b: int | None = None
    fields: dict[str, FieldDiff] = field(default_factory=dict)  # by the path of the field
    fields_only_a: list[str] = field(default_factory=list)  # that the other bag's messages lack
    fields_only_b: list[str] = field(default_factory=list)
    remarks: list[str] = field(default_factory=list)  # other differences, in words
    notes: list[str] = field(default_factory=list)  # how the comparison was made, in words

    @property
    def same(self) -> bool:
        """Whether there is no difference."""
        lone = self.only_a or self.only_b or self.fields_only_a or self.fields_only_b
        return not (self.different or lone or self.remarks)

    @property
    def first(self) -> Difference | None:
        """The first difference of two messages, in the first field if there are several."""
        candidates = [found.first for found in self.fields.values()]
        return min(candidates, key=lambda found: found.key, default=None)
