# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""`tactile_push identify`: what it prints and writes, and how it ends."""

import json
import math
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip('scipy', reason="pip install 'tactile_push[camera]'")

from support.measured_pushes import OUTLINE, VERTICES, content, measured, ways
from tactile_push.identification import fitting, models
from tactile_push.mechanics import Support
from tactile_push.parameters import ActiveSensingParameters
from tactile_push.parameters.ros_file import read_sections

PUSHES = [measured(Support.spread(OUTLINE, 1.4, 40), 0.3, *way) for way in ways(10)]
FEET = {'points': [[0.005, 0.005], [0.05, 0.005], [0.01, 0.04]], 'loads': [1.0, 2.0, 1.5]}


@pytest.fixture(autouse=True)
def _quick(monkeypatch):
    monkeypatch.setattr(models, 'POINTS', 40)
    monkeypatch.setattr(fitting, 'LONGEST', 2)


@pytest.fixture
def write(tmp_path):
    """Return a function that writes a JSON file and gives its path."""

    def written(made, name='pushes'):
        file = tmp_path / f'{name}.json'
        file.write_text(json.dumps(made))
        return file

    return written


@pytest.fixture
def refused(command, write):
    """Return a function that identifies pushes, which must fail in one line, and gives it."""

    def run(made, *more):
        status, out, err = command('identify', write(made), *more)
        assert (status, out) == (2, '')
        assert err.startswith('tactile_push identify: ')
        assert err.count('\n') == 1
        return err

    return run


def test_pushes_become_an_object_that_simulate_takes(command, write, tmp_path):
    noisy = [dict(push) for push in PUSHES]
    noise = 1e-4 * np.random.default_rng(1).normal(size=(10, 3)) / [1.0, 1.0, 0.02]
    for push, error in zip(noisy, noise, strict=True):
        push['object_end'] = np.add(push['object_end'], error).tolist()
    file, out, plot = write(content(noisy)), tmp_path / 'object.json', tmp_path / 'pushes.svg'

    params = tmp_path / 'object.yaml'

    status, said, err = command('identify', file, '-o', out, '--params', params, '--plot', plot)

    assert (status, err) == (0, '')
    lines = said.splitlines()
    assert lines[0] == 'pushes   10 of 10'
    assert [line.split()[0] for line in lines[1:6]] == ['c', 'mu_c', 'centre', 'errors', 'nominal']
    assert lines[6:] == [str(out), str(params), str(plot)]
    sections = read_sections(params)
    assert [*sections] == ['/**/sim_plant', '/**/active_sensing', '/**/mujoco_plant']
    assert ActiveSensingParameters.of(sections['/**/active_sensing']).c_min < 1e-3 * float(
        lines[1].split()[1]
    )
    assert plot.read_text().startswith('<?xml')
    status, said, _ = command('simulate', '--object', out, '--steps', '1', '--json', '-')
    assert status == 0
    assert json.loads(said)['c'] == pytest.approx(1e-3 * float(lines[1].split()[1]), rel=3e-3)


def test_json_has_values_with_their_covariance(command, write):
    file = write(content(PUSHES, support=FEET))

    status, said, err = command('identify', file, '--json')

    assert (status, err) == (0, '')
    found = json.loads(said)
    assert found['pushes'] == 10
    assert [*found['values']] == [*found['standard_deviations']] == ['mu_c']
    assert found['covariance'][0][0] == pytest.approx(found['standard_deviations']['mu_c'] ** 2)
    assert found['bad'] == found['files'] == []
    assert {'mean_mm', 'mean_deg'} <= found['errors'].keys() & found['nominal'].keys()


def test_a_bad_record_is_named_beside_the_result(command, write):
    file = write(content([*PUSHES, {'tip_start': [0.0, math.nan]}], support=FEET))

    status, said, err = command('identify', file)

    assert status == 0
    assert said.splitlines()[0] == 'pushes   10 of 11'
    where = f'{file}: pushes[10] is left out: tip_start: expected 2 finite numbers'
    assert err.startswith(f'tactile_push identify: warning: {where}')
    assert err.count('\n') == 1


def test_the_object_may_stand_in_a_file_of_its_own(command, write):
    made = content(PUSHES)
    thing = {'outline': made.pop('outline'), 'support': FEET}

    status, said, _ = command(
        'identify', write(made), write(made, 'again'), '--outline', write(thing, 'object'), '--json'
    )

    assert status == 0
    assert json.loads(said)['pushes'] == 20
    assert [*json.loads(said)['values']] == ['mu_c']


def test_pushes_that_tell_nothing_fail(command, write):
    still = [
        push | {'tip_end': push['tip_start'], 'object_end': push['object_start']} for push in PUSHES
    ]

    status, said, err = command('identify', write(content(still)))

    assert (status, said) == (1, '')
    assert err.startswith('tactile_push identify: pushes: expected some that tell c, mu_c, x, y')
    assert 'that leave c, mu_c open' in err
    assert err.count('\n') == 1


@pytest.mark.parametrize(
    ('change', 'said'),
    [
        ({'pushes': PUSHES[:3]}, 'pushes: expected 8 or more, got 3'),
        ({'pushes': [*PUSHES, None, None]}, 'got 2 of 12; '),
        ({'outline': {'kind': 'polygon', 'vertices': [[0, 0], [50, 0], [0, 50]]}}, 'millimetres?'),
        ({'outline': {'corners': VERTICES}}, 'outline: expected a kind of'),
        ({'tip_radius': 'thin'}, 'tip_radius: expected a finite number'),
        ({'support': FEET, 'centre_of_mass': [0.05, 0.02]}, 'support: expected loads that carry'),
        (
            {'support': {'points': [[0.0, 0.0], [0.01, 0.0], [0.0, 0.01]]}},
            'support: centre_of_mass',
        ),
    ],
)
def test_bad_input_is_refused_in_one_line(refused, change, said):
    assert said in refused(
        content(PUSHES, **change) if 'pushes' not in change else content(**change)
    )


def test_a_bag_needs_an_outline(command):
    bag = Path(__file__).parents[1] / 'data' / 'block'

    status, _, err = command('identify', bag)

    said = f'{bag}: expected --outline FILE, as a bag has no outline'
    assert (status, err) == (2, f'tactile_push identify: {said}\n')


def test_two_objects_are_refused(command, write):
    other = content(PUSHES, outline={'kind': 'circle', 'radius': 0.03})

    status, _, err = command('identify', write(content(PUSHES)), write(other, 'other'))

    assert (status, err.count('\n')) == (2, 1)
    assert 'outline: expected the same in all DATA' in err


def test_a_file_that_is_not_there_is_refused(command, tmp_path):
    status, _, err = command('identify', tmp_path / 'nowhere.json')

    assert status == 2
    assert f'{tmp_path / "nowhere.json"}: No such file' in err


def test_an_interrupt_is_silent(command, write, monkeypatch):
    from tactile_push.identification import identify

    def interrupt(pushes):
        raise KeyboardInterrupt

    monkeypatch.setattr(identify, 'identify', interrupt)

    assert command('identify', write(content(PUSHES))) == (130, '', '')


def test_without_scipy_it_says_what_to_install(command, write, monkeypatch):
    from tactile_push import needs_opencv

    monkeypatch.setattr(needs_opencv, 'find_spec', lambda name: None)

    status, _, err = command('identify', write(content(PUSHES)))

    assert status == 2
    assert "pip install 'tactile_push[camera]'" in err
