# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What a demonstration makes of nodes that end early or stand still."""

import contextlib
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest

from tactile_push.demo import running
from tactile_push.interface import EXPERIMENT
from tactile_push.parameters import LivePageParameters
from tactile_push.watching.listening import listen


class Nodes:
    """Nodes of which the logs and the exit statuses are known; None for one that runs.

    The experiment writes a line of `lines` each time its log is read, and ends after the last.
    """

    def __init__(self, folder, statuses, lines=()):
        self.folder = folder
        self.lines = list(lines)
        self.running = {name: SimpleNamespace(poll=lambda s=s: s) for name, s in statuses.items()}
        self.running['experiment'] = SimpleNamespace(poll=self.poll)
        for name in self.running:
            (folder / f'{name}.log').write_text('')

    def log(self, name):
        log = self.folder / f'{name}.log'
        if name == 'experiment' and self.lines:
            log.write_text(f'{log.read_text()}{self.lines.pop(0)}\n')
        return log

    def poll(self):
        return None if self.lines else 0


def test_every_step_is_told_once_until_the_experiment_ends(tmp_path):
    told = []
    lines = ['waiting for the controller', '10', '10', '20']
    running.follow_experiment(Nodes(tmp_path, {'sim_plant': None}, lines), told.append)
    assert told == [10, 20]


@pytest.mark.parametrize(
    ('log', 'words'), [('first\nlast line\n', 'last line'), ('', 'without a word')]
)
def test_node_that_ends_early_fails_the_demonstration_with_its_last_line(tmp_path, log, words):
    nodes = Nodes(tmp_path, {'sim_plant': None, 'sensor_driver': 1}, ['10'] * 100)
    nodes.log('sensor_driver').write_text(log)
    with pytest.raises(running.DemoError, match=f'^sensor_driver ended: {words}$'):
        running.follow_experiment(nodes, lambda steps: None)


def test_page_is_told_of_once_and_its_end_is_none_of_the_demonstration(tmp_path):
    nodes = Nodes(tmp_path, {'sim_plant': None, 'live_page': 1}, ['10', '20', '30'])
    nodes.log('live_page').write_text('[INFO]: showing the nodes on http://127.0.0.1:8765/\n')
    told, shown = [], []
    running.follow_experiment(nodes, told.append, shown.append)
    assert (told, shown) == ([10, 20, 30], ['http://127.0.0.1:8765/'])


def test_page_that_never_comes_is_not_told_of(tmp_path):
    nodes = Nodes(tmp_path, {'live_page': 2}, ['10', '20'])
    nodes.log('live_page').write_text('live_page: parameter host, port: Address already in use\n')
    told = []
    running.follow_experiment(nodes, told.append, pytest.fail)
    assert told == [10, 20]


def test_page_has_another_port_if_its_own_is_taken():
    pytest.importorskip('aiohttp', reason="pip install 'tactile_push[watch]'")
    settings = LivePageParameters()
    with contextlib.ExitStack() as stack:
        with contextlib.suppress(OSError):  # somebody has taken it already
            stack.enter_context(listen(settings.host, settings.port))
        assert running.page_port() not in (None, 0, settings.port)


def test_without_its_library_there_is_no_page(monkeypatch):
    monkeypatch.setitem(sys.modules, 'aiohttp', None)
    assert running.page_port() is None


@pytest.fixture
def follow(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    """Return a function that follows an experiment which says some words and hangs."""
    log = tmp_path / 'experiment.log'
    sleeping = subprocess.Popen([sys.executable, '-c', 'input()'], stdin=subprocess.PIPE)
    nodes = SimpleNamespace(running={EXPERIMENT: sleeping}, log=lambda name: log)

    def run(said: str, start: float, stall: float) -> list[int]:
        log.write_text(said)
        monkeypatch.setattr(running, 'START_TIMEOUT', start)
        monkeypatch.setattr(running, 'STALL_TIMEOUT', stall)
        steps: list[int] = []
        running.follow_experiment(nodes, steps.append)
        return steps

    yield run
    sleeping.kill()
    sleeping.communicate()


def test_nodes_have_longer_to_the_first_step_than_between_steps(follow):
    assert running.START_TIMEOUT > 2 * running.STALL_TIMEOUT
    with pytest.raises(running.DemoError, match='no step within 0.3 s, in which'):
        follow('recording\n', start=0.3, stall=0.0)


def test_demonstration_that_stalls_after_a_step_says_after_which(follow):
    with pytest.raises(running.DemoError, match='no progress for 0.1 s after step 7'):
        follow('recording\n7\n', start=600.0, stall=0.1)
