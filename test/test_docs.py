# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
import importlib.util
import math
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
import yaml

import tactile_push.mechanics
from tactile_push.devices import decode
from tactile_push.launching import FingerArguments
from tactile_push.launching.files import LAUNCH_SECTION
from tactile_push.parameters import PARAMETERS, FingerServoParameters
from tactile_push.parameters.finger_servo import make_servo

ROOT = Path(__file__).resolve().parents[1]
README = (ROOT / 'README.md').read_text()
SIMULATION = (ROOT / 'docs' / 'reference' / 'simulation.md').read_text()
THEORY = (ROOT / 'docs' / 'theory.md').read_text()
SAFETY = (ROOT / 'docs' / 'safety.md').read_text()
WIRE_FORMAT = (ROOT / 'docs' / 'wire_format.md').read_text()


def test_links_of_the_readme_lead_to_files():
    links = re.findall(r'\]\(([^)#:]+)\)', README)
    assert len(links) > 10
    assert [link for link in links if not (ROOT / link).exists()] == []


@pytest.mark.slow
def test_documentation_builds_without_a_warning(tmp_path: Path):
    for package in ('sphinx', 'myst_parser', 'sphinx_rtd_theme'):
        if importlib.util.find_spec(package) is None:
            pytest.skip(f'{package} is not installed; pip install "tactile_push[docs]" brings it')
    command = [sys.executable, '-m', 'sphinx', '--fail-on-warning', '--keep-going', '--quiet']
    done = subprocess.run(
        [*command, ROOT / 'docs', tmp_path / 'html', '-d', tmp_path / 'doctrees'],
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stderr
    page = (tmp_path / 'html' / 'reference' / 'api' / 'mechanics.html').read_text()
    assert 'Outline.polygon' in page
    pages = (tmp_path / 'html').rglob('*.html')
    loaded = [
        address
        for page in pages
        for address in re.findall(
            r'<(?:script|img|link rel="stylesheet")[^>]* (?:src|href)="(\w+:|//)', page.read_text()
        )
    ]
    assert loaded == []  # the pages need no network either


@pytest.mark.parametrize('file', sorted((ROOT / 'config').glob('*.yaml')), ids=lambda f: f.stem)
def test_parameter_files_name_parameters_of_their_nodes_within_their_ranges(file):
    kinds = {**PARAMETERS, LAUNCH_SECTION: FingerArguments}
    for key, content in yaml.safe_load(file.read_text()).items():
        declared = {p.name: p for p in kinds[key.removeprefix('/**/')].declared()}
        for name, value in content['ros__parameters'].items():
            assert type(value) is type(declared[name].default)
            if isinstance(value, float):
                assert declared[name].lower <= value <= declared[name].upper


def test_examples_of_the_library_run_as_they_stand(capsys):
    blocks = re.findall(r'```python\n(.*?)```', SIMULATION, re.DOTALL)
    for block in blocks:
        exec(compile(block, 'simulation.md', 'exec'), {})
    assert len(blocks) == 2
    assert re.findall(r'```python\n(.*?)```', README, re.DOTALL) == blocks[:1]
    printed = capsys.readouterr().out.splitlines()
    assert printed[0].startswith('Pose(x=')
    theta, d, mode = printed[1].split()
    assert float(theta) == pytest.approx(-10.0, abs=0.05)
    assert float(d) == pytest.approx(0.00107, abs=2e-5)
    assert mode in ('stick', 'slip_left', 'slip_right')


def test_theory_names_what_there_is():
    rows = re.findall(r'^\| .* \| (.*) \|$', THEORY, re.MULTILINE)[1:]
    names = {name for row in rows for name in re.findall(r'`([A-Za-z_.]+)`', row)}
    assert len(names) >= 15
    for name in names - {'estimation/translation.py', 'control/law.py'}:
        thing = tactile_push.mechanics
        for part in name.split('.'):
            fields = getattr(thing, '__dataclass_fields__', {})
            assert hasattr(thing, part) or part in fields, name
            thing = getattr(thing, part, None)
    for equation in range(1, 19):
        assert f'({equation})' in THEORY


def test_every_promise_names_tests_that_there_are():
    tables = re.split(r'^\| promise .*\n', SAFETY, flags=re.MULTILINE)[1:]
    promises = [row for table in tables for row in table.split('\n\n')[0].splitlines()[1:]]
    assert len(promises) > 20
    tests = ''.join(file.read_text() for file in (ROOT / 'test').rglob('test_*.py'))
    for promise in promises:
        named = re.findall(r'`(test_\w+)`', promise)
        assert named, promise
        for name in named:
            assert f'def {name}(' in tests, name


def test_parameters_of_the_servo_in_the_tutorial_are_taken():
    page = (ROOT / 'docs' / 'tutorials' / 'own_finger.md').read_text()
    blocks = map(yaml.safe_load, re.findall(r'^```yaml\n(.*?)^```', page, re.DOTALL | re.MULTILINE))
    examples = [b['/**/finger_servo']['ros__parameters'] for b in blocks if '/**/finger_servo' in b]
    assert len(examples) == 2
    for given in examples:
        assert FingerServoParameters.taken(given) == given
        make_servo(FingerServoParameters.of(given))


def test_examples_of_the_wire_format_are_valid():
    contact, no_contact = re.findall(r'^    (\$PTACT,[78],\S+\*\w\w)$', WIRE_FORMAT, re.MULTILINE)
    sentence = decode(contact.encode())
    assert sentence.sequence == 7
    assert sentence.reading.azimuth == 0.0
    assert sentence.reading.elevation == pytest.approx(math.radians(70.0))
    assert sentence.reading.normal_force == 1.5
    assert not decode(no_contact.encode()).reading.in_contact


@pytest.mark.skipif(shutil.which('cc') is None, reason='there is no C compiler')
def test_the_twenty_lines_of_c_speak_the_wire_format(tmp_path: Path):
    (code,) = re.findall(r'```c\n(.*?)```', WIRE_FORMAT, re.DOTALL)
    main = """
int main(void)
{
    sequence = 65535;
    send_reading(1, -180.0, 90.0, 123.456);
    send_reading(0, 0.0, 0.0, 0.0);
    return 0;
}
"""
    (tmp_path / 'sensor.c').write_text(code + main)
    command = ['cc', '-Wall', '-Wextra', '-Werror', '-o', 'sensor', 'sensor.c']
    subprocess.run(command, cwd=tmp_path, check=True)
    said = subprocess.run([tmp_path / 'sensor'], capture_output=True, check=True).stdout
    contact, no_contact = map(decode, said.splitlines(keepends=True))
    assert (contact.sequence, no_contact.sequence) == (65535, 0)
    assert contact.reading.azimuth == -math.pi
    assert contact.reading.elevation == math.pi / 2.0
    assert contact.reading.normal_force == 123.456
    assert not no_contact.reading.in_contact
