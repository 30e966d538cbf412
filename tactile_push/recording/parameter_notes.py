# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Ask the package's nodes for their parameters."""

from collections.abc import Callable
from functools import partial
from typing import Any

from rcl_interfaces.srv import GetParameters, ListParameters
from rclpy.client import Client
from rclpy.clock import Clock
from rclpy.clock_type import ClockType
from rclpy.node import Node
from rclpy.parameter import parameter_value_to_python
from rclpy.task import Future

from tactile_push.interface import NODES

LOOK_PERIOD = 0.2  # between looks for new nodes [s]; picked: a look asks the graph only
ASK_AGAIN = 5  # looks, a second, after which a missing answer is lost


class ParameterNotes:
    """The parameters of the package's nodes, as each node gives them when it is first seen.

    The asking node leaves itself out, and any node that does not answer. Whenever a node has
    answered, `noted` gets all that is known: parameters by full node name, without its leading
    slash. With `again` a node that was gone and comes back is asked again.
    """

    def __init__(
        self,
        node: Node,
        noted: Callable[[dict[str, dict[str, Any]]], None],
        *,
        again: bool = False,
    ) -> None:
        self._node = node
        self._again = again
        self._answered: set[str] = set()
        self._noted = noted
        self._known: dict[str, dict[str, Any]] = {}
        self._questions: dict[str, _Question] = {}
        steady_clock = Clock(clock_type=ClockType.STEADY_TIME)
        node.create_timer(LOOK_PERIOD, self._look, clock=steady_clock)

    def _look(self) -> None:
        there = {
            f'{namespace.rstrip("/")}/{name}'
            for name, namespace in self._node.get_node_names_and_namespaces()
            if name in NODES
        } - {self._node.get_fully_qualified_name()}
        if self._again:
            self._answered &= there
        for full_name in there - self._questions.keys() - self._answered:
            self._questions[full_name] = _Question(self._node, full_name)
        for full_name, question in list(self._questions.items()):
            if question.answer is not None:
                self._known[full_name] = question.answer
                self._answered.add(full_name)
                self._noted({name.lstrip('/'): values for name, values in self._known.items()})
            if question.answer is not None or full_name not in there:
                question.close()
                del self._questions[full_name]
            else:
                question.ask()


class _Question:
    """Asks one node for the names of its parameters, and then for their values."""

    def __init__(self, node: Node, full_name: str) -> None:
        self._node = node
        self._lister = node.create_client(ListParameters, f'{full_name}/list_parameters')
        self._getter = node.create_client(GetParameters, f'{full_name}/get_parameters')
        self._looks = 0
        self._asked: list[tuple[Client, Future]] = []
        self.answer: dict[str, Any] | None = None

    def ask(self) -> None:
        """Ask as soon as the node offers its services, and again if no answer comes.

        If the node discovers the question before it discovers who reads the answer, the answer is
        lost.
        """
        if not (self._lister.service_is_ready() and self._getter.service_is_ready()):
            return
        if self._looks % ASK_AGAIN == 0:
            for client, future in self._asked:
                client.remove_pending_request(future)
            self._asked = []
            self._call(self._lister, ListParameters.Request(), self._on_names)
        self._looks += 1

    def _call(self, client: Client, request: Any, answered: Callable[[Future], None]) -> None:
        future = client.call_async(request)
        self._asked.append((client, future))
        future.add_done_callback(answered)

    def close(self) -> None:
        """Ask no more."""
        self._node.destroy_client(self._lister)
        self._node.destroy_client(self._getter)

    def _on_names(self, future: Future) -> None:
        names = future.result().result.names
        request = GetParameters.Request(names=names)
        self._call(self._getter, request, partial(self._on_values, names))

    def _on_values(self, names: list[str], future: Future) -> None:
        values = map(parameter_value_to_python, future.result().values)
        self.answer = dict(zip(names, values, strict=True))
