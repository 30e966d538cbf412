# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""`tactile_push calibrate`: what it prints and writes, and how it ends."""

import json
import math
import sys

import numpy as np
import pytest

pytest.importorskip('cv2', reason="pip install 'tactile_push[camera]'")
pytest.importorskip('scipy', reason="pip install 'tactile_push[camera]'")

from support.bag_making import encode, write_bag
from support.dome import CENTRE, HEIGHT, WIDTH
from support.dome_touches import write_folder
from support.touches import RADIUS, unit, wrench
from tactile_push.calibration.coverage import suggested_touches
from tactile_push.cli.calibrate import THRESHOLD
from tactile_push.parameters import CameraSensorParameters, WrenchSensorParameters
from tactile_push.parameters.ros_file import read_sections


@pytest.fixture(scope='module')
def folder(tmp_path_factory):
    """Return a folder of images of touches."""
    return write_folder(tmp_path_factory.mktemp('dome') / 'images')


@pytest.fixture
def out(tmp_path):
    """Return where to write."""
    return tmp_path / 'camera.yaml'


@pytest.fixture(autouse=True)
def drawn(monkeypatch):
    """Return the pictures that are asked for; the drawing is tested elsewhere."""
    from tactile_push.calibration import picture

    asked = []
    monkeypatch.setattr(picture, 'draw_camera', lambda *arguments: asked.append(arguments[2]))
    monkeypatch.setattr(picture, 'draw_tip', lambda *arguments: asked.append(arguments[2]))
    return asked


def test_threshold_is_that_of_the_node():
    assert CameraSensorParameters().threshold == THRESHOLD


def test_folder_becomes_a_parameter_file_for_the_node(command, folder, out, drawn):
    status, said, err = command('calibrate', 'camera', folder, '-o', out, '--threshold', '10')
    assert (status, err) == (0, '')
    residuals, *files = said.splitlines()
    assert residuals.startswith('RMS 0.')
    assert 'largest residual' in residuals
    assert files == [str(out), str(out.with_suffix('.png'))]
    assert drawn == [out.with_suffix('.png')]
    ((section, values),) = read_sections(out).items()
    assert section == '/**/camera_sensor'
    p = CameraSensorParameters.of(values)
    assert (p.image_width, p.image_height, p.threshold) == (WIDTH, HEIGHT, 10.0)
    assert p.centre == pytest.approx(CENTRE, abs=10.0)


def test_json_has_the_residuals_of_all_touches(command, folder, out):
    status, said, _ = command('calibrate', 'camera', folder, '-o', out, '--json')
    assert status == 0
    result = json.loads(said)
    assert len(result['touches']) == len(suggested_touches())
    errors = [touch['error'] for touch in result['touches']]
    assert result['largest'] == max(errors)
    assert result['rms'] == pytest.approx(
        math.sqrt(sum(error**2 for error in errors) / len(errors))
    )
    assert result['parameters']['image_width'] == WIDTH


def test_touches_that_do_not_cover_the_tip_fail_and_nothing_is_written(command, tmp_path, out):
    few = write_folder(tmp_path / 'few', suggested_touches()[:-4])
    status, said, err = command('calibrate', 'camera', few, '-o', out)
    assert (status, said) == (1, '')
    assert err.startswith('tactile_push calibrate: touches: expected one in each region of the tip')
    assert err.count('\n') == 1
    assert not out.exists()


@pytest.mark.parametrize(
    ('words', 'said'),
    [
        (['nowhere'], 'nowhere: expected a folder with touches.csv, or a bag and --touches'),
        (['nowhere', '--topic', 'image'], '--topic: expected no FOLDER|BAG beside it'),
        (['nowhere', '--touches', 'touches.csv'], 'nowhere: '),
        (['{folder}', '--threshold', '0'], 'expected 1 to 255, got 0'),
        (['{folder}', '-o', '{folder}/no/camera.yaml'], '{folder}/no'),
    ],
)
def test_bad_input_is_refused_in_one_line(command, folder, words, said):
    status, out, err = command(
        'calibrate', 'camera', *(word.format(folder=folder) for word in words)
    )
    assert (status, out) == (2, '')
    assert said.format(folder=folder) in err
    assert err.count('\n') == 1


WRENCH = 'geometry_msgs/msg/WrenchStamped'
TIP = np.array([0.001, 0.002, 0.03])


@pytest.fixture
def pressed(tmp_path):
    """Return a bag of wrenches and the table of its touches."""
    wrenches = [(np.zeros(3), np.zeros(3))] * 60
    lines = ['azimuth_deg,elevation_deg']
    for number, (azimuth, elevation) in enumerate(suggested_touches()):
        shear = math.cos(number), math.sin(number)
        touch = wrench(unit(azimuth, elevation), 2.0, shear, 0.001, TIP)
        wrenches += [touch] * 15 + [(np.zeros(3), np.zeros(3))] * 5
        lines.append(f'{math.degrees(azimuth)},{math.degrees(elevation)}')
    table = tmp_path / 'touches.csv'
    table.write_text('\n'.join(lines))
    messages = []
    for number, parts in enumerate(wrenches):
        force, torque = (dict(zip('xyz', part, strict=True)) for part in parts)
        fields = {'force': force, 'torque': torque}
        messages.append(
            (1 + number * 10_000_000, encode(WRENCH, header={'frame_id': 'left_ft'}, wrench=fields))
        )
    return write_bag(tmp_path / 'bag', {'/ft/wrench': (WRENCH, messages)}), table


def test_wrenches_become_a_parameter_file_for_their_node(command, pressed, out, drawn):
    bag, table = pressed
    status, said, err = command('calibrate', 'wrench', bag, '--touches', table, '-o', out)
    assert (status, err) == (0, '')
    residuals, radius, *_ = said.splitlines()
    assert residuals.startswith('RMS 0.00°, largest residual 0.00° (touch ')
    assert radius == f'radius {1e3 * RADIUS:.2f} ± 0.00 mm'
    ((section, values),) = read_sections(out).items()
    assert section == '/**/wrench_sensor'
    p = WrenchSensorParameters.of(values)
    assert p.tip_xyz == pytest.approx(TIP, abs=1e-6)
    assert p.tip_radius == pytest.approx(RADIUS, abs=1e-6)
    assert not p.reaction
    assert p.calibrated_frame == 'left_ft'
    assert drawn == [out.with_suffix('.png')]


def test_table_beside_a_bag_is_taken_without_being_named(command, pressed, out):
    bag, table = pressed
    table.rename(bag / 'touches.csv')
    status, _, err = command('calibrate', 'wrench', bag, '-o', out)
    assert (status, err) == (0, '')


def test_wrenches_of_another_orientation_fail(command, pressed, out):
    bag, table = pressed
    words = ['--touches', table, '-o', out, '--tip-rpy-deg', 180, 0, 0]
    status, _, err = command('calibrate', 'wrench', bag, *words)
    assert status == 1
    assert err.startswith('tactile_push calibrate: touches: expected')
    assert not out.exists()


def test_bag_of_wrenches_needs_a_table(command, pressed):
    bag, _ = pressed
    status, _, err = command('calibrate', 'wrench', bag)
    assert status == 2
    assert err == f'tactile_push calibrate: {bag}: expected a bag and --touches\n'


def test_without_opencv_it_says_how_to_get_it(command, folder, monkeypatch):
    monkeypatch.setitem(sys.modules, 'cv2', None)
    status, _, err = command('calibrate', 'camera', folder)
    assert status == 2
    assert err == "tactile_push calibrate: needs OpenCV: pip install 'tactile_push[camera]'\n"
