# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Threads: work is done on all cores, and dropped after an exception."""

import threading
from pathlib import Path

import pytest

from tactile_push.threads import on_all_cores, usable_cores


@pytest.mark.skipif(not Path('/proc/self/status').exists(), reason='/proc needed')
def test_usable_cores_are_those_that_the_system_grants():
    status = Path('/proc/self/status').read_text().splitlines()
    (mask,) = (line.split()[1] for line in status if line.startswith('Cpus_allowed:'))
    assert usable_cores() == int(mask.replace(',', ''), 16).bit_count()


def test_as_many_calls_run_at_once_as_there_are_cores():
    together = threading.Barrier(usable_cores())
    with on_all_cores() as pool:
        found = pool.map(lambda i: together.wait(timeout=60.0), range(usable_cores()))
    assert sorted(found) == list(range(usable_cores()))


def test_an_exception_drops_what_has_not_begun():
    begun, may_end = [], threading.Event()

    def work(i):
        begun.append(i)
        may_end.wait(timeout=60.0)

    with pytest.raises(KeyboardInterrupt), on_all_cores() as pool:
        done = [pool.submit(work, i) for i in range(10 * usable_cores())]
        threading.Timer(0.05, may_end.set).start()
        raise KeyboardInterrupt
    assert len(begun) <= usable_cores()
    assert sum(one.cancelled() for one in done) == len(done) - len(begun)
