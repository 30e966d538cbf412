# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What can be set of a node."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from types import SimpleNamespace
from typing import Any


@dataclass(frozen=True)
class Parameter:
    """A parameter of a node.

    Parameters
    ----------
    name : str
        Its name.
    default : bool, int, float, str or list
        Its value unless somebody says otherwise; the type of all its values.
    unit : str
        Unit for people, '' if there is none.
    description : str
        What it is, in a few words.
    lower, upper : float or int, optional
        Closed range of a number; a whole number needs both.
    choices : tuple of str, optional
        All values that a text may have.
    read_only : bool, optional
        Whether it is fixed once the node runs.
    """

    name: str
    default: Any
    unit: str
    description: str
    lower: float = -math.inf
    upper: float = math.inf
    choices: tuple[str, ...] = ()
    read_only: bool = False

    def expected(self) -> str:
        """Say what a value has to be."""
        if self.choices:
            return 'one of ' + ', '.join(self.choices)
        kind = {bool: 'true or false', int: 'a whole number', float: 'a number', str: 'a text'}.get(
            type(self.default), 'a list of texts'
        )
        if isinstance(self.default, list) and self.default and type(self.default[0]) is float:
            kind = 'a list of numbers with decimal points'
        unit = f' [{self.unit}]' if self.unit else ''
        if type(self.default) is float:
            kind = 'a number with a decimal point'
        if isinstance(self.default, bool) or not isinstance(self.default, int | float):
            return kind + unit
        return f'{kind}{unit} from {self.lower:g} to {self.upper:g}'

    def check(self, value: Any) -> None:
        """Refuse what a node would refuse.

        Parameters
        ----------
        value : object
            A value that somebody wants the parameter to have.

        Raises
        ------
        ValueError
            If it has another type, lies out of range or is none of the choices.
        """
        fits = type(value) is type(self.default)
        if fits and isinstance(value, int | float) and not isinstance(value, bool):
            fits = self.lower <= value <= self.upper
        if fits and isinstance(value, list):
            kind = type(self.default[0]) if self.default else str
            fits = all(type(item) is kind for item in value)
        if fits and self.choices:
            fits = value in self.choices
        if not fits:
            raise ValueError(f'parameter {self.name}: expected {self.expected()}, got {value!r}')


def values_of(parameters: Sequence[Parameter], given: Mapping[str, Any]) -> SimpleNamespace:
    """Give the values of all parameters of a node that does not run.

    Parameters
    ----------
    parameters : sequence of Parameter
        All its parameters.
    given : mapping of str to object
        Values that are not the default; of names that the node does not know nothing is taken.

    Returns
    -------
    SimpleNamespace
        The values by name.

    Raises
    ------
    ValueError
        If a value is refused.
    """
    values = SimpleNamespace()
    for parameter in parameters:
        value = given.get(parameter.name, parameter.default)
        parameter.check(value)
        setattr(values, parameter.name, value)
    return values
