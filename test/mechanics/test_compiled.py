# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
import importlib.util

from tactile_push.mechanics.compiled import compilation_announced

SOURCE = """
from tactile_push.mechanics.compiled import compiled

@compiled
def square(x):
    return x * x
"""


def load(path):
    """Return a fresh module from a file, as another process has it."""
    spec = importlib.util.spec_from_file_location('squares', path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_compilation_is_announced_once_and_only_without_machine_code(tmp_path):
    path = tmp_path / 'squares.py'
    path.write_text(SOURCE)
    announced = []
    with compilation_announced(lambda: announced.append('before')):
        squares = load(path)
        assert announced == []
        assert (squares.square(3.0), squares.square(3)) == (9.0, 9)  # compiled for either type
    assert announced == ['before']
    with compilation_announced(lambda: announced.append('again')):
        assert load(path).square(2.0) == 4.0  # from the cache
    assert announced == ['before']


def test_nothing_is_announced_after_the_block(tmp_path):
    path = tmp_path / 'squares.py'
    path.write_text(SOURCE)
    announced = []
    with compilation_announced(lambda: announced.append('before')):
        pass
    load(path).square(1.0)
    assert announced == []
