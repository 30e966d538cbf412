# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Short names for the fixtures of `tactile_push.testing`."""

import pytest

from support.browser import launched
from tactile_push.testing import NodeProcesses, Observer, Rig


@pytest.fixture
def nodes(tactile_nodes: NodeProcesses) -> NodeProcesses:
    return tactile_nodes


@pytest.fixture
def observer(tactile_observer: Observer) -> Observer:
    return tactile_observer


@pytest.fixture
def rig(tactile_rig: Rig) -> Rig:
    return tactile_rig


@pytest.fixture(scope='module')
def browser():
    """Return a headless Chromium that ends with the module's tests."""
    with launched() as browser:
        yield browser
