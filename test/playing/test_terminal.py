# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The terminal of a small program on a pseudo terminal, with a shell that minds its jobs."""

import contextlib
import os
import pty
import select
import signal
import subprocess
import sys
import termios
import time

import pytest

PATIENCE = 60.0  # [s]
ECHO_AND_LINES = termios.ECHO | termios.ICANON

# Prints what it is told, and the keys as they come; says a line on 'p', ends on 'q', fails on 'x'.
PROGRAM = """
import signal, sys, time
from tactile_push.playing.terminal import Terminal

def stop(signum, frame):
    sys.exit(3)

signal.signal(signal.SIGTERM, stop)
signal.signal(signal.SIGINT, stop)
terminal = Terminal(lambda: print('held', flush=True), lambda: print('released', flush=True))
print('there' if terminal.there else 'not there', flush=True)
while True:
    terminal.show('a line')
    for key in terminal.read_keys():
        print(repr(key), flush=True)
        if key == 'p':
            terminal.say('a saying')
        if key == 'q':
            sys.exit(0)
        if key == 'x':
            raise KeyError('x')
    time.sleep(0.01)
"""

# Starts it as a job: 'f' and 'b' as its argument are foreground and background; tells when the job
# has stopped, lets it go on in the foreground, and says how it ended.
SHELL = f"""
import os, signal, sys
signal.signal(signal.SIGTTOU, signal.SIG_IGN)
signal.signal(signal.SIGTSTP, signal.SIG_IGN)
job = os.fork()
if job == 0:
    os.setpgid(0, 0)
    if sys.argv[1] == 'f':
        os.tcsetpgrp(0, os.getpid())
    signal.signal(signal.SIGTTOU, signal.SIG_DFL)
    signal.signal(signal.SIGTSTP, signal.SIG_DFL)
    os.execv(sys.executable, [sys.executable, '-c', {PROGRAM!r}])
print('job', job, flush=True)
while True:
    _, status = os.waitpid(job, os.WUNTRACED)
    os.tcsetpgrp(0, os.getpid())
    if not os.WIFSTOPPED(status):
        break
    print('stopped by', signal.Signals(os.WSTOPSIG(status)).name, flush=True)
    sys.stdin.readline()
    os.tcsetpgrp(0, job)
    os.killpg(job, signal.SIGCONT)
print('ended with', os.waitstatus_to_exitcode(status), flush=True)
"""


class Shell:
    """A shell on a pseudo terminal, seen from the person's side."""

    def __init__(self, how):
        pid, self.terminal = pty.fork()
        if pid == 0:
            os.execv(sys.executable, [sys.executable, '-c', SHELL, how])
        self.pid = pid
        self.said = ''
        self.before = self.flags()

    def flags(self):
        return termios.tcgetattr(self.terminal)[3] & ECHO_AND_LINES

    def type(self, keys):
        os.write(self.terminal, keys.encode())

    def wait_for(self, words):
        """Wait until something is said, after what was waited for before."""
        self.wait_until(lambda: words in self.said)
        self.said = self.said.split(words, 1)[1]

    def wait_until(self, condition):
        deadline = time.monotonic() + PATIENCE
        while not condition():
            assert time.monotonic() < deadline, self.said
            if select.select([self.terminal], [], [], 0.01)[0]:
                with contextlib.suppress(OSError):  # nobody is left at the other end
                    self.said += os.read(self.terminal, 4096).decode()

    def wait_for_job(self):
        """Give the number of the job's process."""
        self.wait_until(lambda: 'job ' in self.said and '\n' in self.said.split('job ', 1)[1])
        return int(self.said.split('job ', 1)[1].split()[0])

    def close(self):
        for kill in (lambda: os.killpg(self.job, signal.SIGKILL), self.kill_shell):
            with contextlib.suppress(ProcessLookupError, AttributeError):
                kill()
        os.close(self.terminal)
        os.waitpid(self.pid, 0)

    def kill_shell(self):
        os.kill(self.pid, signal.SIGKILL)


