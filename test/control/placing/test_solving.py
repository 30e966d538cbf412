# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import numpy as np
import pytest

from tactile_push.control.placing.solving import solve


def test_it_solves_as_numpy_does():
    root = np.random.default_rng(0).normal(size=(5, 5))
    matrix, vector = root @ root.T, np.arange(5.0)
    expected = np.linalg.solve(matrix, vector)
    assert solve(matrix, vector)
    assert vector == pytest.approx(expected)


def test_it_says_that_a_system_is_not_positive_definite():
    assert not solve(np.array([[1.0, 2.0], [2.0, 1.0]]), np.ones(2))
