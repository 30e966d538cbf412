# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Surroundings in which a process may find itself: variables, streams, limits, folders."""

import os
import resource
import signal
import tempfile
from collections.abc import Callable
from dataclasses import dataclass, field

NOWHERE = '/dev/null/at/all'  # where nobody, not even root, can make a folder
NOT_WRITABLE = '/proc/self'  # for root too
NO_CACHE = {'XDG_CACHE_HOME': NOT_WRITABLE}
GIGABYTE = 10**9


def _nothing() -> None:
    """Change nothing."""


@dataclass(frozen=True)
class Surroundings:
    """What is odd about the place where a process begins."""

    name: str
    #: variables; None removes one
    variables: dict[str, str | None] = field(default_factory=dict)
    #: is called in the process before its program begins
    begin: Callable[[], None] = _nothing


def _closed(*streams: int) -> Callable[[], None]:
    return lambda: [os.close(stream) for stream in streams] and None


def _into(path: str, *streams: int) -> Callable[[], None]:
    def begin() -> None:
        file = os.open(path, os.O_RDWR if os.path.exists(path) and path != '/' else os.O_RDONLY)
        for stream in streams:
            os.dup2(file, stream)

    return begin


def _broken_pipe(*streams: int) -> Callable[[], None]:
    def begin() -> None:
        read, write = os.pipe()
        os.close(read)
        for stream in streams:
            os.dup2(write, stream)

    return begin


def _limit(kind: int, value: int) -> Callable[[], None]:
    return lambda: resource.setrlimit(kind, (value, value))


def _without_a_folder() -> None:
    os.chdir(tempfile.mkdtemp())
    os.rmdir(os.getcwd())


def _small_files() -> None:
    os.environ['PYTHONDONTWRITEBYTECODE'] = '1'
    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    _limit(resource.RLIMIT_FSIZE, 4096)()


def _ignoring(*signals: signal.Signals) -> Callable[[], None]:
    return lambda: [signal.signal(number, signal.SIG_IGN) for number in signals] and None


def _in_folder(path: str) -> Callable[[], None]:
    return lambda: os.chdir(path)


ODD = (
    Surroundings('no HOME', {'HOME': None}),
    Surroundings('HOME that is nowhere', {'HOME': NOWHERE}),
    Surroundings('HOME that is a file', {'HOME': '/etc/passwd'}),
    Surroundings('HOME that is not writable', {'HOME': NOT_WRITABLE, **NO_CACHE}),
    Surroundings('ASCII', {'PYTHONIOENCODING': 'ascii'}),
    Surroundings('Latin-9', {'PYTHONIOENCODING': 'iso8859-15'}),
    Surroundings('locale C', {'LC_ALL': 'C', 'PYTHONUTF8': '0', 'PYTHONCOERCECLOCALE': '0'}),
    Surroundings('locale of nobody', {'LC_ALL': 'xx_YY.bogus', 'LANG': '\udcff'}),
    Surroundings('closed input', begin=_closed(0)),
    Surroundings('closed output', begin=_closed(1)),
    Surroundings('closed error', begin=_closed(2)),
    Surroundings('all closed', begin=_closed(0, 1, 2)),
    Surroundings('output that nobody reads', begin=_broken_pipe(1)),
    Surroundings('error that nobody reads', begin=_broken_pipe(2)),
    Surroundings('neither is read', begin=_broken_pipe(1, 2)),
    Surroundings('full output', begin=_into('/dev/full', 1)),
    Surroundings('full error', begin=_into('/dev/full', 2)),
    Surroundings('both full', begin=_into('/dev/full', 1, 2)),
    Surroundings('MPLBACKEND of a notebook', {'MPLBACKEND': 'module://matplotlib_inline.nowhere'}),
    Surroundings('matplotlib without a folder', {'MPLCONFIGDIR': NOT_WRITABLE}),
    Surroundings('no memory', begin=_limit(resource.RLIMIT_AS, GIGABYTE)),
    Surroundings('little stack', begin=_limit(resource.RLIMIT_STACK, 512 * 1024)),
    Surroundings('few files', begin=_limit(resource.RLIMIT_NOFILE, 24)),
    Surroundings('small files', begin=_small_files),
    Surroundings('no folder', begin=_without_a_folder),
    Surroundings('folder that is not writable', begin=_in_folder('/proc')),
    Surroundings('TMPDIR that is nowhere', {'TMPDIR': NOWHERE, 'TEMP': NOWHERE, 'TMP': NOWHERE}),
    Surroundings('no PATH', {'PATH': None}),
    Surroundings('dumb terminal', {'TERM': 'dumb'}),
    Surroundings('terminal of nobody', {'TERM': 'bogus', 'COLORTERM': 'x', 'FORCE_COLOR': '1'}),
    Surroundings('one column', {'COLUMNS': '1', 'LINES': '1'}),
    Surroundings('columns of no number', {'COLUMNS': 'wide', 'LINES': '-3'}),
    Surroundings('warnings are errors', {'PYTHONWARNINGS': 'error'}),
    Surroundings('optimised', {'PYTHONOPTIMIZE': '2'}),
    Surroundings('unbuffered', {'PYTHONUNBUFFERED': '1'}),
    Surroundings('without machine code', {'NUMBA_CACHE_DIR': NOT_WRITABLE}),
    Surroundings('threads of no number', {'OMP_NUM_THREADS': 'many', 'NUMBA_NUM_THREADS': 'many'}),
    Surroundings('layer of nobody', {'NUMBA_THREADING_LAYER': 'bogus'}),
    Surroundings('time zone of nobody', {'TZ': 'Nowhere/Bogus', 'SOURCE_DATE_EPOCH': 'x'}),
    Surroundings('signals ignored', begin=_ignoring(signal.SIGHUP, signal.SIGPIPE, signal.SIGCHLD)),
    Surroundings('nothing may be read again', begin=lambda: os.umask(0o777) and None),
    Surroundings('domain of no number', {'ROS_DOMAIN_ID': 'home'}),
    Surroundings('domain too large', {'ROS_DOMAIN_ID': '999'}),
    Surroundings('profiles that are nowhere', {'FASTRTPS_DEFAULT_PROFILES_FILE': NOWHERE}),
    Surroundings('discovery of nobody', {'ROS_AUTOMATIC_DISCOVERY_RANGE': 'NEXT_DOOR'}),
    Surroundings('log that is not writable', {'ROS_LOG_DIR': NOT_WRITABLE}),
    Surroundings('log format of nobody', {'RCUTILS_CONSOLE_OUTPUT_FORMAT': '{bogus} {'}),
    Surroundings('log of no colour', {'RCUTILS_COLORIZED_OUTPUT': 'maybe'}),
    Surroundings('log to the output', {'RCUTILS_LOGGING_USE_STDOUT': '1'}),
    Surroundings('log of no number', {'RCUTILS_LOGGING_USE_STDOUT': 'x'}),
)  # fmt: skip


def together(*names: str) -> Surroundings:
    """Return surroundings that are odd in several ways."""
    chosen = [odd for odd in ODD if odd.name in names]
    assert len(chosen) == len(names)
    variables = {name: value for odd in chosen for name, value in odd.variables.items()}
    return Surroundings(
        ', '.join(names), variables, lambda: [odd.begin() for odd in chosen] and None
    )
