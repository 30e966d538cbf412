# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""A node starts where ROS can write no log file."""

import pytest

from tactile_push.nodes.ros.log_files import WITHOUT, log_arguments

VARIABLES = 'ROS_LOG_DIR', 'ROS_HOME', 'HOME'


@pytest.fixture
def environment(monkeypatch):
    for name in VARIABLES:
        monkeypatch.delenv(name, raising=False)
    return monkeypatch


@pytest.mark.parametrize('name', VARIABLES)
def test_each_of_the_variables_names_a_folder(environment, tmp_path, capsys, name):
    environment.setenv(name, str(tmp_path / 'new'))
    assert log_arguments('node') == []
    assert capsys.readouterr().err == ''
    assert (tmp_path / 'new').is_dir()


@pytest.mark.parametrize('name', VARIABLES)
def test_folder_that_cannot_be_made_is_said_in_one_line(environment, tmp_path, capsys, name):
    (tmp_path / 'file').write_text('')
    environment.setenv(name, str(tmp_path / 'file'))
    assert log_arguments('node') == WITHOUT
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith(f'node: no log file: {tmp_path / "file"}')


@pytest.mark.parametrize('value', [None, ''])
def test_nothing_that_names_a_folder_is_said_in_one_line(environment, capsys, value):
    if value is not None:
        environment.setenv('HOME', value)
    assert log_arguments('node') == WITHOUT
    assert capsys.readouterr().err == (
        'node: no log file: none of ROS_LOG_DIR, ROS_HOME and HOME names a folder\n'
    )
