# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Record topics into a bag."""

import sys
import time
from contextlib import ExitStack
from datetime import datetime

from rclpy.node import Node

from tactile_push.bags import BagWriter
from tactile_push.interface import BAG_RECORDER
from tactile_push.nodes.ros.diagnostics import OK, WARN, Diagnostics, Health
from tactile_push.nodes.ros.parameters import ConfigurationError, declare, refusing
from tactile_push.nodes.ros.process import run
from tactile_push.parameters import BagRecorderParameters
from tactile_push.recording.recording import Recording


class BagRecorder(Node):
    """Node: topics in, a bag out.

    It ends with exit status 1 if the bag cannot be written any more; what was written before
    stays readable. Its health is a warning as long as there is no message.
    """

    NAME = BAG_RECORDER

    def __init__(self) -> None:
        super().__init__(self.NAME)
        p = declare(self, BagRecorderParameters)
        self._output = p.output or f'tactile_push_{datetime.now():%Y_%m_%d-%H_%M_%S}'
        self._check_topics(p.topics)
        with refusing('output'):
            self._writer = BagWriter(
                self._output,
                compression=p.compression,
                max_bytes=p.max_size,
                max_duration=p.max_duration,
            )
        self.get_logger().info(f'recording into {self._output}')
        self._began = time.monotonic()
        self._recording = Recording(self, None if p.all else p.topics, self._writer)
        self._diagnostics = Diagnostics(self, self._health, lambda: self._recording.recorder.counts)

    def destroy_node(self) -> None:
        """Finish the bag, log how much was recorded, and end."""
        with ExitStack() as stack:
            stack.callback(super().destroy_node)
            stack.callback(self._log_summary)  # even if the disk fails again
            self._recording.close()

    def _check_topics(self, topics: list[str]) -> None:
        if not topics:
            raise ConfigurationError('parameter topics: expected the name of a topic, got []')
        for topic in topics:
            try:
                self.resolve_topic_name(topic)
            except RuntimeError:  # rclpy's RCLError, which is not public
                raise ConfigurationError(
                    f'parameter topics: expected names of topics, got {topic!r}'
                ) from None

    def _health(self) -> Health:
        values = {
            'bag': self._output,
            'files': self._writer.file_count,
            'size [B]': self._writer.byte_count,
        }
        if not self._writer.message_count:
            return Health(WARN, 'no message recorded yet', values)
        return Health(OK, 'recording', values)

    def _log_summary(self) -> None:
        writer, duration = self._writer, time.monotonic() - self._began
        bound = 'at most ' if writer.failed else ''
        self.get_logger().info(
            f'recorded {bound}{writer.message_count} messages in {duration:.1f} s, '
            f'{writer.byte_count / 1e6:.3f} MB, into {self._output}'
        )


def main() -> int:
    """Run the node as a process."""
    return run(BagRecorder)


if __name__ == '__main__':
    sys.exit(main())
