# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Declares the parameters of a node with ROS, and refuses what is no value of theirs."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from typing import Any, TypeVar

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

from tactile_push.parameters import NodeParameters, Parameter
from tactile_push.parameters.ros_file import QOS_OVERRIDES
from tactile_push.parameters.slips import meant

P = TypeVar('P', bound=NodeParameters)


class ConfigurationError(Exception):
    """A node cannot start as it was asked to; the message is for the person who asked."""


@contextmanager
def refusing(name: str = '') -> Iterator[None]:
    """Refuse to start for the error of a block, which names the parameter unless that is given."""
    at = f'parameter {name}: ' if name else 'parameter '
    try:
        yield
    except ValueError as error:
        raise ConfigurationError(f'{at}{error}') from None
    except OSError as error:
        file = f'{error.filename}: ' if error.filename else ''
        raise ConfigurationError(f'{at}{file}{error.strerror}') from None


def descriptor(parameter: Parameter) -> ParameterDescriptor:
    """Return what `ros2 param describe` shows of a parameter."""
    unit = f' [{parameter.unit}]' if parameter.unit else ''
    described = ParameterDescriptor(
        name=parameter.name, description=parameter.words + unit, read_only=parameter.read_only
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
    kind: type[P],
    changed: Callable[[P], None] | None = None,
    fits: Callable[[P], object] | None = None,
) -> P:
    """Declare a node's parameters and return their values at the start.

    After a change at run time `changed` is called with the new values. Before it, `fits` is called
    with them and raises ValueError if they do not fit together.

    Raises
    ------
    ConfigurationError
        If a value from the command line or a file is refused, or a name looks like a slip.
    """
    declared = {parameter.name: parameter for parameter in kind.declared()}
    values: P | None = None  # until all are declared

    def check(proposed: list[rclpy.parameter.Parameter]) -> SetParametersResult:
        try:
            asked = {new.name: new.value for new in proposed if new.name in declared}
            for name, value in asked.items():
                if declared[name].choices:  # rclpy checks types and ranges itself
                    declared[name].check(value)
            if values is not None and fits is not None:
                fits(replace(values, **asked))
        except ValueError as error:
            return SetParametersResult(successful=False, reason=str(error))
        return SetParametersResult(successful=True)

    def take(accepted: list[rclpy.parameter.Parameter]) -> None:
        nonlocal values
        new = {one.name: one.value for one in accepted if one.name in declared}
        if new and values is not None:
            values = replace(values, **new)
            if changed is not None:
                changed(values)

    node.add_on_set_parameters_callback(check)
    overrides = node._parameter_overrides  # rclpy has no public way to see what nobody declares
    first = {name: _declare(node, parameter, overrides) for name, parameter in declared.items()}
    for name in overrides:
        if not node.has_parameter(name) and not name.startswith(QOS_OVERRIDES):
            if similar := meant(name, declared):
                raise ConfigurationError(f'parameter {name}: unknown, did you mean {similar}?')
            node.get_logger().warning(f'parameter {name}: unknown, so it does nothing')
    values = kind(**first)
    node.add_post_set_parameters_callback(take)
    _refuse_values_of_no_type(node)
    return values


def _declare(node: Node, parameter: Parameter, overrides: dict[str, Any]) -> Any:
    """Declare one parameter and return its value."""
    no_texts = parameter.default == []  # rclpy would take them for no bytes
    default = rclpy.parameter.Parameter.Type.STRING_ARRAY if no_texts else parameter.default
    try:
        value = node.declare_parameter(parameter.name, default, descriptor(parameter)).value
    except ParameterException:
        given = overrides[parameter.name].value
        raise ConfigurationError(
            f'parameter {parameter.name}: expected {parameter.expected()}, got {given!r}'
        ) from None
    if value is None:  # an empty list, whose type nobody knows
        value = []
        try:
            parameter.check(value)
        except ValueError as error:
            raise ConfigurationError(str(error)) from None
        node._parameters[parameter.name] = rclpy.parameter.Parameter(
            parameter.name, rclpy.parameter.Parameter.Type.STRING_ARRAY, value
        )
    return value


def _refuse_values_of_no_type(node: Node) -> None:
    """Refuse values of a type that does not exist, at which rclpy would end the process."""
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
