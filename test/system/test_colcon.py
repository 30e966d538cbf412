# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
EXECUTABLES = {
    'tactile_push',
    'sensor_driver',
    'wrench_sensor',
    'camera_sensor',
    'contact_geometry',
    'active_sensing',
    'push_controller',
    'finger_servo',
    'sim_plant',
    'mujoco_plant',
    'experiment',
    'bag_recorder',
    'bag_player',
    'live_page',
}


def test_colcon_build_gives_runnable_executables(tmp_path: Path):
    colcon = Path(sys.executable).with_name('colcon')
    if not colcon.exists():
        pytest.skip('colcon is not installed')
    package = tmp_path / 'src' / 'tactile_push'
    skipped = shutil.ignore_patterns(
        '.*', '__pycache__', 'out', 'build', 'install', 'log', '*.egg-info'
    )
    shutil.copytree(ROOT, package, ignore=skipped)
    build = subprocess.run(
        [str(colcon), 'build', '--event-handlers', 'console_direct+'],
        cwd=tmp_path,
        env={**os.environ, 'COLCON_LOG_PATH': str(tmp_path / 'log')},
        capture_output=True,
        text=True,
        timeout=300,
    )
    assert build.returncode == 0, build.stdout + build.stderr
    install = tmp_path / 'install' / 'tactile_push'
    executables = install / 'lib' / 'tactile_push'
    assert {file.name for file in executables.iterdir()} == EXECUTABLES
    share = install / 'share' / 'tactile_push'
    for file in (
        'package.xml',
        'config/block.yaml',
        'config/disk.yaml',
        'config/hardware.yaml',
        'config/loopback.xml',
        'launch/demo.launch.py',
        'launch/finger.launch.py',
        'urdf/finger.urdf.xacro',
    ):
        assert (share / file).exists(), file
    assert (install / 'share/ament_index/resource_index/packages/tactile_push').exists()
    (library,) = install.glob('lib/python*/site-packages')
    for room in ('report', 'watching'):
        assets = {file.name for file in (ROOT / 'tactile_push' / room / 'assets').iterdir()}
        installed = library / 'tactile_push' / room / 'assets'
        assert {file.name for file in installed.iterdir()} == assets != set()
    environment = {**os.environ, 'PYTHONPATH': str(library)}
    for name in EXECUTABLES:
        run = subprocess.run(
            [str(executables / name), '--help'],
            cwd=tmp_path,
            env=environment,
            capture_output=True,
            text=True,
            timeout=60,
        )
        assert run.returncode == 0, run.stderr
        assert name in run.stdout
