# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import contextlib
import importlib
import itertools
import json
import math
import re
import socket
import sys
import time

import pytest

from faults import FAULTS
from faults.checks import wrong_commands, wrong_contacts, wrong_readings, wrong_velocities
from faults.doctored import NAMED, examining
from faults.machine import HoldUps
from faults.parameter_rows import wrong_values
from faults.promise import (
    PLAIN,
    BrokenPromiseError,
    Fault,
    Outcome,
    Setup,
)
from faults.proxy import Corruption, DeviceProxy, Sent
from faults.table import Runner
from tactile_push.devices import Sentence, SentenceStream, encode
from tactile_push.parameters import Parameter
from tactile_push.tactile import NO_CONTACT, Reading

OTHER = Setup(relay='joint_states')
TRIES = 5  # of a row on a busy machine
LATE = re.compile(r'^\d+ ms, more than|; the machine stood still for')


class FakeBench:
    """Stands in for nodes: pushes unless told not to."""

    def __init__(self, setup, log):
        self.setup = setup
        self.reaction = None
        self.fingers = [self]
        self.pushes = self.middle = True
        self.found = []
        self.wrong_end = []
        self._log = log
        log.append('start')

    def push(self):
        if not self.pushes:
            raise BrokenPromiseError('does not move')

    def is_in_the_middle(self):
        return self.middle

    def complaints(self):
        return self.found

    def close(self):
        self._log.append('close')
        return self.wrong_end


@pytest.fixture
def log():
    """List what happens to rigs."""
    return []


@pytest.fixture
def runner(log):
    with Runner(lambda setup: FakeBench(setup, log)) as runner:
        yield runner


def row(inject=lambda bench: None, within=None, **how):
    return Fault('rigged', 'nothing happens', inject, within, **how)


def reacting(seconds):
    def inject(bench):
        bench.reaction = seconds

    return inject


def breaking(bench):
    bench.reaction = 0.1
    raise BrokenPromiseError('something else happened')


def test_reaction_within_its_bound_is_held(runner):
    outcome = runner.run(row(reacting(0.4), 0.45))
    assert (outcome.held, outcome.reaction_ms, outcome.within_ms) == (True, 400.0, 450.0)


@pytest.mark.parametrize(
    ('inject', 'reason'),
    [
        (reacting(0.46), '460 ms, more than 450 ms'),
        (reacting(None), 'no reaction was measured'),
        (breaking, 'something else happened'),
    ],
)
def test_promise_that_is_not_kept_is_broken(runner, inject, reason):
    outcome = runner.run(row(inject, 0.45))
    assert not outcome.held
    assert outcome.broken == [reason]


def test_what_must_not_be_heard_breaks_any_promise(runner):
    def inject(bench):
        bench.found = ['command of nan']

    assert runner.run(row(inject)).broken == ['command of nan']


def test_row_that_is_broken_while_the_machine_stood_still_is_measured_again(runner, log):
    attempts = []

    def stand_still(bench):
        attempts.append(bench)
        runner._hold_ups.longest = 0.5
        if len(attempts) == 1:
            raise BrokenPromiseError('too late')

    assert runner.run(row(stand_still)).held
    assert len(attempts) == 2
    attempts.clear()

    def stand_still_and_break(bench):
        attempts.append(bench)
        runner._hold_ups.longest = 0.5
        raise BrokenPromiseError('too late')

    outcome = runner.run(row(stand_still_and_break))
    assert len(attempts) == 3
    assert outcome.broken == ['too late', 'attempt 3; the machine stood still for 500 ms']
    assert len(runner.outcomes) == 2


def test_standstill_of_the_machine_is_noticed():
    hold_ups = HoldUps()
    try:
        hold_ups.restart()
        interval = sys.getswitchinterval()
        sys.setswitchinterval(10.0)  # nobody else gets the processor
        end = time.monotonic() + 0.3
        while time.monotonic() < end:
            pass
        sys.setswitchinterval(interval)
        deadline = time.monotonic() + 5.0
        while hold_ups.longest < 0.2 and time.monotonic() < deadline:
            time.sleep(0.01)
        assert 0.2 < hold_ups.longest < 5.0
        hold_ups.restart()
        assert hold_ups.longest < 0.2
    finally:
        hold_ups.close()


def test_rig_serves_rows_until_one_is_broken_or_the_last_or_needs_another(runner, log):
    assert runner.run(row()).held
    assert runner.run(row(last=True)).held
    assert log == ['start', 'close']
    assert not runner.run(row(breaking)).held
    assert runner.run(row()).held
    assert log == ['start', 'close'] * 2 + ['start']
    assert runner.run(row(setup=OTHER)).held
    assert log == ['start', 'close'] * 3 + ['start']
    runner.finish()
    assert log == ['start', 'close'] * 4


