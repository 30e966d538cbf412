# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What has to be installed for what: pip, rosdep and the command without ROS 2."""

import re
import runpy
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from importlib.metadata import packages_distributions

import pytest

from support.package import OF_POSIX, PARTS, ROOT, ROS, TREE, imported_by, run_python
from tactile_push.cli import main


@pytest.fixture(scope='module')
def without_ros():
    """Return lines: a program that begins with them finds no ROS 2."""
    return (
        'import sys\n'
        f'for name in {sorted(filter(ROS.fullmatch, imported_by(ROOT)))}:\n'
        '    sys.modules[name] = None\n'
        "assert sys.modules['rclpy'] is None\n"
    )


@pytest.mark.slow
def test_commands_that_need_no_ros_run_without_it(without_ros, tmp_path):
    pytest.importorskip('plotly', reason='pip install plotly')
    bag = str(TREE / 'test/data/stops')
    for words in (
        ['info', bag],
        ['diff', bag, bag],
        ['replay', bag, '-o', str(tmp_path / 'again')],
        ['estimate', bag],
        ['report', bag, '-o', str(tmp_path / 'page.html')],
        ['simulate', '--steps', '10'],
        ['figures', '--help'],
    ):
        program = f'{without_ros}from tactile_push.cli import main\nsys.exit(main({words}))'
        done = subprocess.run(
            [sys.executable, '-c', program], capture_output=True, text=True, timeout=300
        )
        assert done.returncode == 0, (words, done.stderr)


@pytest.mark.slow
def test_library_is_imported_without_ros(without_ros):
    parts = [part for part in PARTS if part not in OF_POSIX]
    assert {'mechanics', 'bags', 'figures', 'report', 'simulation'} <= set(parts)
    found = run_python(
        f'{without_ros}from importlib import import_module\n'
        f'for part in {parts}:\n'
        "    import_module(f'tactile_push.{part}')\n"
        "print('[]')"
    )
    assert found == []


NEEDS_ROS = (
    "needs ROS 2: source a ROS 2 workspace, or on x86-64 Linux pip install 'tactile_push[ros]'"
)


@pytest.mark.parametrize('words', [['record'], ['play', 'bag'], ['demo']])
def test_command_that_needs_ros_says_how_to_get_it(without_ros, words):
    program = f'{without_ros}from tactile_push.cli import main\nsys.exit(main({words}))'
    done = subprocess.run(
        [sys.executable, '-c', program], capture_output=True, text=True, timeout=60
    )
    assert (done.returncode, done.stdout) == (2, '')
    assert done.stderr == f'tactile_push {words[0]}: {NEEDS_ROS}\n'


def test_node_without_ros_says_how_to_get_it(without_ros, tmp_path):
    (tmp_path / 'sitecustomize.py').write_text(without_ros)
    done = subprocess.run(
        [sys.executable, '-m', 'tactile_push.nodes.sensor_driver'],
        env={'PYTHONPATH': f'{tmp_path}:{TREE}'},
        capture_output=True,
        text=True,
        timeout=60,
    )
    assert (done.returncode, done.stdout) == (2, '')
    assert done.stderr == f'sensor_driver: {NEEDS_ROS}\n'


def installed(requirements):
    """Return the names of the projects that a list of requirements names."""
    return {re.match(r'[\w-]+', line)[0].lower().replace('_', '-') for line in requirements}


@pytest.fixture
def setup(monkeypatch):
    """Return what setup.py tells setuptools."""
    given = {}
    monkeypatch.setattr('setuptools.setup', lambda **words: given.update(words))
    monkeypatch.chdir(TREE)
    runpy.run_path('setup.py')
    return given


# What rosdep calls a module, where it is not the module's own name.
KEYS = {
    'cv2': 'python3-opencv',
    'lz4': 'mcap-ros2-support',
    'mcap': 'mcap-ros2-support',
    'mcap_ros2': 'mcap-ros2-support',
    'mpl_toolkits': 'python3-matplotlib',
    'xacro': 'xacro',
    'zstandard': 'mcap-ros2-support',
}
NO_KEY = {'mujoco', 'plotly'}  # the manual says how to install it
OWN = {'tactile_push', 'support', 'faults', 'fuzzing', 'soaking', 'estimating', 'conftest'}


def foreign(folder):
    """Return the modules from elsewhere that the files of a folder import."""
    return imported_by(folder) - sys.stdlib_module_names - OWN


def test_setup_requires_what_the_package_imports_and_nothing_else(setup):
    pytest.importorskip('plotly')
    projects = packages_distributions()
    modules = {name for name in foreign(ROOT) if not ROS.fullmatch(name)}
    modules -= {'pytest', 'mujoco', 'xacro', 'cv2', 'scipy', 'aiohttp'}  # of the extras
    needed = {projects[name][0].lower().replace('_', '-') for name in modules}
    assert installed(setup['install_requires']) == needed
    assert installed(setup['extras_require']['mujoco']) == {'mujoco'}
    assert installed(setup['extras_require']['camera']) == {'opencv-python-headless', 'scipy'}
    assert installed(setup['extras_require']['watch']) == {'aiohttp'}
    assert all('x86_64' in line for line in setup['extras_require']['ros'])
    assert installed(setup['extras_require']['ros']) == {
        'ros-jazzy-common-interfaces',
        'ros-jazzy-rclpy',
    }


def test_package_xml_names_what_is_imported():
    package = ElementTree.parse(TREE / 'package.xml').getroot()
    named = {element.text for element in package.iter('exec_depend')}
    for_tests = named | {element.text for element in package.iter('test_depend')}

    def keys(folder):
        modules = foreign(folder) - NO_KEY
        return {
            KEYS.get(name, name if ROS.fullmatch(name) or name == 'rclpy' else f'python3-{name}')
            for name in modules
        }

    assert keys(ROOT) | keys(TREE / 'launch') <= for_tests
    assert 'python3-pytest' in for_tests


def test_command_shows_its_help():
    done = subprocess.run(
        [sys.executable, '-m', 'tactile_push.cli', '--help'],
        capture_output=True,
        text=True,
        timeout=60,
    )
    assert (done.returncode, done.stderr) == (0, '')
    assert done.stdout.startswith('usage: tactile_push')
    assert 'demo' in done.stdout


@pytest.mark.parametrize('arguments', [[], ['nonsense'], ['demo', '--nonsense']])
def test_command_refuses_what_it_does_not_know_with_status_2(capsys, arguments):
    with pytest.raises(SystemExit) as ended:
        main(arguments)
    assert ended.value.code == 2
    out, err = capsys.readouterr()
    assert out == ''
    assert 'error: ' in err
