# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The pytest plugin as users load it, and the tutorial's test as it is written there."""

import re
import subprocess
import sys
from importlib.metadata import entry_points
from pathlib import Path

import pytest

PLUGIN = 'tactile_push.testing.plugin'
TUTORIAL = Path(__file__).resolve().parents[2] / 'docs' / 'tutorials' / 'testing.md'
TIMEOUT = 240.0  # [s]


def run_pytest(folder, *arguments):
    """Run pytest as a user does, with no configuration of ours in sight."""
    return subprocess.run(
        [sys.executable, '-m', 'pytest', '-p', PLUGIN, '-p', 'no:cacheprovider', *arguments],
        cwd=folder,
        capture_output=True,
        text=True,
        timeout=TIMEOUT,
    )


def test_entry_point_has_the_name_of_the_module_so_that_it_is_loaded_once():
    setup = (Path(__file__).resolve().parents[2] / 'setup.py').read_text()
    assert "'pytest11': [f'{NAME}.testing.plugin = {NAME}.testing.plugin']" in setup
    installed = {e.name: e.value for e in entry_points(group='pytest11')}
    assert installed.get(PLUGIN, PLUGIN) == PLUGIN


def test_loading_the_plugin_imports_nothing_heavy(tmp_path):
    (tmp_path / 'test_light.py').write_text(
        'import sys\n\n\n'
        'def test_light():\n'
        f'    assert {PLUGIN!r} in sys.modules\n'
        "    heavy = {'rclpy', 'numba', 'matplotlib', 'plotly', 'geometry_msgs'}\n"
        '    assert not heavy & set(sys.modules)\n'
    )
    done = run_pytest(tmp_path, '-q')
    assert done.returncode == 0, done.stdout


def test_without_rclpy_the_fixtures_skip_and_say_why(tmp_path):
    (tmp_path / 'conftest.py').write_text("import sys\n\nsys.modules['rclpy'] = None\n")
    (tmp_path / 'test_rig.py').write_text('def test_rig(tactile_rig):\n    tactile_rig.start()\n')
    done = run_pytest(tmp_path, '-rs')
    assert done.returncode == 0, done.stdout
    assert '1 skipped' in done.stdout
    assert 'rclpy is not installed' in done.stdout


def test_fixtures_are_documented(tmp_path):
    listed = run_pytest(tmp_path, '--fixtures', '-q').stdout
    for fixture in ('tactile_nodes', 'tactile_observer', 'tactile_rig'):
        # The folder of a checkout may have such a name, too: a fixture begins a line.
        words = re.search(rf'^{fixture} -- .*\n +(.*)', listed, re.MULTILINE)[1]
        assert words != 'no docstring available'
        assert f'`{fixture}`' in TUTORIAL.read_text()


def test_test_of_the_tutorial_passes_as_it_is_written_there(tmp_path):
    pytest.importorskip('rclpy')
    example = re.search(r'```python\n(.*?)```', TUTORIAL.read_text(), re.DOTALL)[1]
    (tmp_path / 'test_my_controller.py').write_text(example)
    done = run_pytest(tmp_path, '-q')
    assert done.returncode == 0, done.stdout
    assert '1 passed' in done.stdout


def test_controller_that_does_not_turn_the_edge_fails_with_the_condition_in_words(tmp_path):
    pytest.importorskip('rclpy')
    example = re.search(r'```python\n(.*?)```', TUTORIAL.read_text(), re.DOTALL)[1]
    assert '-0.03 * theta' in example
    example = example.replace('-0.03 * theta', '0.0')
    example = example.replace("to stay so')", "to stay so', patience=3.0)")
    (tmp_path / 'test_my_controller.py').write_text(example)
    done = run_pytest(tmp_path, '-q')
    assert done.returncode == 1, done.stdout
    assert 'waited 3 s in vain for the edge to be straight and to stay so' in done.stdout
