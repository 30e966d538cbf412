# Copyright 2026 The tactile_push authors
#
# Licensed under the Apache License, Version 2.0 (the "License");
# you may not use this file except in compliance with the License.
# You may obtain a copy of the License at
#
#     http://www.apache.org/licenses/LICENSE-2.0
#
# Unless required by applicable law or agreed to in writing, software
# distributed under the License is distributed on an "AS IS" BASIS,
# WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
# See the License for the specific language governing permissions and
# limitations under the License.
"""The `tactile_push` command."""

import os
import signal
import sys
from collections.abc import Sequence
from types import FrameType
from typing import NoReturn

from tactile_push.cli import (
    demo,
    diff,
    estimate,
    figures,
    info,
    play,
    record,
    replay,
    report,
    simulate,
)
from tactile_push.cli.arguments import Parser


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command.

    Parameters
    ----------
    arguments : sequence of str, optional
        The words after `tactile_push`; those of the command line by default.

    Returns
    -------
    int
        Exit status: 0 done, 1 the job ran and failed, 2 bad input.
    """
    parser = Parser(
        prog='tactile_push',
        description='Turn and locate objects by pushing them with one tactile finger.',
    )
    commands = parser.add_subparsers(required=True, metavar='COMMAND')
    for command in (
        demo,
        simulate,
        figures,
        record,
        play,
        replay,
        estimate,
        info,
        diff,
        report,
    ):
        command.add(commands)
    options = parser.parse_args(arguments)
    for signum in (signal.SIGTERM, signal.SIGHUP):
        if signal.getsignal(signum) != signal.SIG_IGN:  # as nohup asks
            signal.signal(signum, _terminate)
    try:
        status = options.run(options)
        sys.stdout.flush()
        return status
    except KeyboardInterrupt:
        return 130
    except BrokenPipeError:  # whoever reads the output has read enough
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 1


def _terminate(signum: int, frame: FrameType | None) -> NoReturn:
    """End as after an exception, so that what was started is stopped."""
    sys.exit(128 + signum)
