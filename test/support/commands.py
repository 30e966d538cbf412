# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The command in a process of its own, on a bag of its own."""

import os
import resource
import signal
import subprocess
import sys
from pathlib import Path

BAG = Path(__file__).resolve().parents[1] / 'data' / 'block'
COMMAND = [sys.executable, '-m', 'tactile_push.cli']


def run_command(*arguments: object, **options) -> subprocess.CompletedProcess[str]:
    """Run the command with these words and return how it ended."""
    words = [*COMMAND, *map(str, arguments)]
    options = {'stdout': subprocess.PIPE} | options
    return subprocess.run(words, stderr=subprocess.PIPE, text=True, timeout=60, **options)


def few_bytes() -> None:
    """Let files grow no larger than 8 kB, in a process that is about to begin."""
    os.environ['PYTHONDONTWRITEBYTECODE'] = '1'  # Python keeps a module that it wrote in part
    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (8192, 8192))
