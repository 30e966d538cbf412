# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Feed ten million bytes of spoiled device input, and every message field at its extremes.

    PYTHONPATH=test python -m fuzzing [--bytes N] [--seed S]

The bytes go through stream, contact finder and control in this process; then the messages go to the
real nodes in processes of their own. Nothing may throw or end, memory stays flat, every command is
finite and within its bounds, and afterwards the finger pushes again.
"""

import argparse
import random
import sys
from collections.abc import Callable

from rich.console import Console
from rich.progress import Progress

from faults.interrupt import interrupt_once
from faults.place_rows import PLACES
from faults.promise import PLAIN, BrokenPromiseError
from faults.table import start_bench
from fuzzing.chain import FuzzError, run
from fuzzing.mutation import mutated_input
from fuzzing.nodes import send_extremes

DEFAULT_BYTES = 10_000_000


def fuzz_bytes(total: int, seed: int, progress: Callable[[int], None]) -> str:
    """Send bytes through the mathematics and say in a line what came of them."""
    chain, growth = run(mutated_input(random.Random(seed)), total, progress)
    return (
        f'{total} bytes in {chain.reads} reads: {chain.readings} readings, {chain.contacts} '
        f'contacts, {chain.moving} of {chain.ticks} ticks moving; memory +{growth / 1000:.0f} kB'
    )


def fuzz_messages(progress: Callable[[str], None]) -> str:
    """Send messages to the nodes and say in a line what came of them."""
    sent = 0
    for setup in (PLAIN, PLACES):
        bench = start_bench(setup)
        try:
            sent += send_extremes(bench, progress)
        finally:
            complaints = bench.close()
        if complaints:
            raise FuzzError('; '.join(complaints))
    return f'{sent} messages: all nodes run, all commands finite, the finger pushes again'


def main() -> int:
    """Run the fuzzing."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument(
        '--bytes', type=int, default=DEFAULT_BYTES, metavar='N', help='default: ten million'
    )
    parser.add_argument('--seed', type=int, default=1, metavar='S', help='default: 1')
    options = parser.parse_args()
    if options.bytes < 1:
        print(f'fuzz: --bytes: expected 1 or more, got {options.bytes}', file=sys.stderr)
        return 2
    interrupt_once()
    try:
        with Progress(console=Console(stderr=True)) as progress:
            task = progress.add_task('bytes', total=options.bytes)
            print(
                fuzz_bytes(
                    options.bytes,
                    options.seed,
                    lambda done: progress.update(task, completed=done),
                )
            )
            task = progress.add_task('messages', total=None)
            print(
                fuzz_messages(lambda what: progress.update(task, description=what[:60], advance=1))
            )
    except (FuzzError, BrokenPromiseError) as error:
        print(f'fuzz: {error}')
        return 1
    except KeyboardInterrupt:
        return 130
    return 0


if __name__ == '__main__':
    sys.exit(main())
