# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Record topics and parameters: what the recorder and the experiment have in common."""

import json
from collections.abc import Sequence
from contextlib import ExitStack
from importlib.metadata import version
from typing import Any

from rclpy.node import Node

from tactile_push.bags import BagWriter
from tactile_push.interface import PARAMETERS_NOTE, VERSION_NOTE
from tactile_push.recording.parameter_notes import ParameterNotes
from tactile_push.recording.recorder import Recorder


class Recording:
    """Records topics, the software's version and the parameters of the package's nodes.

    `topics` are those to record, None for all; `close` closes the writer.
    """

    def __init__(self, node: Node, topics: Sequence[str] | None, writer: BagWriter) -> None:
        self._writer = writer
        writer.note(VERSION_NOTE, version('tactile_push'))
        self.recorder = Recorder(node, topics, writer)
        ParameterNotes(node, self._note_parameters)

    def close(self) -> None:
        """Record what has been received, and finish the bag."""
        with ExitStack() as stack:
            stack.callback(self._writer.close)
            self.recorder.stop()

    def _note_parameters(self, parameters: dict[str, dict[str, Any]]) -> None:
        # JSON has no arrays of ROS (written as lists) and no infinity (written as Python does).
        text = json.dumps(parameters, default=list)
        self._writer.note(PARAMETERS_NOTE, text)
