# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The device end of the wire: where the simulated sensor's bytes come out."""

import contextlib
import errno
import os
import socket
from typing import Protocol

from tactile_push.devices.device import socket_address


class DeviceServer(Protocol):
    """Something that a sensor driver can open and that sends it bytes."""

    def send(self, data: bytes) -> None:
        """Send bytes to all listeners; a listener that does not keep up loses some."""

    def close(self) -> None:
        """Stop serving."""


def serve(device: str) -> DeviceServer:
    """Start to serve where a sensor driver will connect.

    Parameters
    ----------
    device : str
        socket://host:port to listen on TCP, or a path at which a pseudo terminal appears.

    Returns
    -------
    DeviceServer
        The open server.

    Raises
    ------
    ValueError
        If the device is neither.
    OSError
        If the address or path is in use or not ours.
    """
    if device.startswith('socket:'):
        host, port = socket_address(device)
        if port == 0:  # any free one, which no driver would find
            raise ValueError(f'expected a port from 1 to 65535, got {device!r}')
        return TcpServer(host, port)
    if not os.path.isabs(device):
        raise ValueError(f'expected socket://host:port or an absolute path, got {device!r}')
    return PseudoTerminal(device)


class TcpServer:
    """Sends to every TCP client."""

    def __init__(self, host: str, port: int) -> None:
        try:
            self._listener = socket.create_server((host, port), family=_family(host, port))
        except OSError as error:
            # Name resolution has numbers of its own, below 0, and Python adds to its words.
            named = (error.errno or 0) < 0
            words = str(error.strerror).partition(' (')[0]
            reason = words if named else os.strerror(error.errno or 0)
            place = f'[{host}]' if ':' in host else host
            raise OSError(error.errno, f'{place}:{port}: {reason}') from None
        self._listener.setblocking(False)
        self._clients: list[socket.socket] = []

    def send(self, data: bytes) -> None:
        """Send bytes to all clients, new ones included."""
        self._accept()
        for client in list(self._clients):
            try:
                client.send(data)
            except BlockingIOError:
                pass
            except OSError:
                client.close()
                self._clients.remove(client)

    def close(self) -> None:
        """Close all connections."""
        for server_or_client in (self._listener, *self._clients):
            server_or_client.close()

    def _accept(self) -> None:
        try:
            client, _ = self._listener.accept()
        except OSError:  # nobody is there, has gone again, or no file can be opened at present
            return
        client.setblocking(False)
        client.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self._clients.append(client)


def _family(host: str, port: int) -> socket.AddressFamily:
    """Return IPv6 for a host that has no address of IPv4; OSError if it has none at all."""
    found = socket.getaddrinfo(host, port, type=socket.SOCK_STREAM, flags=socket.AI_PASSIVE)
    families = {family for family, *_ in found}
    return socket.AF_INET if socket.AF_INET in families else socket.AF_INET6


class PseudoTerminal:
    """A serial line without wires, reached through a link at a path of our choice.

    A dangling link at the path, left by a killed process, is replaced.
    """

    def __init__(self, path: str) -> None:
        import pty  # which not every system has, unlike the rest of the module
        import tty

        if os.path.exists(path) or (os.path.lexists(path) and not os.path.islink(path)):
            raise OSError(errno.EEXIST, f'{path}: {os.strerror(errno.EEXIST)}')
        if os.path.lexists(path):
            os.unlink(path)
        self._path = path
        # The far end stays open here, so that the line is there before and between its readers.
        self._near, self._far = pty.openpty()
        tty.setraw(self._far)
        os.set_blocking(self._near, False)
        try:
            os.symlink(os.ttyname(self._far), path)
        except OSError as error:
            os.close(self._near)
            os.close(self._far)
            raise OSError(error.errno, f'{path}: {error.strerror}') from None

    def send(self, data: bytes) -> None:
        """Send bytes down the line; what nobody reads is lost once the line is full."""
        with contextlib.suppress(BlockingIOError):
            os.write(self._near, data)

    def close(self) -> None:
        """Remove the link and the line."""
        with contextlib.suppress(FileNotFoundError):
            os.unlink(self._path)
        os.close(self._near)
        os.close(self._far)
