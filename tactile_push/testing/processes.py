# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The package's nodes as processes, in a ROS domain of their own that ends at this machine."""

import fcntl
import json
import os
import random
import signal
import subprocess
import tempfile
import time
from collections.abc import Mapping
from pathlib import Path
from typing import IO, Any

from tactile_push.parameters import config_file
from tactile_push.testing.fork_server import ForkedNode, fork_node

DOMAINS = range(1, 101)  # ids that need no port among the ephemeral ones
STOP_TIMEOUT = 5.0  # for all processes to end after SIGINT before the rest is killed [s]


class NodeProcesses:
    """Starts nodes and, on leaving the `with` block, stops all of them.

    The nodes talk among themselves alone: discovery stays on this machine, and no two of these
    objects share a ROS `domain`, whichever processes they live in.

    Parameters
    ----------
    folder : path
        Where each node's output goes, as NAME.log, and rcl's own logs.

    Attributes
    ----------
    environment : dict of str to str
        Environment of every process.
    running : dict of str to subprocess.Popen or ForkedNode
        The processes by name.
    """

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self.domain, self._lock = claim_domain()
        self.environment = {
            **os.environ,
            'ROS_DOMAIN_ID': str(self.domain),
            **loopback(),
            'ROS_LOG_DIR': str(folder / 'ros_log'),
        }
        self.running: dict[str, ForkedNode | subprocess.Popen[bytes]] = {}

    def __enter__(self) -> 'NodeProcesses':
        return self

    def __exit__(self, *exception: object) -> None:
        self.stop()

    def start(
        self,
        node: str,
        parameters: Mapping[str, Any] | None = None,
        *,
        config: Path | None = None,
        name: str | None = None,
        arguments: tuple[str, ...] = (),
    ) -> ForkedNode:
        """Start a node.

        Parameters
        ----------
        node : str
            One of the package's nodes.
        parameters : mapping of str to object, optional
            Values of its parameters; they take precedence over the file's.
        config : path, optional
            Parameter file.
        name : str, optional
            What the process is called here, if `node` runs more than once.
        arguments : tuple of str, optional
            More ROS arguments.

        Returns
        -------
        ForkedNode
            The process, with what `subprocess.Popen` has to wait for it and to send it signals.
        """
        name = name or node
        options = ['--ros-args', *arguments]
        if config is not None:
            options += ['--params-file', str(config)]
        for key, value in (parameters or {}).items():
            options += ['-p', f'{key}:={yaml_value(value)}']
        with self.log(name).open('ab') as log:
            process = fork_node(node, options, self.environment, log)
        self.running[name] = process
        return process

    def run(self, name: str, command: list[str]) -> subprocess.Popen[bytes]:
        """Start any program in the nodes' domain.

        Parameters
        ----------
        name, command : str, list of str
            What the process is called here; the program and its arguments.

        Returns
        -------
        subprocess.Popen
            The process, in a session of its own: Ctrl-C at the terminal is for the parent.
        """
        with self.log(name).open('ab') as log:
            process = subprocess.Popen(
                command,
                env=self.environment,
                stdin=subprocess.DEVNULL,
                stdout=log,
                stderr=subprocess.STDOUT,
                start_new_session=True,
            )
        self.running[name] = process
        return process

    def log(self, name: str) -> Path:
        """Return the file that holds what a process has said.

        Parameters
        ----------
        name : str
            Name of the process.

        Returns
        -------
        path
            The file.
        """
        return self._folder / f'{name}.log'

    def stop(self) -> None:
        """Interrupt all processes and wait for their end."""
        for process in self.running.values():
            if process.poll() is None:
                process.send_signal(signal.SIGINT)
        deadline = time.monotonic() + STOP_TIMEOUT
        for process in self.running.values():
            try:
                process.wait(max(0.0, deadline - time.monotonic()))
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
        self._lock.close()


def loopback() -> dict[str, str]:
    """Return the environment in which ROS nodes talk on this machine alone.

    Fast DDS's shared memory, which the discovery range LOCALHOST always brings, is not used:
    whoever joins a domain can hold up everybody's publishing there for a third of a second.
    """
    if not os.environ.get('RMW_IMPLEMENTATION', 'rmw_fastrtps_cpp').startswith('rmw_fastrtps'):
        return {'ROS_AUTOMATIC_DISCOVERY_RANGE': 'LOCALHOST'}
    return {
        'ROS_AUTOMATIC_DISCOVERY_RANGE': 'SYSTEM_DEFAULT',  # as the profile has it
        'FASTRTPS_DEFAULT_PROFILES_FILE': str(config_file('loopback.xml')),
    }


def yaml_value(value: Any) -> str:
    """Return a bool, number, text or list of texts as the command line takes it, in YAML."""
    if isinstance(value, bool):
        return 'true' if value else 'false'
    if isinstance(value, float):
        text = repr(float(value))  # of numpy too
        return {'inf': '.inf', '-inf': '-.inf', 'nan': '.nan'}.get(text, text)
    if isinstance(value, str | list):
        return json.dumps(value)  # which YAML reads as it is
    return str(value)


def claim_domain() -> tuple[int, IO[bytes]]:
    """Return a ROS domain that nobody on this machine gets here too before its lock is closed."""
    for domain in random.sample(DOMAINS, len(DOMAINS)):
        path = Path(tempfile.gettempdir()) / f'tactile_push_domain_{domain}.{os.getuid()}.lock'
        lock = path.open('wb')
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            lock.close()
            continue
        return domain, lock
    raise RuntimeError('all ROS domains are in use')