@pytest.fixture
def start():
    """Return a maker of shells with their job."""
    shells = []

    def make(how):
        shell = Shell(how)
        shells.append(shell)
        shell.job = shell.wait_for_job()
        return shell

    yield make
    for shell in shells:
        shell.close()


@pytest.fixture
def shell(start):
    """Return a shell whose job has the terminal and gets its keys singly."""
    shell = start('f')
    shell.wait_for('there')
    shell.wait_until(lambda: shell.flags() == 0)
    return shell


def test_keys_come_at_once_and_unseen(shell):
    assert shell.before == ECHO_AND_LINES
    shell.type(' s')
    shell.wait_for("' '")
    shell.wait_for("'s'")
    shell.type('\x1b[C')
    shell.wait_for(repr('\x1b[C'))


@pytest.mark.parametrize(
    ('how', 'status'),
    [
        (lambda shell: shell.type('q'), 0),
        (lambda shell: shell.type('x'), 1),
        (lambda shell: shell.type('\x03'), 3),  # Ctrl-C
        (lambda shell: os.kill(shell.job, signal.SIGTERM), 3),
    ],
    ids=['end', 'exception', 'Ctrl-C', 'SIGTERM'],
)
def test_terminal_is_left_as_it_was_found(shell, how, status):
    how(shell)
    shell.wait_for(f'ended with {status}')
    assert shell.flags() == shell.before


def test_suspended_job_leaves_the_terminal_and_takes_it_again(shell):
    shell.type('\x1a')  # Ctrl-Z
    shell.wait_for('held')
    shell.wait_for('stopped by SIGTSTP')
    assert shell.flags() == shell.before
    shell.type('fg\n')
    shell.wait_for('released')
    shell.wait_until(lambda: shell.flags() == 0)
    shell.type('q')
    shell.wait_for('ended with 0')
    assert shell.flags() == shell.before


def test_job_that_was_stopped_otherwise_takes_the_terminal_again(shell):
    os.kill(shell.job, signal.SIGSTOP)
    shell.wait_for('stopped by SIGSTOP')
    attributes = termios.tcgetattr(shell.terminal)  # as a shell does
    attributes[3] |= ECHO_AND_LINES
    termios.tcsetattr(shell.terminal, termios.TCSANOW, attributes)
    shell.type('fg\n')
    shell.wait_until(lambda: shell.flags() == 0)
    shell.type('q')
    shell.wait_for('ended with 0')
    assert shell.flags() == shell.before


def test_line_that_is_said_stays_above_the_one_that_is_shown(shell):
    shell.wait_for('a line')
    shell.type('p')
    shell.wait_for('\ra saying\x1b[K\r\n\ra line\x1b[K')


def test_job_in_the_background_neither_reads_nor_sets_nor_writes(start):
    shell = start('b')
    shell.wait_for('there')
    shell.type(' ')
    until = time.monotonic() + 1.0
    shell.wait_until(lambda: time.monotonic() > until)
    assert shell.flags() == shell.before
    assert 'stopped' not in shell.said
    assert 'a line' not in shell.said
    assert "' '" not in shell.said
    os.kill(shell.job, signal.SIGTERM)
    shell.wait_for('ended with 3')
    assert shell.flags() == shell.before


def test_line_is_shown_once_and_removed(shell):
    shell.wait_for('\ra line\x1b[K')
    shell.type('q')
    shell.wait_for('\r\x1b[K')
    shell.wait_for('ended with 0')
    assert 'a line' not in shell.said


def test_without_a_terminal_there_is_nothing_to_do():
    done = subprocess.run(
        [sys.executable, '-c', PROGRAM.replace('while True', 'for _ in range(3)')],
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        timeout=PATIENCE,
    )
    assert (done.returncode, done.stdout, done.stderr) == (0, 'not there\n', '')
