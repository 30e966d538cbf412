# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import pytest

from tactile_push.control.placing import ENDS, REASONS, REFUSALS, STAGES, VERDICTS
from tactile_push.control.placing.stages import FAILURES, RELEASED


@pytest.mark.parametrize('words', [STAGES, REFUSALS, VERDICTS, REASONS])
def test_each_code_has_words_of_its_own(words):
    assert len(set(words)) == len(words)


def test_a_goal_ends_in_a_stage_and_only_one_end_lets_go():
    assert set(STAGES) > ENDS
    assert FAILURES < ENDS
    assert RELEASED in ENDS - FAILURES
    # Code 0 is that of nothing: no goal, no refusal, no reason.
    assert STAGES[0] not in ENDS
    assert REFUSALS[0] == REASONS[0] == ''
