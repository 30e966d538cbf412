# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""A real browser for tests of pages."""

import contextlib
import os
import shutil
import time

import pytest

NAMES = ('chromium', 'chromium-browser', 'google-chrome')
# Alone: without accounts, updates and whatever else it asks the network for.
ARGUMENTS = (
    '--no-sandbox',
    '--disable-gpu',
    '--disable-background-networking',
    '--disable-component-update',
    '--disable-sync',
    '--no-first-run',
    '--disable-quic',
)
DESKTOP = {'width': 1280, 'height': 900}
PHONE = {'width': 320, 'height': 640}
PATIENCE = 30.0  # [s]; a bound on hanging, not an expectation


@contextlib.contextmanager
def launched():
    """Give a headless Chromium; without one the test is skipped, except in CI."""
    playwright = pytest.importorskip('playwright.sync_api', reason='pip install playwright')
    executable = next(filter(None, map(shutil.which, NAMES)), None)
    if executable is None:
        reason = f'no browser: install {", ".join(NAMES[:-1])} or {NAMES[-1]}'
        if os.environ.get('CI') == 'true':
            pytest.fail(reason)
        pytest.skip(reason)
    with playwright.sync_playwright() as started:
        browser = started.chromium.launch(executable_path=executable, args=ARGUMENTS)
        yield browser
        browser.close()


def wait_for(page, condition):
    """Wait until an expression is true; the page's policy forbids to do so in the page itself."""
    deadline = time.monotonic() + PATIENCE
    while not page.evaluate(condition):
        assert time.monotonic() < deadline, condition
        page.wait_for_timeout(20)
