# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import subprocess
import sys

import pytest

pytest.importorskip('rclpy')

PATIENCE = 60.0  # [s]
HOLD = 'ctypes.PyDLL(None).sleep(30)'  # with the interpreter's lock, so that no thread runs


def end(seconds, status, then):
    """Return the exit status of a process that is to end with one, and what it does meanwhile."""
    program = f"""
import ctypes, sys
from tactile_push.nodes.ros.last_resort import exit_after

exit_after({seconds}, {status})
{then}
"""
    return subprocess.run([sys.executable, '-c', program], timeout=PATIENCE).returncode


@pytest.mark.parametrize('status', [0, 2])
@pytest.mark.parametrize('seconds', [0.1, 1.1])
def test_process_that_does_not_come_back_ends(seconds, status):
    assert end(seconds, status, f'{HOLD}\nsys.exit(7)') == status


def test_process_that_ends_earlier_ends_as_it_does():
    assert end(PATIENCE, 0, 'sys.exit(7)') == 7
