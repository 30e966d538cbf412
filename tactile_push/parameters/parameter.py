# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Declares a node's parameters: one frozen dataclass a node, one field a parameter."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, fields, replace
from typing import Any, TypeVar, cast

T = TypeVar('T')
P = TypeVar('P', bound='NodeParameters')


@dataclass(frozen=True)
class Parameter:
    """What is known of one parameter of a node."""

    name: str  #: of the parameter
    default: Any  #: value unless somebody gives another; every value has its type
    unit: str  #: for people; '' if there is none
    words: str  #: what the parameter is
    lower: float = -math.inf  #: closed range of a number; a whole number needs both ends
    upper: float = math.inf  #: the other end of the range
    choices: tuple[str, ...] = ()  #: all values that a text may have
    read_only: bool = False  #: whether the value is fixed once the node runs

    def expected(self) -> str:
        """Return what a value has to be, in words.

        Returns
        -------
        str
            Such as 'a number with a decimal point [m] from 0 to 1'.
        """
        if self.choices:
            return 'one of ' + ', '.join(self.choices)
        unit = f' [{self.unit}]' if self.unit else ''
        if isinstance(self.default, list):
            numbers = self.default and type(self.default[0]) is float
            return f'a list of {"numbers with decimal points" if numbers else "texts"}{unit}'
        if isinstance(self.default, bool | str):
            return 'true or false' if isinstance(self.default, bool) else 'a text'
        kind = 'a whole number' if type(self.default) is int else 'a number with a decimal point'
        return f'{kind}{unit} from {self.lower:g} to {self.upper:g}'

    def takes(self, value: Any) -> bool:
        """Return whether the node takes a value.

        Parameters
        ----------
        value : object
            Value that somebody wants the parameter to have.

        Returns
        -------
        bool
            False if it has another type, lies out of range or is none of the choices.
        """
        fits = type(value) is type(self.default)
        if fits and isinstance(value, int | float) and not isinstance(value, bool):
            fits = self.lower <= value <= self.upper
        if fits and isinstance(value, list):
            kind = type(self.default[0]) if self.default else str
            fits = all(type(item) is kind for item in value)
        if fits and self.choices:
            fits = value in self.choices
        return fits

    def check(self, value: Any) -> None:
        """Refuse a value that the node would refuse.

        Parameters
        ----------
        value : object
            Value that somebody wants the parameter to have.

        Raises
        ------
        ValueError
            If the node does not take it.
        """
        if not self.takes(value):
            raise ValueError(f'parameter {self.name}: expected {self.expected()}, got {value!r}')


def parameter(
    default: T,
    unit: str,
    words: str,
    lower: float = -math.inf,
    upper: float = math.inf,
    *,
    choices: tuple[str, ...] = (),
    read_only: bool = False,
) -> T:
    """Declare a parameter as a field of a subclass of `NodeParameters`.

    The arguments are those of `Parameter`. mypy takes the field for the default. Several nodes may
    share a field under the same name.
    """
    known = {'known': Parameter('', default, unit, words, lower, upper, choices, read_only)}
    if isinstance(default, list):
        return cast(T, field(default_factory=default.copy, metadata=known))
    return field(default=default, metadata=known)


@dataclass(frozen=True)
class NodeParameters:
    """Values of a node's parameters; each subclass declares those of one node by `parameter`."""

    @classmethod
    def declared(cls) -> tuple[Parameter, ...]:
        """Return the node's parameters in their order.

        Returns
        -------
        tuple of Parameter
            One for each field.
        """
        return tuple(replace(one.metadata['known'], name=one.name) for one in fields(cls))

    @classmethod
    def taken(cls, given: Mapping[str, Any]) -> dict[str, Any]:
        """Return those of some values that the node takes.

        Parameters
        ----------
        given : mapping of str to object
            Values by name.

        Returns
        -------
        dict of str to object
            Without names that the node does not know, and without values that it refuses.
        """
        return {
            known.name: given[known.name]
            for known in cls.declared()
            if known.name in given and known.takes(given[known.name])
        }

    @classmethod
    def of(cls: type[P], given: Mapping[str, Any]) -> P:
        """Return the values of a node that was started with some values.

        Parameters
        ----------
        given : mapping of str to object
            Values that are not the default. Names that the node does not know are ignored.

        Returns
        -------
        NodeParameters
            All values.

        Raises
        ------
        ValueError
            If a value is refused.
        """
        values = {known.name: given[known.name] for known in cls.declared() if known.name in given}
        for known in cls.declared():
            known.check(values.get(known.name, known.default))
        return cls(**values)
