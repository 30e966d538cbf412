# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Which files a bag has, and what its `metadata.yaml` says."""

import re
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import yaml

from tactile_push.bags.sources import BagError

# libyaml's loader is ten times as fast, but not every PyYAML has it.
_LOADER = getattr(yaml, 'CSafeLoader', yaml.SafeLoader)

# Longer than that of a bag with a thousand files and topics [characters].
_LARGEST = 1 << 24

METADATA = 'metadata.yaml'
_MCAP, _SQLITE = 'mcap', '.db3'  # rosbag2's word for what is read, the files of what is not
_SHOWN = 60  # characters of what is not understood

# Name, number and suffix that rosbag2 gives a file.
_FILE_NAME = re.compile(r'(.*?)(\d*)\.mcap(\.zstd)?')


@dataclass(frozen=True)
class BagMetadata:
    """The part of rosbag2's metadata that the MCAP files do not have themselves."""

    files: tuple[str, ...] = ()  # names, in their order
    message_count: int = 0  # 0 if unknown
    end: int = 0  # last log time [ns]
    message_compression: str = ''  # with which each message is compressed
    custom_data: dict[str, str] = field(default_factory=dict)  # notes on the bag
    storage: str = _MCAP  # format of the files; '' if the metadata do not say it


def load_yaml(text: str) -> Any:
    """Read YAML; ValueError, with one line, if it is none."""
    try:
        return yaml.load(text, Loader=_LOADER)
    except Exception as error:
        raise ValueError(' '.join(str(error).split())) from None


def parse_metadata(information: Any, warn: Callable[[str], None]) -> BagMetadata:
    """Return what ``rosbag2_bagfile_information`` says; ValueError if it is something else.

    Notes of another shape are warned of and left out.
    """
    try:
        files = information.get('relative_file_paths') or ()
        if isinstance(files, str):
            raise ValueError(f'relative_file_paths: expected a list, got {files!r}')
        notes = information.get('custom_data') or {}
        if not isinstance(notes, dict):
            warn(f'custom_data: left out: expected texts by name, got {str(notes)[:_SHOWN]!r}')
            notes = {}
        is_compressed = str(information.get('compression_mode', '')).lower() == 'message'
        return BagMetadata(
            tuple(str(file) for file in files),
            int(information['message_count']),
            int(information['starting_time']['nanoseconds_since_epoch'])
            + int(information['duration']['nanoseconds']),
            str(information.get('compression_format')) if is_compressed else '',
            {str(key): str(value) for key, value in notes.items()},
            str(information.get('storage_identifier') or '').strip().lower(),
        )
    except (AttributeError, KeyError, TypeError, ValueError, OverflowError) as error:
        raise ValueError(f'bad rosbag2_bagfile_information: {error!r}') from None


def read_metadata(folder: Path, warn: Callable[[str], None]) -> BagMetadata:
    """Read the ``metadata.yaml`` in the folder of a bag; notes of another shape are warned of.

    Raises FileNotFoundError if there is none, OSError or ValueError if it cannot be read.
    """
    with open(folder / METADATA, encoding='utf-8') as stream:
        text = stream.read(_LARGEST + 1)
    if len(text) > _LARGEST:
        raise ValueError(f'expected at most {_LARGEST} characters, got more')
    content = load_yaml(text)
    if not isinstance(content, dict) or 'rosbag2_bagfile_information' not in content:
        raise ValueError('expected rosbag2_bagfile_information, got something else')
    information = content['rosbag2_bagfile_information']
    return parse_metadata(information, lambda line: warn(f'{folder / METADATA}: {line}'))


def find_files(path: Path, metadata: BagMetadata, warn: Callable[[str], None]) -> list[Path]:
    """Return the files of a bag in their order; BagError if there is none."""
    if not path.is_dir():
        if path.suffix == _SQLITE:
            raise BagError(_foreign(path, 'sqlite3'))
        return [path]
    named = [path / name for name in metadata.files]
    if metadata.storage != _MCAP:  # then the files tell
        others = [file for file in named if not _FILE_NAME.fullmatch(file.name)]
        if others or (metadata.storage and not named):
            raise BagError(_foreign(path, metadata.storage or _storage_of(others[0])))
    files = [file for file in named if file.is_file()]
    missing = [file for file in named if file not in files]
    if not files:
        there = (file for file in path.iterdir() if _FILE_NAME.fullmatch(file.name))
        files = sorted(there, key=_by_number)
        # While rosbag2 compresses a file, both are there.
        files = [f for f in files if f.suffix == '.mcap' or f.with_suffix('') not in files]
    if not files:
        if any(file.suffix == _SQLITE for file in path.iterdir()):
            raise BagError(_foreign(path, 'sqlite3'))
        raise BagError(f'{path}: expected a bag with at least one .mcap file, got none')
    for file in missing:
        warn(f'{file}: missing, though metadata.yaml names it')
    return files


def _by_number(file: Path) -> tuple[str, int, str]:
    """Sort a bag's files by name, bag_2 before bag_10."""
    match = _FILE_NAME.fullmatch(file.name)
    assert match is not None
    return match[1], int(match[2] or -1), file.name


def _storage_of(file: Path) -> str:
    return 'sqlite3' if file.suffix == _SQLITE else f'files such as {file.name}'


def _foreign(path: Path, storage: object) -> str:
    return (
        f'{path}: expected a bag stored as mcap, got {storage}: '
        '`ros2 bag convert` with `storage_id: mcap` converts it'
    )