def test_rig_whose_object_has_gone_far_is_used_up_and_not_broken(runner, log):
    def use_up(bench):
        bench.middle = False

    assert runner.run(row(use_up)).held
    assert runner.run(row()).held
    assert log == ['start', 'close', 'start']


def test_rig_that_never_pushes_is_a_broken_row():
    def start(setup):
        bench = FakeBench(setup, [])
        bench.pushes = False
        return bench

    with Runner(start) as runner:
        assert runner.run(row()).broken == ['before the fault: does not move']


def test_wrong_end_of_the_nodes_belongs_to_the_last_row(runner):
    def inject(bench):
        bench.wrong_end = ['sensor_driver: exit status 1']

    runner.run(row())
    runner.run(row(inject))
    runner.finish()
    assert [outcome.held for outcome in runner.outcomes] == [True, False]


def test_everything_ends_when_a_row_throws(log):
    def interrupt(bench):
        raise KeyboardInterrupt

    with (
        contextlib.suppress(KeyboardInterrupt),
        Runner(lambda setup: FakeBench(setup, log)) as runner,
    ):
        runner.run(row(interrupt))
    assert log == ['start', 'close']


@pytest.fixture
def main(monkeypatch, capsys, log):
    """Return a function that runs the command on rows: exit status, standard output, error."""
    module = importlib.import_module('faults.__main__')
    monkeypatch.setattr(module, 'Runner', lambda: Runner(lambda setup: FakeBench(setup, log)))
    monkeypatch.setattr(module, 'interrupt_once', lambda: None)

    def run(faults, *arguments):
        monkeypatch.setattr(module, 'FAULTS', faults)
        monkeypatch.setattr(sys, 'argv', ['faults', *map(str, arguments)])
        capsys.readouterr()
        try:
            status = module.main()
        except SystemExit as end:
            status = end.code
        return status, *capsys.readouterr()

    return run


def test_command_ends_with_0_if_all_is_held_and_writes_json(main, tmp_path):
    file = tmp_path / 'faults.json'
    status, out, _ = main([row(reacting(0.1), 0.45)], '--json', file)
    assert status == 0
    assert 'held' in out
    assert 'BROKEN' not in out
    assert json.loads(file.read_text()) == {
        'faults': [
            {
                'fault': 'rigged',
                'promise': 'nothing happens',
                'within_ms': 450.0,
                'reaction_ms': 100.0,
                'broken': [],
                'held': True,
            }
        ]
    }


def test_command_ends_with_1_and_says_why_if_a_promise_is_broken(main, tmp_path):
    file = tmp_path / 'faults.json'
    status, out, _ = main([row(), row(breaking, 0.45)], '--json', file)
    assert status == 1
    assert out.count('BROKEN') == 1
    assert 'rigged: something else happened' in out
    assert [r['held'] for r in json.loads(file.read_text())['faults']] == [True, False]


def test_wrong_end_alone_ends_the_command_with_1(main):
    def inject(bench):
        bench.wrong_end = ['traceback in sensor_driver.log']

    assert main([row(inject)])[0] == 1


def test_ctrl_c_ends_the_command_with_130_and_all_nodes(main, log):
    def interrupt(bench):
        raise KeyboardInterrupt

    assert main([row(interrupt)])[0] == 130
    assert log == ['start', 'close']


def test_only_chooses_rows_by_their_names_and_list_runs_none(main, log):
    faults = [Fault(name, 'nothing', breaking) for name in ('one', 'two', 'two more')]
    status, out, _ = main(faults, '--list', '--only', 'two')
    assert (status, out) == (0, 'two: nothing\ntwo more: nothing\n')
    assert log == []
    status, out, _ = main(faults, '--only', 'one')
    assert (status, out.count('BROKEN')) == (1, 1)


@pytest.mark.parametrize(
    ('arguments', 'reason'),
    [
        (('--only', 'nonsense'), "got 'nonsense'"),
        (('--json', '/nowhere/x.json'), '/nowhere/x.json'),
        (('--nonsense',), '--nonsense'),
    ],
)
def test_bad_usage_ends_the_command_with_2(main, log, arguments, reason):
    status, out, err = main([row()], *arguments)
    assert (status, out, log) == (2, '', [])
    assert reason in err


