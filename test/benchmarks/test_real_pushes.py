# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import importlib.util
import json
import math
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip('scipy', reason="pip install 'tactile_push[camera]'")

from support.measured_pushes import OUTLINE, content, deviation, measured, ways
from tactile_push.identification import fitting, models
from tactile_push.mechanics import Support

SCRIPT = Path(__file__).parents[2] / 'benchmarks' / 'real_pushes.py'


@pytest.fixture(scope='module')
def bench():
    """Load the benchmark as a module."""
    spec = importlib.util.spec_from_file_location('real_pushes', SCRIPT)
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    yield module
    del sys.modules[spec.name]


@pytest.fixture(autouse=True)
def _quick(monkeypatch):
    monkeypatch.setattr(models, 'POINTS', 40)
    monkeypatch.setattr(models, 'SHARE_OF_C', models.SHARE_OF_C._replace(starts=(0.65,)))
    monkeypatch.setattr(models, 'FRICTION_ANGLE', models.FRICTION_ANGLE._replace(starts=(0.25,)))
    monkeypatch.setattr(fitting, 'LONGEST', 1)


@pytest.fixture
def main(bench, monkeypatch, capsys):
    """Return a function that runs the benchmark: exit status, standard output, standard error."""

    def run(*arguments):
        capsys.readouterr()
        monkeypatch.setattr(sys, 'argv', ['real_pushes.py', *map(str, arguments)])
        try:
            status = bench.main()
        except SystemExit as end:
            status = end.code
        return status, *capsys.readouterr()

    return run


@pytest.fixture
def write(tmp_path):
    """Return a function that writes files of pushes into one folder and gives the folder."""
    folder = tmp_path / 'pushes'
    folder.mkdir()

    def written(content, name='block'):
        text = content if isinstance(content, str) else json.dumps(content)
        (folder / f'{name}.json').write_text(text)
        return folder

    return written


def synthetic(count, *physics):
    """Make pushes, by turns with the given spreads and coefficients of friction."""
    supports = [Support.spread(OUTLINE, spread, 40) for spread, _ in physics]
    return [
        measured(supports[i % len(physics)], physics[i % len(physics)][1], *way)
        for i, way in enumerate(ways(count))
    ]


def test_either_half_is_predicted_with_the_numbers_of_the_other(bench, write, monkeypatch):
    # Every second push has other physics, so that what is fitted on one half is wrong for the
    # other by what the two physics differ for the same push.
    monkeypatch.setattr(fitting, 'LONGEST', 8)
    first, second = (1.0, 0.1), (1.4, 0.3)
    mixed = synthetic(12, first, second)
    swapped = synthetic(12, second, first)

    result = bench.evaluated(bench.read_measured(write(content(mixed)) / 'block.json'), int)

    numbers = result['fitted']['halves']
    expected = [
        (1e3 * Support.spread(OUTLINE, spread, 40).c, mu_c) for spread, mu_c in (first, second)
    ]
    for half, (c, mu_c) in zip(numbers, expected, strict=True):
        assert (half['c_mm'], half['mu_c']) == pytest.approx((c, mu_c), rel=0.02)
    position, angle = deviation(mixed, swapped)
    assert np.median(position) > 1e-4
    assert result['fitted']['mean_mm'] == pytest.approx(1e3 * position.mean(), rel=0.03)
    assert result['fitted']['mean_deg'] == pytest.approx(np.degrees(angle.mean()), rel=0.03)


def test_the_nominal_prediction_has_uniform_pressure_and_a_quarter_of_friction(main, write):
    uniform = Support.uniform(OUTLINE, 40)
    folder = write(content([measured(uniform, 0.25, *way) for way in ways(4)]))

    status, out, _ = main(folder, '--json')

    assert status == 0
    nominal = json.loads(out)['files']['block']['nominal']
    assert nominal == pytest.approx(
        {'mean_mm': 0.0, 'mean_deg': 0.0, 'median_mm': 0.0, 'median_deg': 0.0}, abs=1e-5
    )


FEET = {'points': [[0.005, 0.005], [0.05, 0.005], [0.01, 0.04]], 'loads': [1.0, 2.0, 1.5]}


