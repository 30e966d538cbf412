# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Small files are read, and what is none is refused at once."""

import os
import threading

import pytest

from tactile_push.small_files import MOST_BYTES, read_small_file


def test_file_is_read_whole(tmp_path):
    content = bytes(range(256)) * 300
    (tmp_path / 'file').write_bytes(content)
    (tmp_path / 'link').symlink_to(tmp_path / 'file')
    assert read_small_file(tmp_path / 'file') == read_small_file(tmp_path / 'link') == content


def test_pipe_of_a_shell_is_read_whole():
    read, write = os.pipe()
    writer = threading.Thread(target=lambda: (os.write(write, b'kp: 0.1\n'), os.close(write)))
    writer.start()
    assert read_small_file(f'/dev/fd/{read}') == b'kp: 0.1\n'
    writer.join()
    os.close(read)


def test_named_pipe_to_which_nobody_writes_is_refused_at_once(tmp_path):
    os.mkfifo(tmp_path / 'pipe')
    (tmp_path / 'link').symlink_to(tmp_path / 'pipe')
    for name in ('pipe', 'link'):
        with pytest.raises(OSError, match='expected a file, got a named pipe') as refused:
            read_small_file(tmp_path / name)
        assert refused.value.filename == str(tmp_path / name)


def test_device_that_never_ends_is_refused():
    with pytest.raises(OSError, match='too large'):
        read_small_file('/dev/zero')


def test_largest_file_is_read(tmp_path):
    (tmp_path / 'file').write_bytes(bytes(MOST_BYTES))
    assert len(read_small_file(tmp_path / 'file')) == MOST_BYTES


def test_folder_and_nothing_are_refused(tmp_path):
    for path in (tmp_path, tmp_path / 'nowhere'):
        with pytest.raises(OSError):
            read_small_file(path)
