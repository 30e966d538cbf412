# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What a comparison of two bags finds, and what it lets pass."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any


@dataclass(frozen=True)
class Tolerances:
    """How far apart two numbers may be and still count as the same.

    An infinite tolerance leaves a field out, whatever is in it and whichever bag has it.

    Parameters
    ----------
    default : float
        For all numbers, in their units; a time's is the second.
    fields : mapping of (str, str) to float, optional
        By topic and field. A field is named by its whole path or a part of it that reaches to its
        beginning or end: ``'twist.linear.x'``, ``'twist.linear'``, ``'linear.x'``. Of several
        that fit, the last one counts.
    """

    default: float = 0.0
    fields: Mapping[tuple[str, str], float] = field(default_factory=dict)

    def of(self, topic: str, path: str) -> float:
        """Return the tolerance of a field.

        Parameters
        ----------
        topic : str
            Full name of the topic.
        path : str
            Whole path of the field.

        Returns
        -------
        float
            The tolerance, in the field's unit.
        """
        for (name, part), tolerance in reversed([*self.fields.items()]):
            if name == topic and is_part(part, path):
                return tolerance
        return self.default


def is_part(part: str, path: str) -> bool:
    """Tell whether a part of a path names the field.

    Parameters
    ----------
    part : str
        The path or a part of it that reaches to its beginning or end.
    path : str
        Whole path of the field.

    Returns
    -------
    bool
        Whether it does.
    """
    return part == path or path.endswith(f'.{part}') or path.startswith((f'{part}.', f'{part}['))


@dataclass(frozen=True)
class Difference:
    """A place at which two messages differ.

    Parameters
    ----------
    key : int
        What the messages have in common: their stamp [ns], or their place in the topic.
    where : str
        Path of the field with the places in arrays.
    a, b : object
        The values.
    distance : float
        How far apart they are; infinite where that has no size.
    """

    key: int
    where: str
    a: Any
    b: Any
    distance: float


@dataclass
class FieldDiff:
    """The differences in one field of a topic.

    Parameters
    ----------
    first, largest : Difference
        The first one and the largest one.
    messages : int
        How many pairs of messages differ in the field.
    """

    first: Difference
    largest: Difference
    messages: int = 0

    def add(self, difference: Difference) -> None:
        """Take one more difference.

        Parameters
        ----------
        difference : Difference
            The difference.
        """
        if difference.key < self.first.key:
            self.first = difference
        least = (-self.largest.distance, self.largest.key)
        if (-difference.distance, difference.key) < least:
            self.largest = difference


@dataclass
class TopicDiff:
    """The differences of a topic.

    Parameters
    ----------
    name : str
        Full name.
    types : tuple of str or None
        Its message type in each bag; None where it is not there.
    counts : tuple of int
        Its messages in each bag.
    by_stamp : bool
        Whether messages are paired by their stamps, otherwise in order.
    compared : int
        Pairs of messages compared.
    different : int
        Pairs that differ in a field that both have.
    only_a, only_b : int
        Messages without a partner in the other bag.
    first_only_a, first_only_b : int or None
        Stamp [ns] or place of the first of them.
    fields : dict of str to FieldDiff
        By the path of the field.
    fields_only_a, fields_only_b : list of str
        Fields that only the messages of one bag have.
    remarks : list of str
        What else is different, in words.
    notes : list of str
        What is to be known of the comparison, in words.
    """

    name: str
    types: tuple[str | None, str | None]
    counts: tuple[int, int]
    by_stamp: bool = False
    compared: int = 0
    different: int = 0
    only_a: int = 0
    only_b: int = 0
    first_only_a: int | None = None
    first_only_b: int | None = None
    fields: dict[str, FieldDiff] = field(default_factory=dict)
    fields_only_a: list[str] = field(default_factory=list)
    fields_only_b: list[str] = field(default_factory=list)
    remarks: list[str] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)

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
