# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest

from tactile_push import demo
from tactile_push.interface import EXPERIMENT


@pytest.fixture
def follow(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    """Return a function that follows an experiment which says some words and hangs."""
    log = tmp_path / 'experiment.log'
    sleeping = subprocess.Popen([sys.executable, '-c', 'input()'], stdin=subprocess.PIPE)
    nodes = SimpleNamespace(running={EXPERIMENT: sleeping}, log=lambda name: log)

    def run(said: str, start: float, stall: float) -> list[int]:
        log.write_text(said)
        monkeypatch.setattr(demo, 'START_TIMEOUT', start)
        monkeypatch.setattr(demo, 'STALL_TIMEOUT', stall)
        steps: list[int] = []
        demo._follow(nodes, steps.append)
        return steps

    yield run
    sleeping.kill()
    sleeping.communicate()


def test_nodes_have_longer_to_the_first_step_than_between_steps(follow):
    assert demo.START_TIMEOUT > 2 * demo.STALL_TIMEOUT
    with pytest.raises(demo.DemoError, match='no step within 0.3 s, in which the nodes also comp'):
        follow('recording\n', start=0.3, stall=0.0)


def test_demonstration_that_stalls_after_a_step_says_after_which(follow):
    with pytest.raises(demo.DemoError, match='no progress for 0.1 s after step 7'):
        follow('recording\n7\n', start=600.0, stall=0.1)
