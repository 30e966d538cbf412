# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The paper's figures, made once and only when a test asks for them."""

import pytest

from support.papers_figures import MAKERS


class Figures(dict):
    """Figures by number."""

    def __missing__(self, number):
        self[number] = MAKERS[number]()
        return self[number]


@pytest.fixture(scope='session')
def figures():
    return Figures()
