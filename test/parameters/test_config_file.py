# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import tactile_push
from tactile_push.parameters import config_file

TREE = Path(tactile_push.__file__).parents[1]


@pytest.mark.parametrize('name', ['block.yaml', 'disk.yaml', 'loopback.xml', 'demo.rviz'])
def test_file_of_the_checkout_is_found(name):
    assert config_file(name) == TREE / 'config' / name
    assert config_file(name).is_file()


@pytest.mark.parametrize('packages', ['lib/python3.12/site-packages', 'Lib/site-packages'])
def test_installed_file_is_found_under_the_prefix(tmp_path, packages):
    here = tmp_path / packages / 'tactile_push/parameters'
    here.mkdir(parents=True)
    shutil.copy(TREE / 'tactile_push/parameters/config_file.py', here)
    installed = tmp_path / 'share/tactile_push/config/block.yaml'
    installed.parent.mkdir(parents=True)
    installed.touch()
    program = "from config_file import config_file; print(config_file('block.yaml'))"
    done = subprocess.run(
        [sys.executable, '-c', program], cwd=here, capture_output=True, text=True, timeout=60
    )
    assert (done.stdout, done.stderr) == (f'{installed.resolve()}\n', '')


def test_file_that_is_not_installed_is_refused_by_name():
    with pytest.raises(FileNotFoundError, match=r'nothing\.yaml: expected in share/tactile_push'):
        config_file('nothing.yaml')
