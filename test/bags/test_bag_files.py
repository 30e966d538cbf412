# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Which files belong to a bag, with a good metadata.yaml, a bad one and none."""

import os

import pytest
import yaml
from mcap.writer import Writer
from rosbags.rosbag2 import CompressionMode, StoragePlugin

from support.bag_by_rosbags import refuse, write_by_rosbags
from support.bag_files import (
    SECOND,
    as_tuples,
    mcap_bytes,
    some_messages,
)
from tactile_push.bags import BagError, BagReader


def metadata_of(*files, count=0, **more):
    """Return the text of a metadata.yaml."""
    information = {
        'version': 9,
        'storage_identifier': 'mcap',
        'relative_file_paths': list(files),
        'message_count': count,
        'starting_time': {'nanoseconds_since_epoch': 5 * SECOND},
        'duration': {'nanoseconds': 3 * SECOND},
    }
    return yaml.safe_dump({'rosbag2_bagfile_information': {**information, **more}})


def test_files_come_in_the_order_of_their_numbers_or_of_the_metadata(tmp_path):
    written = some_messages(12)
    for number, message in enumerate(written):
        (tmp_path / f'bag_{number}.mcap').write_bytes(mcap_bytes([message]))
    names = [f'bag_{number}.mcap' for number in range(12)]
    with BagReader(tmp_path, refuse) as reader:
        assert [file.name for file in reader.files] == names
        assert as_tuples(reader.messages()) == written
        assert sum(reader.counts.values()) == 12
    (tmp_path / 'metadata.yaml').write_text(metadata_of(*names[3::-1]))
    with BagReader(tmp_path, refuse) as reader:
        assert [file.name for file in reader.files] == names[3::-1]
        assert as_tuples(reader.messages()) == written[:4]


@pytest.mark.parametrize('make', ['nothing', 'folder', 'folder named so', 'text', 'sqlite', 'pipe'])
def test_what_is_no_bag(tmp_path, make):
    path = tmp_path / 'bag.mcap'
    if make.startswith('folder'):
        path.mkdir()
    if make == 'folder named so':
        path = path / 'x.mcap'
        path.mkdir()
    elif make == 'text':
        path.write_text('topics: none\n')
    elif make == 'sqlite':
        path.write_bytes(b'SQLite format 3\0' + bytes(100))
    elif make == 'pipe':
        os.mkfifo(path)
    with pytest.raises(BagError) as error:
        BagReader(path, refuse)
    assert str(path) in str(error.value) and '\n' not in str(error.value)


def test_folder_in_place_of_a_file(tmp_path):
    (tmp_path / 'bag_0.mcap').mkdir()
    with pytest.raises(BagError, match='bag_0.mcap'):
        BagReader(tmp_path, refuse)


@pytest.mark.parametrize('has_metadata', [True, False])
def test_sqlite_bag_is_refused_with_what_to_do(tmp_path, has_metadata):
    write_by_rosbags(tmp_path / 'bag', CompressionMode.NONE, StoragePlugin.SQLITE3)
    if not has_metadata:
        (tmp_path / 'bag' / 'metadata.yaml').unlink()
    for path in (tmp_path / 'bag', tmp_path / 'bag' / 'bag.db3'):
        with pytest.raises(
            BagError, match=r'expected a bag stored as mcap, got sqlite3: `ros2 bag convert`'
        ):
            BagReader(path, refuse)


def test_metadata_file_stands_for_its_folder(tmp_path, monkeypatch):
    written = write_by_rosbags(tmp_path / 'bag', CompressionMode.NONE)
    monkeypatch.chdir(tmp_path / 'bag')
    for path in (tmp_path / 'bag' / 'metadata.yaml', 'metadata.yaml', './metadata.yaml'):
        with BagReader(path, refuse) as reader:
            assert reader.path.resolve() == tmp_path / 'bag'
            assert [(m.topic, m.log_time, m.data) for m in reader.messages()] == written
            assert reader.notes == {'object': 'block'}


STORAGES = [None, '', 'MCAP', 'my_mcap', 'sqlite3', 3, []]


@pytest.mark.parametrize('storage', STORAGES, ids=str)
def test_files_tell_the_storage_if_the_metadata_do_not(tmp_path, storage):
    written = some_messages(20)
    (tmp_path / 'bag_0.mcap').write_bytes(mcap_bytes(written))
    (tmp_path / 'metadata.yaml').write_text(metadata_of('bag_0.mcap', storage_identifier=storage))
    with BagReader(tmp_path, refuse) as reader:
        assert as_tuples(reader.messages()) == written
    (tmp_path / 'metadata.yaml').write_text(
        metadata_of('bag_0.mcap').replace('  storage_identifier: mcap\n', '')
    )
    with BagReader(tmp_path, refuse) as reader:
        assert as_tuples(reader.messages()) == written


@pytest.mark.parametrize(
    ('storage', 'file', 'words'),
    [
        ('', 'bag_0.db3', 'got sqlite3: `ros2 bag convert`'),
        (None, 'bag_0.db3', 'got sqlite3: `ros2 bag convert`'),
        ('sqlite3', 'bag_0.db3', 'got sqlite3: `ros2 bag convert`'),
        ('rosbag_v2', 'old.bag', 'got rosbag_v2: `ros2 bag convert`'),
        ('', 'old.bag', 'got files such as old.bag: `ros2 bag convert`'),
    ],
)
def test_bag_in_another_storage_is_refused_with_what_it_is(tmp_path, storage, file, words):
    (tmp_path / file).write_bytes(bytes(100))
    (tmp_path / 'metadata.yaml').write_text(metadata_of(file, storage_identifier=storage))
    for path in (tmp_path, tmp_path / 'metadata.yaml'):
        with pytest.raises(BagError, match=f'{tmp_path}: expected a bag stored as mcap, {words}'):
            BagReader(path, refuse)


