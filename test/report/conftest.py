# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""A run that is known in closed form, and a browser for the tests of pages."""

import os
import shutil

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


@pytest.fixture(scope='module')
def browser():
    """Return a headless Chromium that ends with the module's tests."""
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


@pytest.fixture(scope='module')
def run(tmp_path_factory):
    """Return what a report makes of the bag of `support.pushed_bag`."""
    from support.pushed_bag import run_of, write_bag  # which needs the messages of ROS

    return run_of(write_bag(tmp_path_factory.mktemp('run') / 'pushed'))
