# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Start every command and node in all odd surroundings, and with all odd input.

    PYTHONPATH=test python -m hostile [--only WORD …]

Each process has to end with status 0, 1, 2, 130 or 141, with three lines on standard error at most,
and without a traceback on any stream.
"""

import argparse
import os
import sys
import tempfile
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from rich.console import Console
from rich.progress import track

from hostile.surroundings import ODD, Surroundings
from hostile.things import COMMAND, SLIPS, Words, commands, things, uses
from hostile.walk import run

PLAIN = Surroundings('as usual')


def steps() -> Iterator[tuple[str, Words, Surroundings]]:
    """Yield what to start, each with a name and a folder of its own."""
    for odd in ODD:
        for name in commands(Path()):
            yield f'{name}, {odd.name}', commands(_folder())[name], odd
    for kind, thing in things(_folder()).items():
        for words in uses(thing, _folder()):
            shown = ' '.join(str(word) for word in words if word != thing)
            yield f'{shown}, {kind}', words, PLAIN
    for slip in SLIPS:
        yield ' '.join(map(str, slip)), (*COMMAND, *slip), PLAIN


def _folder() -> Path:
    return Path(tempfile.mkdtemp(dir=FOLDER.name))


FOLDER = tempfile.TemporaryDirectory(prefix='hostile')


def main() -> int:
    """Walk through all of it."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--only', nargs='+', default=[''], help='steps whose name has such a word')
    options = parser.parse_args()
    chosen = [step for step in steps() if any(word in step[0] for word in options.only)]
    console = Console(stderr=True)
    failed = 0

    def walk(step: tuple[str, Words, Surroundings]) -> tuple[str, list[str], str]:
        name, words, odd = step
        ended = run(words, odd, _folder())
        return name, ended.complaints, ended.error[-2000:]

    with FOLDER, ThreadPoolExecutor(os.cpu_count()) as threads:
        for name, complaints, error in track(
            threads.map(walk, chosen), total=len(chosen), console=console, description=''
        ):
            if complaints:
                failed += 1
                text = f'{name}: {"; ".join(complaints)}\n{error}'
                print(text.encode('ascii', 'backslashreplace').decode(), flush=True)
    print(f'{len(chosen)} processes, {failed} ended otherwise than they should')
    return 1 if failed else 0


if __name__ == '__main__':
    sys.exit(main())