def test_every_row_has_a_name_of_its_own_and_a_promise():
    names = [fault.name for fault in FAULTS]
    assert len(set(names)) == len(names)
    assert all(fault.promise for fault in FAULTS)
    asked_for = (
        'driver killed',
        'driver stopped, continued',
        'plant killed',
        'controller killed',
        'geometry killed',
        'sentences cut off',
        '1 % of bytes corrupted',
        '10 % of bytes corrupted',
        '50 % of bytes corrupted',
        'sensor stuck',
        'readings not a number',
        'readings off the hemisphere',
        'joint states missing',
        'joint states not finite',
        'joint states jump',
        'joint states late',
        'ahead',
        'back',
        'parameters wrong at the start',
        'parameters wrong at run time',
        'lifecycle: every order',
        'two controllers',
        'pair: ',
        'processors busy',
        'SIGINT',
        'SIGTERM',
        'deactivated',
        'workspace limit',
        'contact not finite',
        'servo killed',
        'servo deactivated',
        'servo without commands',
        'servo without joint states',
        'servo with a drive that stands',
        'joint limit',
        'goal not finite',
        'goal cancelled',
        'contact lost while placing',
        'contact lost on purpose',
        'contact that does not come back',
        'another object while placing',
        'active_sensing killed while placing',
    )
    assert [word for word in asked_for if not any(word in name for name in names)] == []


def test_commands_are_finite_bounded_and_without_a_kick():
    assert wrong_commands([0.0, 0.004, 0.008, 0.0, -0.005, 0.0]) == []
    assert wrong_commands([0.008]) == ['step of 8.0 mm/s']
    assert wrong_commands([0.008], before=0.004) == []
    assert wrong_commands([math.nan, math.inf]) == ['command of nan', 'command of inf']
    assert wrong_commands([0.018, 0.022], before=0.016) == ['command of 22.0 mm/s']


def test_velocities_of_joints_are_finite_bounded_and_of_both():
    assert wrong_velocities([(0.0, -2.0), (1.9, 0.0)]) == []
    wrong = [(2.1, 0.0), (0.0, math.nan), (0.0,), (0.0, 0.0, 0.0)]
    assert len(wrong_velocities(wrong)) == 4
    assert wrong_velocities([(0.0, math.inf)]) == ['joint velocities of [0.0, inf]']


def test_readings_are_those_that_were_sent_once_and_fresh():
    sent = {n: Sent(float(n), Reading(0.1 * n, 1.0)) for n in (1, 2, 3)}
    known = set()
    assert wrong_readings([(1.1, 1, 0.1, 1.0), (2.1, 2, 0.2, 1.0)], sent, known) == []
    assert known == {1, 2}
    assert wrong_readings([(2.2, 2, 0.2, 1.0)], sent, known) == ['reading 2 twice']
    assert wrong_readings([(3.4, 3, 0.3, 1.0)], sent, set()) == [
        'reading 400 ms old stamped as new'
    ]
    for other in ((3.1, 3, 0.31, 1.0), (3.1, 3, 0.3, 1.1), (3.1, 4, 0.3, 1.0)):
        (complaint,) = wrong_readings([other], sent, set())
        assert complaint.endswith('that was never sent')


def test_contacts_come_once_from_a_reading():
    readings = {(5, 0), (5, 20_000_000), (6, 0)}
    known = set()
    assert wrong_contacts([(5, 0), (6, 0)], readings, known) == []
    assert wrong_contacts([(6, 0)], readings, known) == ['two contacts with one stamp']
    assert wrong_contacts([(5, 10_000_000)], readings, set()) == ['contact without a reading']
    # Where no readings were heard a contact may follow from one that was not.
    assert wrong_contacts([(4, 0), (5, 500_000_000), (7, 0)], readings, set()) == []


@pytest.mark.parametrize(
    'parameter',
    [
        Parameter('a', 0.5, 'm', 'length', 0.0, 1.0),
        Parameter('b', 3, '', 'count', 0, 5),
        Parameter('c', 'x', '', 'choice', choices=('x', 'y')),
        Parameter('d', True, '', 'switch'),
        Parameter('e', ['x'], '', 'names'),
    ],
)
def test_wrong_values_are_wrong(parameter):
    values = list(wrong_values(parameter))
    assert len(values) >= 6
    for value in values:
        in_range = not isinstance(value, int | float) or (
            parameter.lower <= value <= parameter.upper
        )
        chosen = not parameter.choices or value in parameter.choices
        texts = not isinstance(value, list) or all(type(v) is str for v in value)
        right = type(value) is type(parameter.default) and in_range and chosen and texts
        assert not right


