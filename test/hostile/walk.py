# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""One process in odd surroundings, and whether it ended as a program should."""

import os
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from hostile.surroundings import Surroundings

STATUSES = (0, 1, 2, 130, 141)  # done, failed, bad input, interrupted, nobody reads
LINES = 3  # on standard error, at most
PATIENCE = 120.0  # [s]
HANGS = -1
COMMAND = (sys.executable, '-m', 'tactile_push.cli')


@dataclass(frozen=True)
class Ended:
    """How a process ended."""

    status: int  #: as a shell tells it
    output: str
    error: str

    @property
    def complaints(self) -> list[str]:
        """What was not as it should be."""
        found = []
        if self.status not in STATUSES:
            found.append(f'exit status {self.status}')
        if self.error.count('\n') > LINES:
            found.append(f'{self.error.count(chr(10))} lines on standard error')
        for stream, text in (('output', self.output), ('error', self.error)):
            found += [f'{word} on standard {stream}' for word in SCREAMS if word in text]
        return found


SCREAMS = ('Traceback', 'Exception ignored', 'Fatal Python error', 'terminate called')


def run(words: Sequence[str | Path], surroundings: Surroundings, folder: Path) -> Ended:
    """Run a program and return how it ended."""
    variables = dict(os.environ)
    # A relative one, as of this walk, keeps Python from starting where there is no folder.
    variables.pop('PYTHONPATH', None)
    for name, value in surroundings.variables.items():
        if value is None:
            variables.pop(name, None)
        else:
            variables[name] = value
    try:
        process = subprocess.run(
            list(map(str, words)),
            stdin=subprocess.DEVNULL,
            capture_output=True,
            cwd=folder,
            env=variables,
            preexec_fn=surroundings.begin,
            timeout=PATIENCE,
        )
    except subprocess.TimeoutExpired as error:
        return Ended(HANGS, _text(error.stdout), _text(error.stderr))
    status = process.returncode if process.returncode >= 0 else 128 - process.returncode
    return Ended(status, _text(process.stdout), _text(process.stderr))


def _text(written: bytes | None) -> str:
    return (written or b'').decode('utf-8', 'replace')
