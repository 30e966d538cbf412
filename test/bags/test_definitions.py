# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Message definitions: what https://mcap.dev/spec/registry#ros2msg and rosbag2 put in a schema."""

import pytest

from tactile_push.bags import schema_text

SEPARATOR = '=' * 80


@pytest.fixture
def prefix(tmp_path, monkeypatch):
    """Return an ament prefix with three small message packages."""
    files = {
        'shape/Square': 'Corner[4] corners  # in order\ncolor_msgs/Color color\nfloat64 side\n',
        'shape/Corner': 'uint8 FIRST=0\nnumber_msgs/Real[<=2] position\nstring<=8 name\n',
        'color_msgs/Color': '# Other/Name is a comment\nnumber_msgs/Real[] rgb\nwstring name\n',
        'number_msgs/Real': '\nfloat32 value\n',
    }
    for name, text in files.items():
        package, message = name.split('/')
        path = tmp_path / 'share' / package / 'msg' / f'{message}.msg'
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    monkeypatch.setenv('AMENT_PREFIX_PATH', f'{tmp_path}/nothing_here:{tmp_path}')
    return tmp_path


def test_parts_follow_depth_first_in_alphabetic_order_each_once(prefix):
    assert schema_text('shape/msg/Square') == '\n'.join(
        [
            'Corner[4] corners  # in order',
            'color_msgs/Color color',
            'float64 side',
            '',
            SEPARATOR,
            'MSG: color_msgs/Color',
            '# Other/Name is a comment',
            'number_msgs/Real[] rgb',
            'wstring name',
            '',
            SEPARATOR,
            'MSG: number_msgs/Real',
            '',
            'float32 value',
            '',
            SEPARATOR,
            'MSG: shape/Corner',
            'uint8 FIRST=0',
            'number_msgs/Real[<=2] position',
            'string<=8 name',
            '',
        ]
    )


def test_text_is_taken_verbatim(prefix):
    path = prefix / 'share' / 'number_msgs' / 'msg' / 'Real.msg'
    path.write_bytes('# 1 µm\r\nfloat32 value'.encode())
    assert schema_text('number_msgs/msg/Real') == '# 1 µm\r\nfloat32 value'


@pytest.mark.parametrize(
    ('type_name', 'parts'),
    [
        ('rosgraph_msgs/msg/Clock', ['builtin_interfaces/Time']),
        ('sensor_msgs/msg/JointState', ['std_msgs/Header', 'builtin_interfaces/Time']),
        (
            'geometry_msgs/msg/TwistStamped',
            [
                'geometry_msgs/Twist',
                'geometry_msgs/Vector3',
                'std_msgs/Header',
                'builtin_interfaces/Time',
            ],
        ),
    ],
)
def test_installed_messages(type_name, parts):
    pytest.importorskip(type_name.split('/')[0])
    blocks = schema_text(type_name).split(f'\n{SEPARATOR}\nMSG: ')
    assert [block.splitlines()[0] for block in blocks[1:]] == parts


@pytest.mark.parametrize(
    'type_name', ['shape/msg/Circle', 'nowhere_msgs/msg/Square', 'Square', '../shape/msg/Square']
)
def test_unknown_type_is_named_in_one_line(prefix, type_name):
    with pytest.raises(LookupError) as error:
        schema_text(type_name)
    assert type_name in str(error.value)
    assert '\n' not in str(error.value)


def test_unknown_part_is_refused(prefix):
    (prefix / 'share' / 'number_msgs' / 'msg' / 'Real.msg').unlink()
    with pytest.raises(LookupError, match='number_msgs/Real'):
        schema_text('shape/msg/Square')