def test_corruption_changes_its_share_of_the_bytes():
    data = bytes(range(256)) * 40
    assert Corruption(0.0)(data) == data
    assert all(a != b for a, b in zip(Corruption(1.0)(data), data, strict=True))
    changed = sum(a != b for a, b in zip(Corruption(0.1)(data), data, strict=True))
    assert 0.08 < changed / len(data) < 0.12
    assert Corruption(0.1)(data) == Corruption(0.1)(data)


class Line:
    """A sensor and a driver at both ends of the proxy."""

    def __init__(self):
        self.listener = socket.create_server(('127.0.0.1', 0))
        self.proxy = DeviceProxy(self.listener.getsockname()[1])
        self.sensor, _ = self.listener.accept()
        self.driver = self.connect()
        self.number = itertools.count()

    def connect(self):
        driver = socket.create_connection(('127.0.0.1', self.proxy.port), 5.0)
        driver.settimeout(5.0)
        return driver

    def send(self):
        self.sensor.sendall(encode(Sentence(next(self.number), Reading(0.0, 1.2))))

    def receive(self):
        """Send readings until the driver, who may not be known yet, gets one."""
        self.driver.settimeout(0.1)
        deadline = time.monotonic() + 5.0
        while time.monotonic() < deadline:
            self.send()
            with contextlib.suppress(TimeoutError):
                return self.driver.recv(4096)
        raise AssertionError('nothing came')

    def close(self):
        self.proxy.close()
        for end in (self.sensor, self.driver, self.listener):
            end.close()


@pytest.fixture
def line():
    line = Line()
    yield line
    line.close()


def test_proxy_numbers_the_readings_and_remembers_them(line):
    (first, *_) = SentenceStream().feed(line.receive())
    number = int(first.normal_force)
    sent = line.proxy.sent[number]
    assert sent.reading == first
    assert 0.0 <= time.monotonic() - sent.at < 5.0
    (second, *_) = SentenceStream().feed(line.receive())
    assert second.normal_force > number


def test_proxy_alters_and_spoils_until_it_is_mended(line):
    line.receive()
    line.proxy.alter = lambda sentence: Sentence(sentence.sequence, NO_CONTACT)
    assert b',V,' in line.receive()
    line.proxy.mend()
    line.proxy.spoil = lambda data: b'noise'
    assert line.receive().startswith(b'noise')
    line.proxy.mend()
    assert line.receive().startswith(b'$PTACT')


def test_unplugged_device_ends_and_is_there_again_when_mended(line):
    line.receive()
    line.proxy.unplug()
    line.driver.settimeout(5.0)
    while line.driver.recv(4096):
        pass
    with pytest.raises(ConnectionRefusedError):
        line.connect()
    line.proxy.mend()
    line.sensor, _ = line.listener.accept()
    deadline = time.monotonic() + 5.0
    while time.monotonic() < deadline:
        with contextlib.suppress(ConnectionRefusedError):
            line.driver = line.connect()
            break
    assert line.receive().startswith(b'$PTACT')


def test_device_goes_with_its_sensor(line):
    line.receive()
    line.sensor.close()
    line.driver.settimeout(5.0)
    while line.driver.recv(4096):
        pass


@pytest.fixture(scope='module')
def found():
    """List what the doctor finds wrong after the fault of a row."""
    return []


@pytest.fixture(scope='module')
def real(found):
    """Return a runner with real nodes, at which the doctor looks, for some rows."""
    with examining(found) as runner:
        yield runner


def test_doctor_looks_at_rows_that_there_are():
    assert set(NAMED) <= {fault.name for fault in FAULTS}


@pytest.mark.parametrize('name', ['driver killed', 'device unplugged', 'another command'])
def test_real_row_is_held_and_the_doctor_names_the_fault(real, found, name):
    (fault,) = [fault for fault in FAULTS if fault.name == name]
    for _ in range(TRIES):
        outcome = real.run(fault)
        if outcome.held:
            break
        # A busy machine may make the nodes late. It never makes them do anything else wrong.
        assert {'late' if LATE.search(words) else words for words in outcome.broken} == {'late'}
    assert outcome.held
    assert 0.0 < outcome.reaction_ms < outcome.within_ms
    assert NAMED[name] in [finding.subject for finding in found]


def test_real_finger_that_nobody_stops_is_a_broken_promise(real):
    outcome = real.run(
        Fault('rigged', 'stops', lambda bench: bench.stopped(time.monotonic(), 1.0), 0.45, PLAIN)
    )
    # A word about a machine that stood still may follow.
    assert outcome.broken[:2] == [
        'waited 1 s in vain for /finger to stop',
        'no reaction was measured',
    ]
    assert isinstance(outcome, Outcome)
