# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The pages of docs/reference that docs/tables.py makes of the code."""

import runpy
from pathlib import Path

import pytest

DOCS = Path(__file__).resolve().parents[1] / 'docs'
PAGES = runpy.run_path(str(DOCS / 'tables.py'))['PAGES']


@pytest.mark.parametrize('name', PAGES)
def test_page_is_that_of_the_code(name):
    written = (DOCS / 'reference' / name).read_text(encoding='utf-8')
    assert written == PAGES[name](), 'stale: run python docs/tables.py'
