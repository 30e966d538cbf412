# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
import threading
from types import SimpleNamespace

import pytest

pytest.importorskip('rclpy')

import numba

from tactile_push.nodes.ros.compiling import compiling
from tactile_push.nodes.ros.diagnostics import WARN, Health

PATIENCE = 30.0  # [s]


class Heard:
    """A node and its diagnostics, of which the test hears the log and what is announced."""

    def __init__(self):
        self.log = []
        self.healths = []
        self.warned = threading.Event()

    def get_logger(self):
        return SimpleNamespace(info=self.log.append)

    def announce(self, health):
        self.healths.append(health)
        self.warned.set()


def test_node_that_compiles_logs_it_once_and_warns_meanwhile():
    heard = Heard()
    with compiling(heard, heard):
        assert numba.njit(lambda x: x + 1.0)(1.0) == 2.0
        assert numba.njit(lambda x: x + 2.0)(1.0) == 3.0
        assert heard.warned.wait(PATIENCE)
    assert heard.log == ['compiling; this start takes longer than later ones']
    assert set(map(repr, heard.healths)) == {repr(Health(WARN, 'compiling'))}
    told = len(heard.healths)
    assert not any(thread.name == 'compiling' for thread in threading.enumerate())
    assert len(heard.healths) == told


def test_node_that_need_not_compile_says_nothing():
    heard = Heard()
    with compiling(heard, heard):
        pass
    assert (heard.log, heard.healths) == ([], [])


def test_node_that_cannot_start_ends_its_warning():
    heard = Heard()
    with pytest.raises(ValueError, match='no such rig'), compiling(heard, heard):
        numba.njit(lambda x: x + 3.0)(1.0)
        raise ValueError('no such rig')
    assert not any(thread.name == 'compiling' for thread in threading.enumerate())
