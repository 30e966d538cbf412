# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""A node as a process: starts, spins, and ends without a traceback."""

import atexit
import inspect
import os
import re
import signal
import sys
from contextlib import suppress
from itertools import pairwise
from types import FrameType
from typing import NoReturn

import rclpy
from rclpy.exceptions import ParameterException
from rclpy.executors import ExternalShutdownException
from rclpy.logging import LoggingSeverity, set_logger_level
from rclpy.node import Node
from rclpy.signals import SignalHandlerOptions
from rclpy.utilities import remove_ros_args

from tactile_push.nodes.ros.executor import Executor
from tactile_push.nodes.ros.last_resort import exit_after
from tactile_push.nodes.ros.log_files import log_arguments
from tactile_push.nodes.ros.parameters import ConfigurationError
from tactile_push.small_files import is_named_pipe
from tactile_push.streams import complain

SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)  # by a person, a manager, a terminal
FAREWELL = 2.0  # for the middleware to leave [s]; a healthy one takes a fraction of it


def run(node_class: type[Node]) -> int:
    """Run a node until SIGINT, SIGTERM, SIGHUP or the end of its context, and end the process.

    The exit status is 0 when it is done, 1 when a file or device failed; if there was no node, 2 is
    returned after bad input. rclpy does not handle the signals, because its handler ends the
    context before the node could send a last command. If the middleware hangs at the end, the
    process ends without it.
    """
    stopping = False

    def stop(signum: int, frame: FrameType | None) -> None:
        nonlocal stopping
        stopping = True

    for signum in SIGNALS:
        if signum != signal.SIGHUP or signal.getsignal(signum) != signal.SIG_IGN:  # as nohup asks
            signal.signal(signum, stop)
    for option, file in pairwise(sys.argv):
        if option == '--params-file' and is_named_pipe(file):  # rcl would wait
            return _refuse(node_class, f'{file}: expected a file, got a named pipe')
    try:
        set_logger_level('rcl', LoggingSeverity.FATAL)  # it logs what it also throws
        foreign = remove_ros_args(sys.argv)[1:]
        args = [*sys.argv, *log_arguments(node_class.NAME)]
        rclpy.init(args=args, signal_handler_options=SignalHandlerOptions.NO)
    except Exception as error:  # rcl's own exception types are not public
        return _refuse(node_class, _brief(error))
    set_logger_level('rcl', LoggingSeverity.UNSET)
    try:
        if foreign:
            raise ConfigurationError(
                f'unknown argument {foreign[0]}, expected --ros-args -p NAME:=VALUE'
            )
        node = node_class()
    except (ConfigurationError, ParameterException) as error:  # the latter of use_sim_time
        status = _refuse(node_class, str(error))
        exit_after(FAREWELL, status)
        rclpy.try_shutdown()
        return status
    # rclpy seeks the caller of the first message that is logged in the files of all modules, and
    # Python remembers them. On a loaded machine that takes half a second, which no tick has.
    inspect.getmodule(run.__code__)
    executor = Executor()
    executor.add_node(node)
    status = 0
    try:
        with node.handle:  # in use, so the middleware loses the node only at the end of the block
            try:
                try:
                    while not stopping and rclpy.ok():
                        executor.spin_once()
                except ExternalShutdownException:
                    pass
                finally:
                    executor.shutdown()
                    node.destroy_node()
            except OSError as error:
                status = 1
                where = '' if error.filename is None else f'{error.filename}: '
                complain(node_class.NAME, f'{where}{error.strerror or error}')
            # Fast DDS built for an old C library waits for ever, without letting go of the
            # interpreter, if it is just being told of another node that comes or goes.
            exit_after(FAREWELL, status)
    finally:
        rclpy.try_shutdown()
        # Python restores its own handlers at exit, and an impatient second signal would show.
        for signum in SIGNALS:
            signal.signal(signum, signal.SIG_IGN)
    _leave(status)


def _leave(status: int) -> NoReturn:
    """End this process, and leave to the system what Python would take apart piece by piece.

    That takes most of the time in which a node ends, and a tenth of a second of it Fast DDS waits.
    """
    atexit._run_exitfuncs()
    for stream in (sys.stdout, sys.stderr):
        with suppress(OSError):
            stream.flush()
    os._exit(status)


def _brief(error: Exception) -> str:
    """Return rcl's words on one line, without the places in its source."""
    words = ' '.join(re.sub(r',\s+at \S+:\d+', '', str(error)).split())
    return words.replace('Failed to parse ROS arguments', 'bad ROS arguments')


def _refuse(node_class: type[Node], reason: str) -> int:
    complain(node_class.NAME, reason)
    return 2
