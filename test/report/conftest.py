# Copyright 2026 The tactile_push authors
#
# Licensed under the Apache License, Version 2.0 (the "License");
# you may not use this file except in compliance with the License.
# You may obtain a copy of the License at
#
#     http://www.apache.org/licenses/LICENSE-2.0
#
# Unless required by applicable law or agreed to in writing, software
# distributed under the License is distributed on an "AS IS" BASIS,
# WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
# See the License for the specific language governing permissions and
# limitations under the License.
"""A browser for the tests of pages."""

import os
import shutil

import pytest
from playwright.sync_api import sync_playwright

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
    executable = next(filter(None, map(shutil.which, NAMES)), None)
    if executable is None:
        reason = f'no browser: none of {", ".join(NAMES)} is installed'
        if os.environ.get('CI') == 'true':
            pytest.fail(reason)
        pytest.skip(reason)
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=executable, args=ARGUMENTS)
        yield browser
        browser.close()
