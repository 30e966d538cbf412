# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
import json
import math
import signal
import subprocess
import sys
import time
from dataclasses import replace
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from support.interface_checks import topics_as_declared
from support.servoed_loop import servoed_theta
from support.turning_tip import L, R, X, slope, step_response
from support.waiting import wait_for
from tactile_push.bags import BagReader
from tactile_push.cli import main
from tactile_push.control import PUSHING
from tactile_push.demo.turning import STEPS
from tactile_push.interface import (
    CLOCK,
    CONTACT,
    GEOMETRY_STATE,
    PARAMETER_EVENTS,
    PLACE_GOAL,
    PLACE_RELEASE,
    PLACE_STATE,
    RECORDED,
    WRENCH,
)
from tactile_push.pipeline.stamps import stamp_of
from tactile_push.replay import replay
from tactile_push.simulation import JointRig, paper_block

COMMAND = [sys.executable, '-m', 'tactile_push.cli', 'demo', '--json']
PATIENCE = 600.0  # [s]; a bound on hanging, not an expectation
# Recorded topics that nothing here is published on, or nothing of the package's own.
NOT_HERE = {CLOCK, PARAMETER_EVENTS, WRENCH, PLACE_GOAL, PLACE_RELEASE, PLACE_STATE}


@pytest.mark.first
def test_demo_settles_both_rigs_and_leaves_a_picture_and_bags(tmp_path: Path):
    out = tmp_path / 'out'
    run = subprocess.run(
        [*COMMAND, '-o', str(out)], capture_output=True, text=True, timeout=PATIENCE
    )
    assert run.returncode == 0, run.stderr
    has_page = find_spec('aiohttp') is not None
    assert run.stderr.count('to watch: http://127.0.0.1:') == has_page
    rigs = json.loads(run.stdout)['rigs']
    assert set(rigs) == {'block', 'disk'}
    # Near the step response that plane geometry gives for a tip that turns.
    steps = step_response(STEPS)
    theta, phi, d = steps[-1]
    settle_step = max(k for k, row in enumerate(steps) if abs(row[0] + 10.0) > 3.0) + 1
    assert abs(rigs['block']['settle_step'] - settle_step) <= 5
    assert math.degrees(rigs['block']['theta_final']) == pytest.approx(theta, abs=0.5)
    assert math.degrees(rigs['block']['phi_final']) == pytest.approx(phi, abs=1.0)
    assert rigs['block']['d_final'] == pytest.approx(d, abs=0.0002)
    assert rigs['disk']['settle_step'] is not None
    # Active sensing knows d while the object turns, the paper's method when it translates, after
    # 400 steps; of a disk there is nothing to find.
    assert 0 < rigs['block']['known_step'] < rigs['block']['settle_step']
    assert rigs['disk']['known_step'] == 0
    for rig in rigs.values():
        assert rig['d_lower'] <= rig['d_upper']
        assert rig['ticks_lost'] == 0
        assert rig['wall_seconds'] > 0.0
    # The true contact is inside the bounds by (17) but for the last bit of turning, and for the
    # tip's turning: (17) takes the commanded velocity for that of the finger's surface.
    block = rigs['block']
    surface = R * abs(slope(X)) / abs(math.tan(block['phi_final']))  # of it sideways, in V_Y
    off = 1e-4 + L * surface
    assert block['d_lower'] - off <= block['d_final'] <= block['d_upper'] + off
    assert (out / 'history.png').read_bytes().startswith(b'\x89PNG')
    for name in rigs:
        assert (out / name / 'metadata.yaml').exists()
        assert {*RECORDED} - NOT_HERE <= topics_as_declared(out / name)
        with BagReader(out / name) as bag:
            (comparison,) = replay(bag, out=tmp_path / f'{name} again')
        assert len(comparison.ticks) > 400
        assert not comparison.different()
        _readings_are_sent_before_their_contacts(out / name)
        if name == 'block':
            theta = np.array([tick.theta for tick in comparison.ticks if tick.state == PUSHING])
            same = JointRig(replace(paper_block(), tip_turns=True))
            assert np.degrees(np.abs(theta - servoed_theta(same, len(theta)))).max() < 0.5
        assert len(comparison.sensed) > 400
        assert comparison.sensed[0].time == comparison.ticks[0].time  # it missed none
        again = str(tmp_path / f'{name} again')
        sensed = ('/active_sensing/state', '/object_pose')
        assert main(['diff', str(out / name), again, '--topics', *sensed]) == 0
        (figures,) = _estimated(out / name)
        assert figures['known_step'] == pytest.approx(rigs[name]['known_step'], abs=3)
        assert figures['inside_guaranteed'] == 1.0
        assert figures['inside'] > 0.9
        assert figures['contradictions'] == figures['forgotten'] == []


def _readings_are_sent_before_their_contacts(bag: Path) -> None:
    """Check that, wherever the recording ended, it would have the readings that a tick used."""
    readings: dict[tuple[int, int], int] = {}
    with BagReader(bag) as reader:
        for message in reader.messages([f'/{CONTACT}', f'/{GEOMETRY_STATE}']):
            stamp = stamp_of(reader.decode(message))
            if message.topic == f'/{GEOMETRY_STATE}':
                readings.setdefault(stamp, message.publish_time)
            elif readings:
                assert readings[stamp] <= message.publish_time


def _estimated(bag: Path) -> list[dict[str, Any]]:
    assert main(['estimate', str(bag), '--json', str(bag.parent / 'estimate.json')]) == 0
    return json.loads((bag.parent / 'estimate.json').read_text())['fingers']


@pytest.mark.parametrize(
    ('stop_signal', 'status', 'what', 'bag'),
    [
        (signal.SIGINT, 130, (), 'block'),
        (signal.SIGTERM, 143, ('--place',), 'placed'),
        (signal.SIGHUP, 129, (), 'block'),
    ],
)
def test_interrupted_demo_ends_in_silence_and_leaves_no_process(
    tmp_path: Path, stop_signal: signal.Signals, status: int, what: tuple[str, ...], bag: str
):
    demo = subprocess.Popen(
        [*COMMAND, *what, '-o', str(tmp_path)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        # A shell's background job hands down that it ignores SIGINT.
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    )
    while not (tmp_path / bag).exists():  # made by the recording process
        assert demo.poll() is None
        time.sleep(0.01)
    descendants = _descendants(demo.pid)
    assert len(descendants) >= 6
    demo.send_signal(stop_signal)
    _, said = demo.communicate(timeout=PATIENCE)
    assert demo.returncode == status
    assert 'Traceback' not in said
    wait_for(  # a process that has ended may not be gone yet
        lambda: not any(Path(f'/proc/{pid}').exists() for pid in descendants), 'all to be gone'
    )


def _descendants(pid: int) -> list[int]:
    listing = subprocess.run(['ps', '-eo', 'pid,ppid'], capture_output=True, text=True, check=True)
    pairs = [tuple(map(int, line.split())) for line in listing.stdout.splitlines()[1:]]
    family = [pid]
    for ancestor in family:  # which grows
        family += [child for child, parent in pairs if parent == ancestor]
    return family[1:]


def test_output_that_cannot_be_written_is_bad_input(tmp_path: Path):
    file = tmp_path / 'file'
    file.write_text('')
    run = subprocess.run(
        [*COMMAND, '-o', str(file)], capture_output=True, text=True, timeout=PATIENCE
    )
    assert run.returncode == 2
    assert run.stderr.splitlines()[-1].startswith(f'tactile_push demo: {file}: ')
    assert 'Traceback' not in run.stderr
