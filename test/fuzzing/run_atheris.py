# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The fuzzing of the device's bytes, led by which lines of the code they reach.

    pip install atheris
    PYTHONPATH=test python -m fuzzing.run_atheris [BYTES]

Optional: `make fuzz` needs no atheris. Ends with status 77 and the input that did it if something
throws or does not hold.
"""

import itertools
import os
import random
import sys
import tempfile
from pathlib import Path

import atheris

with atheris.instrument_imports(include=['tactile_push.tactile', 'tactile_push.control']):
    from fuzzing.chain import Chain
from fuzzing.mutation import mutated_input

READ = 100  # at once [byte]
SEEDS = 200  # inputs to begin with
LONGEST = 4000  # input [byte]


def main() -> None:
    """Fuzz until enough bytes have been tried."""
    total = int(sys.argv[1]) if len(sys.argv) > 1 else 10_000_000
    done = 0

    def run_one(data: bytes) -> None:
        nonlocal done
        chain = Chain()
        for start in range(0, len(data), READ):
            chain.read(data[start : start + READ])
        done += len(data)
        if done >= total:
            print(f'{done} bytes: nothing threw, all commands finite')
            sys.stdout.flush()
            corpus.cleanup()
            os._exit(0)  # libFuzzer has no other end but a finding

    corpus = tempfile.TemporaryDirectory()
    source = mutated_input(random.Random(1))
    for k in range(SEEDS):
        data = b''.join(itertools.islice(source, 20))[:LONGEST]
        (Path(corpus.name) / str(k)).write_bytes(data)
    atheris.Setup([sys.argv[0], corpus.name, f'-max_len={LONGEST}'], run_one)
    atheris.Fuzz()


if __name__ == '__main__':
    main()