def test_on_a_known_support_friction_and_tilt_are_fitted_and_forces_compared(main, write):
    support = Support.at_points(FEET['points'], FEET['loads'])
    pushes = [measured(support, 0.4, *way, 3e-3) | {'force': [1.0, 0.0]} for way in ways(6)]
    folder = write(content(pushes, support=FEET))

    status, out, _ = main(folder, '--json')

    assert status == 0
    result = json.loads(out)['files']['block']
    assert result['known_tilt']['mean_mm'] < result['known']['mean_mm']
    assert [*result['known_tilt']['halves'][0]] == ['mu_c', 'tilt_mm']
    assert math.isfinite(result['known']['mean_force_deg'])


def test_json_has_the_errors_of_every_file_beside_the_published_ones(main, write):
    published = {'ellipsoid': {'mean_mm': 2.5, 'mean_deg': 4.0}}
    still = {'mean_mm': 20.0, 'mean_deg': 15.0}
    write(content(synthetic(4, (2.4, 0.5)), published=published), 'a')
    folder = write(content(synthetic(5, (2.4, 0.1)), object_did_not_move_baseline=still), 'b')
    (folder / 'README.md').write_text('not a file of pushes')

    status, out, _ = main(folder, '--json')

    assert status == 0
    content_read = json.loads(out, parse_constant=pytest.fail)
    files = content_read['files']
    assert list(content_read) == ['files']
    assert list(files) == ['a', 'b']
    for name, count in (('a', 4), ('b', 5)):
        assert files[name]['pushes'] == count
        for model in ('fitted', 'nominal'):
            for key in ('mean_mm', 'mean_deg', 'median_mm', 'median_deg'):
                assert math.isfinite(files[name][model][key])
        assert files[name]['nominal']['mean_mm'] > 0.01
    assert files['a']['published'] == published
    assert still in files['b']['published'].values()


def test_the_table_has_every_file_and_model(main, write):
    published = {'polynomial': {'mean_mm': 1.25, 'mean_deg': 3.5}}
    folder = write(content(synthetic(4, (1.0, 0.3)), published=published))

    status, out, _ = main(folder)

    assert status == 0
    assert 'nominal' in out
    assert 'polynomial' in out
    assert '1.250' in out
    assert '4 pushes' in out
    assert 'c, mu_c, centre, on one half: spread ' in out
    assert 'with noise alone: c ±' in out


@pytest.mark.slow
def test_the_script_runs_by_its_path(tmp_path):
    done = subprocess.run([sys.executable, SCRIPT, tmp_path], capture_output=True, text=True)

    assert (done.returncode, done.stdout) == (2, '')
    assert done.stderr.count('\n') == 1
    assert str(tmp_path) in done.stderr


@pytest.fixture
def refused(main):
    """Return a function that runs the benchmark, which must fail in one line, and gives it."""

    def run(*arguments):
        status, out, err = main(*arguments)
        assert (status, out) == (2, ''), (out, err)
        assert err.endswith('\n')
        assert err.count('\n') == 1, err
        return err

    return run


PUSH = {
    'tip_start': [0.03, -0.01],
    'tip_end': [0.03, 0.0],
    'object_start': [0.0, 0.0, 0.0],
    'object_end': [0.0, 0.005, 0.0],
}


def test_a_folder_without_files_is_refused(refused, tmp_path):
    line = refused(tmp_path)

    assert 'PATH: ' in line
    assert str(tmp_path) in line


def test_two_files_of_one_name_are_refused(refused, write):
    folder = write(content([PUSH, PUSH]))

    assert 'PATH: expected files of different names, got two of block' in refused(folder, folder)


def test_a_folder_that_is_none_is_refused(refused, tmp_path):
    assert str(tmp_path / 'nowhere') in refused(tmp_path / 'nowhere')


def test_a_record_that_is_no_push_is_refused(refused, write):
    line = refused(write(content([PUSH, PUSH | {'tip_end': [0.03, math.nan]}])))

    assert 'block.json: pushes[1]: tip_end: expected 2 finite numbers' in line


def test_one_push_has_no_halves(refused, write):
    assert 'block.json: pushes: expected two or more, got 1' in refused(write(content([PUSH])))


@pytest.mark.parametrize('published', [3, [1], {'polynomial': 3}, {'polynomial': {'mean_mm': 'x'}}])
def test_published_errors_that_are_none_are_refused(refused, write, published):
    line = refused(write(content([PUSH] * 4, published=published)))

    assert 'block.json: ' in line
    assert 'published' in line
