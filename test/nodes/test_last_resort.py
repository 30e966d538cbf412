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
from tactile_push.nodes.last_resort import exit_after

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
