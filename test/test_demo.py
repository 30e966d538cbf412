# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What the demonstration makes of its results, and of nodes that end early or stand still."""

import contextlib
import math
import subprocess
import sys
from contextlib import nullcontext
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from support.demo_results import results
from tactile_push import demo
from tactile_push.control import PUSHING, STATES
from tactile_push.interface import CONTROLLER_STATE, EXPERIMENT, SENSING_STATE, TRUE_STATE
from tactile_push.parameters import LivePageParameters
from tactile_push.watching.listening import listen


def test_json_has_it():
    block, disk = (one.as_json() for one in results(None).values())
    assert (block['known_step'], disk['known_step']) == (None, 0)
    assert (block['settle_step'], block['ticks_lost'], block['wall_seconds']) == (192, 0, 10.0)
    # (17) by hand for phi = 1.44 and theta = -10 degrees.
    expected = -0.02375 / math.tan(1.44 + math.radians(10.0))
    assert block['d_lower'] == block['d_upper'] == pytest.approx(expected)
    assert list(block) == [
        'settle_step',
        'theta_final',
        'phi_final',
        'd_final',
        'd_lower',
        'd_upper',
        'known_step',
        'theta_range',
        'phi_range',
        'ticks_lost',
        'wall_seconds',
    ]


def test_theta_that_counts_is_the_true_one_at_each_step(monkeypatch, tmp_path):
    time = 0.1 * np.arange(1, 501)
    pushing = np.full(500, float(STATES.index(PUSHING)))
    desired = np.full(500, math.radians(-10.0))
    noise = math.radians(5.0) * (-1.0) ** np.arange(500)
    states = {'time': time, 'state': pushing, 'theta': desired + noise, 'theta_desired': desired}
    states |= {'phi': np.full(500, 1.4)}
    # The truth comes twice a period, the last at the time of the step; it is far off for 2 s.
    moments = np.repeat(time, 2) - np.tile([0.05, 0.0], 500)
    far = math.radians(20.0) * (moments < 2.04)
    truth = {
        'time': moments,
        'theta': math.radians(-10.0) + far,
        'd': np.linspace(0.0, 0.006, 1000),
    }
    sensed = {'time': time, 'd_lower': np.zeros(500), 'd_upper': np.ones(500)}
    tables = {CONTROLLER_STATE: states, TRUE_STATE: truth, SENSING_STATE: sensed}
    monkeypatch.setattr(demo, 'BagReader', lambda bag: nullcontext())
    monkeypatch.setattr(demo, 'topics_of', lambda reader, namespace: {})
    monkeypatch.setattr(demo, 'read_tables', lambda reader, topics: (tables, {}))
    result, theta, _ = demo._evaluate(demo.RIGS['block'], tmp_path, 1.0)
    assert result.push.settle_step == 20
    assert theta[[18, 19, 20]] == pytest.approx(np.radians([10.0, 10.0, -10.0]))
    assert result.d_final == 0.006


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
    demo._follow(Nodes(tmp_path, {'sim_plant': None}, lines), told.append)
    assert told == [10, 20]


@pytest.mark.parametrize(
    ('log', 'words'), [('first\nlast line\n', 'last line'), ('', 'without a word')]
)
def test_node_that_ends_early_fails_the_demonstration_with_its_last_line(tmp_path, log, words):
    nodes = Nodes(tmp_path, {'sim_plant': None, 'sensor_driver': 1}, ['10'] * 100)
    nodes.log('sensor_driver').write_text(log)
    with pytest.raises(demo.DemoError, match=f'^sensor_driver ended: {words}$'):
        demo._follow(nodes, lambda steps: None)


def test_page_is_told_of_once_and_its_end_is_none_of_the_demonstration(tmp_path):
    nodes = Nodes(tmp_path, {'sim_plant': None, 'live_page': 1}, ['10', '20', '30'])
    nodes.log('live_page').write_text('[INFO]: showing the nodes on http://127.0.0.1:8765/\n')
    told, shown = [], []
    demo._follow(nodes, told.append, shown.append)
    assert (told, shown) == ([10, 20, 30], ['http://127.0.0.1:8765/'])


def test_page_that_never_comes_is_not_told_of(tmp_path):
    nodes = Nodes(tmp_path, {'live_page': 2}, ['10', '20'])
    nodes.log('live_page').write_text('live_page: parameter host, port: Address already in use\n')
    told = []
    demo._follow(nodes, told.append, pytest.fail)
    assert told == [10, 20]


def test_page_has_another_port_if_its_own_is_taken():
    pytest.importorskip('aiohttp', reason="pip install 'tactile_push[watch]'")
    settings = LivePageParameters()
    with contextlib.ExitStack() as stack:
        with contextlib.suppress(OSError):  # somebody has taken it already
            stack.enter_context(listen(settings.host, settings.port))
        assert demo._page_port() not in (None, 0, settings.port)


def test_without_its_library_there_is_no_page(monkeypatch):
    monkeypatch.setitem(sys.modules, 'aiohttp', None)
    assert demo._page_port() is None


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
