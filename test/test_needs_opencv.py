# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
import pytest

from tactile_push.needs_opencv import opencv_is_missing


def test_what_is_installed_is_not_spoken_of(capsys):
    pytest.importorskip('cv2', reason="pip install 'tactile_push[camera]'")
    pytest.importorskip('scipy', reason="pip install 'tactile_push[camera]'")
    assert not opencv_is_missing('camera_sensor', 'cv2', 'scipy')
    assert capsys.readouterr() == ('', '')


@pytest.mark.parametrize(
    ('missing', 'words'),
    [
        (['cv2'], 'OpenCV'),
        (['scipy'], 'SciPy'),
        (['cv2', 'scipy'], 'OpenCV and SciPy'),
    ],
)
def test_who_lacks_something_says_how_to_get_it(capsys, monkeypatch, missing, words):
    def find(name):
        return None if name in missing else 'there'

    monkeypatch.setattr('tactile_push.needs_opencv.find_spec', find)
    assert opencv_is_missing('camera_sensor', 'cv2', 'scipy')
    assert capsys.readouterr() == (
        '',
        f"camera_sensor: needs {words}: pip install 'tactile_push[camera]'\n",
    )
