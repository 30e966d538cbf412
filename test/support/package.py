# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The tree of the package, for tests of the package as a whole."""

import ast
import functools
import json
import re
import subprocess
import sys
from pathlib import Path

import tactile_push

ROOT = Path(tactile_push.__file__).parent
TREE = ROOT.parent
PARTS = sorted(
    path.parent.name for path in ROOT.glob('*/__init__.py') if '__all__' in path.read_text()
)
ROS = re.compile(
    r'rclpy|launch(_ros)?|ament_\w+|\w+_msgs|rcl_interfaces|builtin_interfaces|std_srvs'
)
# Not every system has these.
POSIX = {'fcntl', 'grp', 'pty', 'pwd', 'resource', 'termios', 'tty'}
OF_POSIX = {'nodes', 'playing', 'recording', 'testing', 'demo'}


@functools.cache
def imports(path, *, at_once=False):
    """Return the names of all modules that a file imports, inside functions too or at once."""
    tree = ast.parse(path.read_text())
    names = set()
    for node in tree.body if at_once else ast.walk(tree):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f'{path}: imports by dots are hard to follow'
            names.add(node.module)
    return frozenset(names)


def imported_by(folder):
    """Return the top-level modules that the files of a folder import."""
    return {name.split('.')[0] for path in folder.rglob('*.py') for name in imports(path)}


def run_python(program):
    """Run a program in a fresh interpreter and return what it prints as JSON."""
    # A bound on hanging: on a loaded machine a program that compiles everything takes minutes.
    done = subprocess.run(
        [sys.executable, '-c', program], capture_output=True, text=True, timeout=600
    )
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)
