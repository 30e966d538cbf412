# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
import sys

import pytest

from tactile_push.needs_aiohttp import aiohttp_is_missing


def test_aiohttp_that_is_installed_is_not_spoken_of(capsys):
    pytest.importorskip('aiohttp', reason="pip install 'tactile_push[watch]'")
    assert not aiohttp_is_missing('live_page')
    assert capsys.readouterr() == ('', '')


def test_who_needs_aiohttp_says_how_to_get_it(capsys, monkeypatch):
    monkeypatch.setitem(sys.modules, 'aiohttp', None)
    assert aiohttp_is_missing('live_page')
    assert capsys.readouterr() == (
        '',
        "live_page: needs aiohttp: pip install 'tactile_push[watch]'\n",
    )
