# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Files written by a thread: what is in them when writing goes wrong."""

import errno
import itertools
import os
import subprocess
import sys
import threading

import pytest

from tactile_push.bags import disk as disk_module
from tactile_push.bags.disk import Disk, DiskFile, write_whole

PIECES = [bytes([i]) * (1000 + 37 * i) for i in range(40)]


def fill(disk, file):
    """Append all pieces; True if nobody was told of an error before the end."""
    try:
        for piece in PIECES:
            file.write(piece)
            file.flush()
        file.close()
        disk.close()
        disk.check()
    except OSError:
        disk.close()
        return False
    return True


def test_pieces_are_written_in_order_and_counted_at_once(tmp_path):
    disk = Disk()
    first, second = (DiskFile(disk, tmp_path / name) for name in ('first', 'second'))
    for piece in PIECES:
        assert first.write(piece) == len(piece)
        second.write(piece[:10])
    assert first.tell() == sum(map(len, PIECES))
    assert second.tell() == 10 * len(PIECES)
    first.close()
    second.close()
    disk.close()
    disk.check()
    assert not disk.failed
    assert (tmp_path / 'first').read_bytes() == b''.join(PIECES)
    assert (tmp_path / 'second').read_bytes() == b''.join(piece[:10] for piece in PIECES)


def test_whoever_fills_a_file_does_not_wait_for_the_disk(tmp_path, monkeypatch):
    stuck = threading.Event()
    monkeypatch.setattr(os, 'fdatasync', lambda descriptor: stuck.wait(60))
    disk = Disk()
    file = DiskFile(disk, tmp_path / 'file')
    for piece in PIECES[:10]:
        file.write(piece)
        file.flush()
    stuck.set()
    file.close()
    disk.close()
    assert (tmp_path / 'file').read_bytes() == b''.join(PIECES[:10])


@pytest.mark.slow
def test_what_waits_for_the_disk_is_bounded(tmp_path, monkeypatch):
    stuck = threading.Event()
    monkeypatch.setattr(os, 'fdatasync', lambda descriptor: stuck.wait(60))
    disk = Disk()
    file = DiskFile(disk, tmp_path / 'file')
    file.write(b'piece')
    file.flush()
    handed_over = itertools.count()

    def fill_on():
        for _ in range(1000):
            file.write(b'piece')
            next(handed_over)

    filler = threading.Thread(target=fill_on)
    filler.start()
    filler.join(1.0)
    assert filler.is_alive()  # it waits
    assert next(handed_over) < 100
    stuck.set()
    filler.join()
    file.close()
    disk.close()
    assert (tmp_path / 'file').stat().st_size == 5 * 1001


def test_existing_file_is_refused(tmp_path):
    (tmp_path / 'file').write_bytes(b'precious')
    disk = Disk()
    with pytest.raises(FileExistsError):
        DiskFile(disk, tmp_path / 'file')
    disk.close()
    assert (tmp_path / 'file').read_bytes() == b'precious'


@pytest.mark.parametrize('failing_call', [1, 2, 5, 40])
def test_half_a_piece_is_taken_back(tmp_path, monkeypatch, failing_call):
    calls = itertools.count(1)
    write = os.write

    def write_half_then_fail(descriptor, data):
        call = next(calls)
        if call < failing_call:
            return write(descriptor, data)
        if call == failing_call:
            return write(descriptor, data[: len(data) // 2])
        raise OSError(errno.EIO, 'Input/output error')

    monkeypatch.setattr(disk_module.os, 'write', write_half_then_fail)
    disk = Disk()
    assert not fill(disk, DiskFile(disk, tmp_path / 'file'))
    with pytest.raises(OSError, match=r'Input/output error.*file'):
        disk.check()
    assert disk.failed
    assert not disk.descriptors
    if failing_call == 1:
        assert not (tmp_path / 'file').exists()
    else:
        assert (tmp_path / 'file').read_bytes() == b''.join(PIECES[: failing_call - 1])


FILL_LIMITED = """
import resource, sys
from pathlib import Path
from tactile_push.bags.disk import Disk, DiskFile
limit = int(sys.argv[2])
resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))
disk = Disk()
file = DiskFile(disk, Path(sys.argv[1]))
try:
    for i in range(40):
        file.write(bytes([i]) * (1000 + 37 * i))
    file.close()
finally:
    disk.close()
    disk.check()
"""


def test_file_at_the_limit_of_the_process_ends_with_a_whole_piece(tmp_path):
    lengths = list(itertools.accumulate(map(len, PIECES)))
    limit = lengths[19] + 500
    done = subprocess.run(
        [sys.executable, '-c', FILL_LIMITED, str(tmp_path / 'file'), str(limit)],
        capture_output=True,
        text=True,
    )
    assert done.returncode == 1
    assert 'File too large' in done.stderr
    assert (tmp_path / 'file').read_bytes() == b''.join(PIECES[:20])


def test_whole_file_or_none(tmp_path, monkeypatch):
    path = tmp_path / 'metadata.yaml'
    write_whole(path, 'version: 9\n')
    assert path.read_text() == 'version: 9\n'

    def fail(descriptor):
        raise OSError(errno.ENOSPC, 'No space left on device')

    monkeypatch.setattr(disk_module.os, 'fsync', fail)
    with pytest.raises(OSError, match='No space'):
        write_whole(tmp_path / 'other.yaml', 'version: 9\n')
    assert [entry.name for entry in tmp_path.iterdir()] == ['metadata.yaml']


def test_pipe_takes_a_file_if_somebody_reads_it_and_is_refused_if_not(tmp_path):
    pipe = tmp_path / 'pipe'
    os.mkfifo(pipe)
    with pytest.raises(OSError, match='nobody reads this pipe') as caught:
        write_whole(pipe, 'all of it\n')
    assert caught.value.filename == str(pipe)
    reader = os.open(pipe, os.O_RDONLY | os.O_NONBLOCK)
    write_whole(pipe, 'all of it\n')
    assert os.read(reader, 100) == b'all of it\n'
    os.close(reader)
