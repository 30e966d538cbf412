# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Ports for browsers, and those that cannot be had."""

import socket

import pytest

from tactile_push.watching.listening import listen


def test_any_free_port_takes_connections():
    with (
        listen('127.0.0.1', 0) as listening,
        socket.create_connection(listening.getsockname(), 5.0) as there,
    ):
        assert there.getpeername() == listening.getsockname()


def test_other_protocol_is_taken_from_the_address():
    with listen('::1', 0) as listening:
        assert listening.getsockname()[0] == '::1'


def test_a_port_that_was_served_can_be_had_again_at_once():
    with listen('127.0.0.1', 0) as listening:
        port = listening.getsockname()[1]
        with socket.create_connection(('127.0.0.1', port), 5.0):
            server, _ = listening.accept()
            server.close()  # first, so that the port waits here
    listen('127.0.0.1', port).close()


def test_what_cannot_be_had_is_refused_by_its_name():
    with listen('127.0.0.1', 0) as listening:
        port = listening.getsockname()[1]
        with pytest.raises(OSError, match='in use') as refused:
            listen('127.0.0.1', port)
        assert refused.value.filename == f'127.0.0.1:{port}'
    with pytest.raises(OSError) as refused:
        listen('192.0.2.1', 0)  # of nobody, by RFC 5737
    assert refused.value.filename == '192.0.2.1:0'
    with pytest.raises(OSError) as refused:
        listen('no name', 0)
    assert (refused.value.filename, bool(refused.value.strerror)) == ('no name:0', True)
