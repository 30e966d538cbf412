# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""A process that imports the nodes once and starts each node as a copy of itself.

A copy has nothing to import and no machine code to load, for which a node started by itself needs
up to a second of a core. Otherwise it is a process like any other.
"""

import atexit
import contextlib
import functools
import gc
import importlib
import json
import os
import signal
import socket
import subprocess
import sys
import threading
from collections.abc import Mapping
from typing import IO

from tactile_push.interface import NODES

LONGEST = 1 << 20  # request, with arguments and environment; more than the kernel lets pass [byte]


class ForkedNode:
    """A node's process; what it has in common with `subprocess.Popen` means the same."""

    def __init__(self, node: str, watcher: socket.socket) -> None:
        self._node = node
        self._watcher = watcher
        self.pid = self._hear('pid')
        self.returncode: int | None = None

    def _hear(self, what: str) -> int:
        heard = self._watcher.recv(32).decode()
        if not heard.startswith(what):
            raise RuntimeError(f'{self._node}: the process that starts the nodes has ended')
        return int(heard.removeprefix(what))

    def wait(self, timeout: float | None = None) -> int:
        """Return the exit status once the process has ended."""
        if self.returncode is None:
            self._watcher.settimeout(timeout)
            try:
                self.returncode = self._hear('status')
            except (BlockingIOError, TimeoutError):
                raise subprocess.TimeoutExpired(self._node, timeout or 0.0) from None
            self._watcher.close()
        return self.returncode

    def poll(self) -> int | None:
        """Return the exit status, None while the process runs."""
        try:
            return self.wait(0.0)
        except subprocess.TimeoutExpired:
            return None

    def send_signal(self, signum: int) -> None:
        """Send a signal to the process unless it has ended."""
        if self.poll() is None:
            os.kill(self.pid, signum)

    def kill(self) -> None:
        """End the process at once."""
        self.send_signal(signal.SIGKILL)


def fork_node(
    node: str, arguments: list[str], environment: Mapping[str, str], log: IO[bytes]
) -> ForkedNode:
    """Start a node, in a session of its own, with its output in `log`."""
    watcher, report = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
    request = json.dumps([node, arguments, dict(environment), os.getcwd()]).encode()
    requests, _ = _server()
    with report, contextlib.suppress(BrokenPipeError):  # of which the node's silence tells
        socket.send_fds(requests, [request], [log.fileno(), report.fileno()])
    return ForkedNode(node, watcher)


@functools.cache
def _server() -> tuple[socket.socket, subprocess.Popen[bytes]]:
    """Start the server of this process, which ends with this process, however that ends."""
    ours, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
    with theirs:
        server = subprocess.Popen(
            [sys.executable, '-m', 'tactile_push.testing.fork_server'],
            stdin=theirs.fileno(),
            stdout=subprocess.DEVNULL,
            start_new_session=True,
        )
    atexit.register(server.wait)
    atexit.register(server.terminate)
    return ours, server


def serve(requests: socket.socket) -> int:
    """Fork a node for each request; return 0 at their end, in a copy the node's exit status."""
    for signum in (signal.SIGINT, signal.SIGTERM):  # before a node runs it has nothing to stop
        signal.signal(signum, lambda *_: os._exit(0))
    nodes = {node: importlib.import_module(f'tactile_push.nodes.{node}') for node in NODES}
    _load_machine_code()
    gc.freeze()  # what the copies share stays shared
    signal.signal(signal.SIGCHLD, signal.SIG_IGN)  # nobody waits for the watchers
    while True:
        request, files, _, _ = socket.recv_fds(requests, LONGEST, 2)
        if not request:
            return 0
        if os.fork() == 0:
            break
        for file in files:
            os.close(file)
    requests.detach()  # standard input, for which there is nothing to read in a node
    log, report = files
    with socket.socket(fileno=report) as reported:
        _watch_a_copy(reported)
        node, arguments, environment, folder = json.loads(request)
        os.setsid()
        os.chdir(folder)
        os.environ.clear()
        os.environ.update(environment)
        nothing = os.open(os.devnull, os.O_RDWR)
        for stream, file in enumerate((nothing, log, log)):
            os.dup2(file, stream)
        os.close(nothing)
        os.close(log)
        reported.send(b'pid %d' % os.getpid())
    sys.argv = [node, *arguments]
    return int(nodes[node].main())


def _watch_a_copy(reported: socket.socket) -> None:
    """Return in a copy of this process; wait for its end, report how it ended, and end.

    The copy ends, too, when whoever asked for it has ended, however that ended.
    """
    signal.signal(signal.SIGCHLD, signal.SIG_DFL)
    copy = os.fork()
    if copy:
        arguments = reported, copy
        threading.Thread(target=_end_with_the_asker, args=arguments, daemon=True).start()
        _, status = os.waitpid(copy, 0)
        with contextlib.suppress(BrokenPipeError):  # whoever asked for the node may be gone
            reported.send(b'status %d' % os.waitstatus_to_exitcode(status))
        os._exit(0)


def _end_with_the_asker(reported: socket.socket, copy: int) -> None:
    """Wait until nobody listens to the report any more, and end the copy as a manager would."""
    with contextlib.suppress(OSError):
        reported.recv(1)
    with contextlib.suppress(ProcessLookupError):  # it may have ended by itself
        os.kill(copy, signal.SIGTERM)


def _load_machine_code() -> None:
    """Compute once what the plant and active sensing compile or load at their start."""
    from tactile_push.parameters.active_sensing import ActiveSensingParameters, compile_sensing
    from tactile_push.parameters.sim_plant import SimPlantParameters, rig_config
    from tactile_push.simulation import Rig

    Rig(rig_config(SimPlantParameters())).step(0.0, 1.0)
    compile_sensing(ActiveSensingParameters())


if __name__ == '__main__':
    sys.exit(serve(socket.socket(fileno=sys.stdin.fileno())))
