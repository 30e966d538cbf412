# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
import sys

import pytest

from tactile_push.needs_mujoco import mujoco_is_missing


def test_mujoco_that_is_installed_is_not_spoken_of(capsys):
    pytest.importorskip('mujoco', reason="pip install 'tactile_push[mujoco]'")
    assert not mujoco_is_missing('mujoco_plant')
    assert capsys.readouterr() == ('', '')


def test_who_needs_mujoco_says_how_to_get_it(capsys, monkeypatch):
    monkeypatch.setitem(sys.modules, 'mujoco', None)
    assert mujoco_is_missing('mujoco_plant')
    assert capsys.readouterr() == (
        '',
        "mujoco_plant: needs MuJoCo: pip install 'tactile_push[mujoco]'\n",
    )
