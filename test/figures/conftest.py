# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The paper's figures, made once and only when a test asks for them."""

import functools

import pytest

from support.papers_figures import MAKERS
from tactile_push.figures import gains


@pytest.fixture(scope='session', autouse=True)
def maps_made_once():
    """Compute each map of the gains once: `test_batch.py` tests that rollouts repeat to the bit."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(gains, 'settle_steps', functools.cache(gains.settle_steps))
        yield


class Figures(dict):
    """Figures by number."""

    def __missing__(self, number):
        self[number] = MAKERS[number]()
        return self[number]


@pytest.fixture(scope='session')
def figures():
    return Figures()
