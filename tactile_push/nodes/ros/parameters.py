# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""One declaration a parameter: type, default, unit, range, description."""

import difflib
from collections.abc import Callable, Sequence
from types import SimpleNamespace
from typing import Any

import rclpy.parameter
from rcl_interfaces.msg import (
    FloatingPointRange,
    IntegerRange,
    ParameterDescriptor,
    SetParametersResult,
)
from rcl_interfaces.srv import SetParameters, SetParametersAtomically
from rclpy.exceptions import ParameterException
from rclpy.node import Node

from tactile_push.parameters import Parameter


class ConfigurationError(Exception):
    """A node cannot start as it was asked to; the message is for the person who asked."""


def descriptor(parameter: Parameter) -> ParameterDescriptor:
    """Give the descriptor that `ros2 param describe` shows.

    Parameters
    ----------
    parameter : Parameter
        A parameter of a node.

    Returns
    -------
    ParameterDescriptor
        Its description, unit and range.
    """
    unit = f' [{parameter.unit}]' if parameter.unit else ''
    described = ParameterDescriptor(
        name=parameter.name, description=parameter.description + unit, read_only=parameter.read_only
    )
    if parameter.choices:
        described.additional_constraints = parameter.expected()
    if isinstance(parameter.default, float):
        described.floating_point_range = [
            FloatingPointRange(from_value=float(parameter.lower), to_value=float(parameter.upper))
        ]
    elif isinstance(parameter.default, int) and not isinstance(parameter.default, bool):
        described.integer_range = [
            IntegerRange(from_value=int(parameter.lower), to_value=int(parameter.upper))
        ]
    return described


def declare(
    node: Node,
    parameters: Sequence[Parameter],
    changed: Callable[[], None] = lambda: None,
) -> SimpleNamespace:
    """Declare a node's parameters and keep their values at hand.

    Parameters
    ----------
    node : Node
        The node.
    parameters : sequence of Parameter
        All its parameters.
    changed : callable, optional
        Called after values changed at run time.

    Returns
    -------
    SimpleNamespace
        The values by name, always the present ones.

    Raises
    ------
    ConfigurationError
        If a value from the command line or a file is refused, or a name looks like a slip.
    """
    values = SimpleNamespace()
    choices = {parameter.name: parameter for parameter in parameters if parameter.choices}

    def check(proposed: list[rclpy.parameter.Parameter]) -> SetParametersResult:
        for parameter in proposed:
            known = choices.get(parameter.name)
            if known is not None and parameter.value not in known.choices:
                return SetParametersResult(
                    successful=False,
                    reason=f'{parameter.name}: expected {known.expected()}, '
                    f'got {parameter.value!r}',
                )
        return SetParametersResult(successful=True)

    def take(accepted: list[rclpy.parameter.Parameter]) -> None:
        names = {parameter.name for parameter in parameters}
        mine = [parameter for parameter in accepted if parameter.name in names]
        for parameter in mine:
            setattr(values, parameter.name, parameter.value)
        if mine:
            changed()

    node.add_on_set_parameters_callback(check)
    overrides = node._parameter_overrides  # rclpy has no public way to see what nobody declares
    for parameter in parameters:
        no_texts = parameter.default == []  # rclpy would take them for no bytes
        default = rclpy.parameter.Parameter.Type.STRING_ARRAY if no_texts else parameter.default
        try:
            value = node.declare_parameter(parameter.name, default, descriptor(parameter)).value
        except ParameterException:
            given = overrides[parameter.name].value
            raise ConfigurationError(
                f'parameter {parameter.name}: expected {parameter.expected()}, got {given!r}'
            ) from None
        if value is None:  # no texts given either
            value = []
            node._parameters[parameter.name] = rclpy.parameter.Parameter(
                parameter.name, rclpy.parameter.Parameter.Type.STRING_ARRAY, value
            )
        setattr(values, parameter.name, value)
    for name in overrides:
        if not node.has_parameter(name) and not name.startswith('qos_overrides.'):
            similar = difflib.get_close_matches(name, list(vars(values)), n=1, cutoff=0.5)
            if similar:
                raise ConfigurationError(f'parameter {name}: unknown, did you mean {similar[0]}?')
            node.get_logger().warning(f'parameter {name}: unknown, so it does nothing')
    node.add_post_set_parameters_callback(take)
    _refuse_values_of_no_type(node)
    return values


def _refuse_values_of_no_type(node: Node) -> None:
    """Answer a request with a type that does not exist, by which rclpy lets the process end."""
    types = {known.value for known in rclpy.parameter.Parameter.Type}

    def guard(answer: Callable[[Any, Any], Any]) -> Callable[[Any, Any], Any]:
        def guarded(request: Any, response: Any) -> Any:
            if all(parameter.value.type in types for parameter in request.parameters):
                return answer(request, response)
            refusal = SetParametersResult(successful=False, reason='a value of no known type')
            if isinstance(response, SetParameters.Response):
                response.results = [refusal] * len(request.parameters)
            else:
                response.result = refusal
            return response

        return guarded

    for service in node.services:
        if service.srv_type in (SetParameters, SetParametersAtomically):
            service.callback = guard(service.callback)
