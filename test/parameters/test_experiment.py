# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Where an experiment lets objects go."""

import pytest

from tactile_push.parameters import ExperimentParameters
from tactile_push.parameters.experiment import goals


def test_a_goal_is_a_place_and_an_angle():
    assert goals(ExperimentParameters()) == []
    given = ExperimentParameters(goals=['-0.05 0.1', ' 1e-2  -0.25 '])
    assert goals(given) == [(-0.05, 0.1), (0.01, -0.25)]


@pytest.mark.parametrize('text', ['', '0.1', '0.1 0.2 0.3', 'x theta', '0.1,0.2'])
def test_a_text_of_other_than_two_numbers_is_refused(text):
    with pytest.raises(ValueError, match='^goals: expected texts of two numbers') as refused:
        goals(ExperimentParameters(goals=['0.0 0.0', text]))
    assert str(refused.value).endswith(repr(text))
