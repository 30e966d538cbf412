# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import math

import pytest

from tactile_push.calibration.touch_table import read_table


@pytest.fixture
def table(tmp_path):
    """Return what writes a table and reads it."""

    def read(text):
        file = tmp_path / 'touches.csv'
        file.write_bytes(text if isinstance(text, bytes) else text.encode())
        return read_table(file)

    return read


def test_lines_become_touches(table):
    found = table('file,azimuth_deg,elevation_deg,normal_force\na.png,90,45,1.5\n')
    ((azimuth, elevation, force, file),) = found
    assert (azimuth, elevation) == pytest.approx((math.pi / 2.0, math.pi / 4.0))
    assert (force, file) == (1.5, 'a.png')
    assert found[0].touched


def test_line_without_angles_is_of_the_untouched_tip(table):
    (touch,) = table('file,azimuth_deg,elevation_deg\na.png,,\n')
    assert not touch.touched
    assert math.isnan(touch.normal_force)


def test_columns_may_come_in_any_order_with_blanks_and_others(table):
    (touch,) = table('\ufeffelevation_deg, remark, azimuth_deg\r\n 90, the pole, 0\r\n')
    assert touch.elevation == pytest.approx(math.pi / 2.0)
    assert touch.file == ''


@pytest.mark.parametrize(
    ('text', 'words'),
    [
        ('', 'expected a column azimuth_deg, got none'),
        ('azimuth,elevation\n', 'expected a column azimuth_deg, got azimuth, elevation'),
        ('x' * 1000, r'got \[\.\.\.\]$'),
        ('azimuth_deg,elevation_deg\n0,91\n', "line 2: elevation_deg: expected 0 to 90, got '91'"),
        ('azimuth_deg,elevation_deg\n0,9\nx,9\n', 'line 3: azimuth_deg: expected -180 to 180, got'),
        ('azimuth_deg,elevation_deg\nnan,9\n', "azimuth_deg: expected -180 to 180, got 'nan'"),
        ('azimuth_deg,elevation_deg\n0,\n', 'line 2: expected both azimuth_deg and elevation_deg'),
        ('azimuth_deg,elevation_deg,normal_force\n0,9,-1\n', 'normal_force: expected 0 to'),
        (b'azimuth_deg,elevation_deg\n\xff,9\n', 'no CSV'),
        ('azimuth_deg,elevation_deg\n"0,9\n', 'no CSV'),
    ],
)
def test_table_that_is_none_is_refused_with_the_line(table, text, words):
    with pytest.raises(ValueError, match=words):
        table(text)
