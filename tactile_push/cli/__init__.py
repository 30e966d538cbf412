# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The `tactile_push` command: its subcommands, exit statuses and signals."""

import argparse
import logging
import os
import signal
import sys
from collections.abc import Sequence
from types import FrameType
from typing import NoReturn

from tactile_push.cli.arguments import Commands, Parser, Refused
from tactile_push.needs_ros import ros_is_missing
from tactile_push.streams import (
    STANDARD_OUTPUT,
    complain,
    ignore_warnings_that_end,
    is_nowhere,
    prepare_streams,
)

# Exit statuses as shells give them to programs that SIGINT and SIGPIPE end.
INTERRUPTED, READ_ENOUGH = 130, 141


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command.

    Parameters
    ----------
    arguments : sequence of str, optional
        The words after `tactile_push`; those of the command line by default.

    Returns
    -------
    int
        Exit status: 0 done, 1 the job ran and failed, 2 bad input or a file that cannot be read
        or written, 130 interrupted, 141 nobody reads the output any more.
    """
    command = 'tactile_push'
    interrupted = False

    def interrupt(signum: int, frame: FrameType | None) -> NoReturn:
        nonlocal interrupted
        interrupted = True
        raise KeyboardInterrupt

    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, interrupt)
    prepare_streams()
    ignore_warnings_that_end()
    os.environ.pop('MPLBACKEND', None)  # a notebook's, which need not exist here; files need none
    logging.getLogger('matplotlib').setLevel(logging.ERROR)  # it explains where it keeps its fonts
    try:
        name, options = _parse(arguments)
        command = f'tactile_push {name}'
        for signum in (signal.SIGTERM, getattr(signal, 'SIGHUP', signal.SIGTERM)):
            if signal.getsignal(signum) != signal.SIG_IGN:  # as nohup asks
                signal.signal(signum, _terminate)
        if is_nowhere(command):
            return 2
        if vars(options).pop('ros', False) and ros_is_missing(command):
            return 2
        status = options.run(options)
        sys.stdout.flush()
        return INTERRUPTED if interrupted else status
    except KeyboardInterrupt:
        return INTERRUPTED
    except Exception as error:
        if interrupted:  # what was being imported made another exception of it
            return INTERRUPTED
        if isinstance(error, BrokenPipeError):
            _say_no_more()
            return READ_ENOUGH
        if isinstance(error, Refused):
            if str(error):
                complain(command, error)
            return error.status
        if isinstance(error, MemoryError):
            complain(command, 'not enough memory')
            return 1
        if not isinstance(error, OSError):
            raise
        where = f'{error.filename}: ' if error.filename else ''
        if error.filename == STANDARD_OUTPUT:
            _say_no_more()
        complain(command, f'{where}{error.strerror or error}')
        return 2


def _parse(arguments: Sequence[str] | None) -> tuple[str, argparse.Namespace]:
    parser, commands = command_parser()
    options, unknown = parser.parse_known_args(arguments)
    name = vars(options).pop('command')  # argparse counts it among the options
    if unknown:
        commands.choices[name].error(f'unrecognized arguments: {" ".join(unknown)}')
    return name, options


def command_parser() -> tuple[Parser, Commands]:
    """Return the parser of the command line and its subcommands, for help and documentation."""
    # Imported here, so that an interrupt is silent from the beginning.
    from tactile_push.cli import (
        calibrate,
        demo,
        diff,
        doctor,
        estimate,
        figures,
        identify,
        info,
        play,
        reach,
        record,
        replay,
        report,
        simulate,
        watch,
    )

    parser = Parser(
        prog='tactile_push',
        description='Turn and locate objects by pushing them with one tactile finger.',
    )
    commands = parser.add_subparsers(required=True, metavar='COMMAND', dest='command')
    runs = demo, simulate, reach, figures, doctor, watch, record, play
    for command in (*runs, replay, estimate, info, diff, report, calibrate, identify):
        command.add(commands)
    return parser, commands


def _say_no_more() -> None:
    """Drop what would still be written at exit."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _terminate(signum: int, frame: FrameType | None) -> NoReturn:
    """End as after an exception, so that what was started is stopped."""
    sys.exit(128 + signum)
