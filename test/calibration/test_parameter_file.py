# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import pytest

from tactile_push.calibration.parameter_file import parameter_file
from tactile_push.parameters.ros_file import read_sections


def test_file_reads_back_as_ros_reads_it(tmp_path):
    values = {
        'width': 640,
        'centre': [1.0, -2.5e-7],
        'scale': 3.0,
        'tiny': 1e-12,
        'flag': True,
        'name': 'a: b',
    }
    file = tmp_path / 'calibration.yaml'
    file.write_text(parameter_file('camera_sensor', values, ['one', 'two']))
    assert file.read_text().startswith('# one\n# two\n/**/camera_sensor:\n')
    ((section, found),) = read_sections(file).items()
    assert section == '/**/camera_sensor'
    assert {name: type(value) for name, value in found.items()} == {
        **{'width': int, 'centre': list, 'scale': float, 'tiny': float, 'flag': bool, 'name': str}
    }
    assert found['name'] == 'a: b'
    assert found['centre'] == pytest.approx([1.0, -2.5e-7])
    assert (found['width'], found['scale'], found['tiny']) == (640, 3.0, 1e-12)