BAD_METADATA = {
    'no YAML': b'rosbag2_bagfile_information: [',
    'no text': bytes(range(256)),
    'empty': b'',
    'a list': b'- 1',
    'something else': b'rosbag2_bagfile_information: 3',
    'half': b'rosbag2_bagfile_information:\n  version: 9\n',
    'deep': b'[' * 200_000,
    'words for numbers': metadata_of('bag_0.mcap', count='many').encode(),
    'one name for a list of files': metadata_of('x').replace('\n  - x', ' bag_0.mcap').encode(),
    'a folder': None,
}


@pytest.mark.parametrize('text', BAD_METADATA.values(), ids=BAD_METADATA)
def test_bad_metadata_file_is_not_used(tmp_path, text):
    written = some_messages(20)
    (tmp_path / 'bag_0.mcap').write_bytes(mcap_bytes(written))
    if text is None:
        (tmp_path / 'metadata.yaml').mkdir()
    else:
        (tmp_path / 'metadata.yaml').write_bytes(text)
    warnings = []
    with BagReader(tmp_path, warnings.append) as reader:
        assert as_tuples(reader.messages()) == written
    (line,) = warnings
    assert line.startswith(f'{tmp_path}/metadata.yaml: not used: ') and '\n' not in line


def test_missing_files_are_named_and_counted(tmp_path):
    written = some_messages(300)
    (tmp_path / 'bag_1.mcap').write_bytes(mcap_bytes(written[:100]))
    (tmp_path / 'metadata.yaml').write_text(
        metadata_of('bag_0.mcap', 'bag_1.mcap', 'bag_2.mcap', count=300)
    )
    warnings = []
    with BagReader(tmp_path, warnings.append) as reader:
        assert as_tuples(reader.messages()) == written[:100]
    first, last, summary = warnings
    assert 'bag_0.mcap: missing' in first
    assert 'bag_2.mcap: missing' in last
    # The metadata tell of 3 s, of which 0.99 s are there.
    assert '200 of the 300 messages' in summary and '2.010 s' in summary


def test_renamed_files_are_read(tmp_path):
    written = some_messages(20)
    (tmp_path / 'renamed.mcap').write_bytes(mcap_bytes(written))
    (tmp_path / 'metadata.yaml').write_text(metadata_of('bag_0.mcap'))
    warnings = []
    with BagReader(tmp_path, warnings.append) as reader:
        assert as_tuples(reader.messages()) == written
    assert len(warnings) == 1


def test_bad_file_of_a_split_bag_is_left_out(tmp_path):
    written = some_messages(60)
    (tmp_path / 'bag_0.mcap').write_bytes(mcap_bytes(written[:20]))
    (tmp_path / 'bag_1.mcap').write_bytes(b'something else')
    (tmp_path / 'bag_2.mcap').write_bytes(mcap_bytes(written[40:]))
    warnings = []
    with BagReader(tmp_path, warnings.append) as reader:
        assert as_tuples(reader.messages()) == written[:20] + written[40:]
    (line,) = warnings
    assert 'bag_1.mcap' in line and 'left out' in line


def test_unknown_message_compression_is_refused(tmp_path):
    (tmp_path / 'bag_0.mcap').write_bytes(mcap_bytes(some_messages(3)))
    (tmp_path / 'metadata.yaml').write_text(
        metadata_of('bag_0.mcap', compression_mode='MESSAGE', compression_format='fancy')
    )
    with pytest.raises(BagError, match='expected messages compressed with zstd, got fancy'):
        BagReader(tmp_path, refuse)


@pytest.mark.parametrize('notes', [['a', 'b'], 'a text', 3, [{'operator': 'ann'}]], ids=str)
def test_notes_of_another_shape_are_left_out_and_the_rest_of_the_metadata_is_used(tmp_path, notes):
    written = some_messages(4)
    for number, message in enumerate(written):
        (tmp_path / f'bag_{number}.mcap').write_bytes(mcap_bytes([message]))
    (tmp_path / 'metadata.yaml').write_text(
        metadata_of('bag_3.mcap', 'bag_1.mcap', custom_data=notes)
    )
    warnings = []
    with BagReader(tmp_path, warnings.append) as reader:
        assert [file.name for file in reader.files] == ['bag_3.mcap', 'bag_1.mcap']
        assert reader.notes == {}
    (line,) = warnings
    assert line.startswith(f'{tmp_path}/metadata.yaml: custom_data: left out: expected texts by na')


def test_notes_of_metadata_records_and_of_the_metadata_file(tmp_path):
    with open(tmp_path / 'bag_0.mcap', 'wb') as stream:
        writer = Writer(stream)
        writer.start('ros2')
        writer.add_metadata('tactile_push', {'tactile_push.version': '1', 'a': 'b'})
        writer.add_metadata('tactile_push', {'tactile_push.version': '2'})
        writer.add_metadata('other', {'c': 'd'})
        writer.finish()
    (tmp_path / 'metadata.yaml').write_text(
        metadata_of('bag_0.mcap', custom_data={'operator': 'ann', 'run': 3})
    )
    with BagReader(tmp_path, refuse) as reader:
        assert reader.notes == {
            'tactile_push.version': '2',
            'a': 'b',
            'operator': 'ann',
            'run': '3',
        }
