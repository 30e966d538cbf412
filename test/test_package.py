# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The package as a whole: imports, documentation, what has to be installed, and its command."""

import ast
import importlib
import inspect
import json
import re
import runpy
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from importlib.metadata import packages_distributions
from pathlib import Path
from types import FunctionType

import pytest

import tactile_push
from tactile_push.cli import main

ROOT = Path(tactile_push.__file__).parent
TREE = ROOT.parent
PARTS = sorted(
    path.parent.name for path in ROOT.glob('*/__init__.py') if '__all__' in path.read_text()
)
CORE = ('tactile', 'control', 'estimation')
ROS = re.compile(
    r'rclpy|launch(_ros)?|ament_\w+|\w+_msgs|rcl_interfaces|builtin_interfaces|std_srvs'
)
# Not every system has these.
POSIX = {'fcntl', 'grp', 'pty', 'pwd', 'resource', 'termios', 'tty'}
OF_POSIX = {'nodes', 'playing', 'recording', 'testing', 'demo'}


def imports(path, *, at_once=False):
    """Return the names of all modules that a file imports, inside functions too or at once."""
    tree = ast.parse(path.read_text())
    names = set()
    for node in tree.body if at_once else ast.walk(tree):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f'{path}: imports by dots are hard to follow'
            names.add(node.module)
    return names


def imported_by(folder):
    """Return the top-level modules that the files of a folder import."""
    return {name.split('.')[0] for path in folder.rglob('*.py') for name in imports(path)}


def run_python(program):
    """Run a program in a fresh interpreter and return what it prints as JSON."""
    done = subprocess.run(
        [sys.executable, '-c', program], capture_output=True, text=True, timeout=120
    )
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def test_every_part_imports_only_what_the_contracts_in_pyproject_allow():
    pytest.importorskip('importlinter', reason='pip install import-linter')
    done = subprocess.run(
        [sys.executable, '-c', 'from importlinter.cli import lint_imports_command as run; run()'],
        cwd=TREE,
        capture_output=True,
        text=True,
        timeout=120,
    )
    assert done.returncode == 0, done.stdout
    assert re.search(r'Contracts: [1-9]\d* kept, 0 broken', done.stdout)


def test_import_of_the_core_and_the_command_does_not_load_numba_or_ros():
    loaded = run_python(
        'import json, sys\n'
        'from importlib import import_module\n'
        'loaded = {}\n'
        "for part in ('', '.tactile', '.control', '.estimation', '.parameters', '.cli'):\n"
        "    import_module(f'tactile_push{part}')\n"
        "    slow = {'numba', 'rclpy', 'matplotlib'} & set(sys.modules)\n"
        '    loaded[part] = sorted(slow)\n'
        'print(json.dumps(loaded))'
    )
    assert loaded == {
        part: [] for part in ('', *(f'.{part}' for part in (*CORE, 'parameters', 'cli')))
    }


def test_recorder_is_not_imported_with_the_bags():
    loaded = run_python(
        'import json, sys, tactile_push.bags; '
        'print(json.dumps([name for name in sys.modules if "rclpy" in name or "_msgs" in name]))'
    )
    assert loaded == []


def test_import_of_mechanics_and_simulation_compiles_nothing():
    compiled = run_python(
        'import json, sys\n'
        'import tactile_push.mechanics, tactile_push.simulation\n'
        'from numba.core.registry import CPUDispatcher\n'
        'found = {}\n'
        'for name, module in list(sys.modules.items()):\n'
        "    if name.startswith('tactile_push'):\n"
        '        for key, value in vars(module).items():\n'
        '            if isinstance(value, CPUDispatcher):\n'
        "                found[f'{name}.{key}'] = len(value.overloads) + len(value.signatures)\n"
        'print(json.dumps(found))'
    )
    assert 'tactile_push.mechanics.push.push' in compiled
    assert {name: count for name, count in compiled.items() if count} == {}


def test_what_needs_no_ros_imports_nothing_that_only_posix_systems_have():
    found = {
        str(path.relative_to(ROOT)): names
        for path in ROOT.rglob('*.py')
        if path.relative_to(ROOT).parts[0].removesuffix('.py') not in OF_POSIX
        and (names := imports(path, at_once=True) & POSIX)
    }
    assert found == {}


# A program that begins with these lines finds no ROS 2.
WITHOUT_ROS = (
    'import sys\n'
    f'for name in {sorted(filter(ROS.fullmatch, imported_by(ROOT)))}:\n'
    '    sys.modules[name] = None\n'
    "assert sys.modules['rclpy'] is None\n"
)


def test_commands_that_need_no_ros_run_without_it(tmp_path):
    pytest.importorskip('plotly', reason='pip install plotly')
    bag = str(TREE / 'test/data/block')
    for words in (
        ['info', bag],
        ['diff', bag, bag],
        ['replay', bag, '-o', str(tmp_path / 'again')],
        ['estimate', bag],
        ['report', bag, '-o', str(tmp_path / 'page.html')],
        ['simulate', '--steps', '10'],
        ['figures', '--help'],
    ):
        program = f'{WITHOUT_ROS}from tactile_push.cli import main\nsys.exit(main({words}))'
        done = subprocess.run(
            [sys.executable, '-c', program], capture_output=True, text=True, timeout=120
        )
        assert done.returncode == 0, (words, done.stderr)


def test_library_is_imported_without_ros():
    parts = [part for part in PARTS if part not in OF_POSIX]
    assert {'mechanics', 'bags', 'figures', 'report', 'simulation'} <= set(parts)
    found = run_python(
        f'{WITHOUT_ROS}from importlib import import_module\n'
        f'for part in {parts}:\n'
        "    import_module(f'tactile_push.{part}')\n"
        "print('[]')"
    )
    assert found == []


NEEDS_ROS = (
    "needs ROS 2: source a ROS 2 workspace, or on x86-64 Linux pip install 'tactile_push[ros]'"
)


@pytest.mark.parametrize('words', [['record'], ['play', 'bag'], ['demo']])
def test_command_that_needs_ros_says_how_to_get_it(words):
    program = f'{WITHOUT_ROS}from tactile_push.cli import main\nsys.exit(main({words}))'
    done = subprocess.run(
        [sys.executable, '-c', program], capture_output=True, text=True, timeout=60
    )
    assert (done.returncode, done.stdout) == (2, '')
    assert done.stderr == f'tactile_push {words[0]}: {NEEDS_ROS}\n'


def test_node_without_ros_says_how_to_get_it(tmp_path):
    (tmp_path / 'sitecustomize.py').write_text(WITHOUT_ROS)
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
    'lz4': 'mcap-ros2-support',
    'mcap': 'mcap-ros2-support',
    'mcap_ros2': 'mcap-ros2-support',
    'mpl_toolkits': 'python3-matplotlib',
    'zstandard': 'mcap-ros2-support',
}
NO_KEY = {'plotly'}  # the manual says how to install it
OWN = {'tactile_push', 'support', 'faults', 'fuzzing', 'soaking', 'estimating', 'conftest'}


def foreign(folder):
    """Return the modules from elsewhere that the files of a folder import."""
    return imported_by(folder) - sys.stdlib_module_names - OWN


def test_setup_requires_what_the_package_imports_and_nothing_else(setup):
    projects = packages_distributions()
    modules = {name for name in foreign(ROOT) if not ROS.fullmatch(name)} - {'pytest'}
    needed = {projects[name][0].lower().replace('_', '-') for name in modules}
    assert installed(setup['install_requires']) == needed
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


def test_files_start_with_the_copyright_and_say_what_they_are():
    found = []
    for path in sorted(ROOT.rglob('*.py')):
        text = path.read_text()
        summary = (ast.get_docstring(ast.parse(text)) or '').splitlines()[:1]
        if not text.startswith('# SPDX-FileCopyrightText: '):
            found.append(f'{path}: no copyright')
        if not (summary and summary[0].endswith('.')):
            found.append(f'{path}: no summary on one line')
    assert found == []


def test_public_names_are_those_that_the_part_imports():
    found = []
    for part in PARTS:
        module = importlib.import_module(f'tactile_push.{part}')
        for name in module.__all__:
            getattr(module, name)  # some are imported when they are asked for
        imported = {
            name
            for name, value in vars(module).items()
            if not name.startswith('_') and not inspect.ismodule(value)
        }
        if not module.__doc__ or sorted(module.__all__) != sorted(imported):
            found.append(f'{part}: {sorted(imported ^ set(module.__all__))}')
    assert found == []


# numpydoc's names of what is held here: a docstring is there; all arguments, and no others, are
# documented in their order, with type and description; so is what is returned; the summary is one
# line and ends with a full stop.
CHECKS = {'GL08', 'PR01', 'PR02', 'PR03', 'PR04', 'PR07', 'RT01', 'RT03', 'SS03', 'SS06'}


def documented(part):
    """Return a part's public functions, classes, methods and properties by their full names."""
    module = importlib.import_module(f'tactile_push.{part}')
    found = {}
    for key in module.__all__:
        thing = getattr(module, key)
        if inspect.isclass(thing):
            if not getattr(thing, '_is_protocol', False):  # nobody makes one with arguments
                found[f'{part}.{key}'] = thing
            found |= {
                f'{part}.{key}.{name}': getattr(thing, name)
                for name, member in vars(thing).items()
                if not name.startswith('_')
                and isinstance(member, FunctionType | classmethod | staticmethod | property)
            }
        elif inspect.isfunction(getattr(thing, 'py_func', thing)):
            found[f'{part}.{key}'] = thing
    return found


def faults_of(thing):
    """Return what the docstring of a public function, class, method or property lacks."""
    pytest.importorskip('numpydoc', reason='pip install numpydoc')
    from numpydoc.docscrape import get_doc_object
    from numpydoc.validate import validate

    checks = {'GL08', 'SS03', 'SS06'} if isinstance(thing, property) else CHECKS
    errors = validate(get_doc_object(thing))['errors']
    return [text for code, text in errors if code in checks]


def test_public_names_are_documented_to_the_last_argument():
    parts = set(PARTS) - {'parameters', 'replay'}
    things = {name: thing for part in parts for name, thing in documented(part).items()}
    assert len(things) > 200
    assert 'mechanics.push' in things
    assert {name: faults for name, thing in things.items() if (faults := faults_of(thing))} == {}


def undocumented(length, force=1.0):
    """Do something.

    Parameters
    ----------
    length : float
        Length [m].
    width : float
        Width [m].
    """


def unreturned(length: float) -> float:
    """Do something.

    Parameters
    ----------
    length : float
    """
    return length


def complete(length: float, *others: float) -> float:
    """Do something.

    Parameters
    ----------
    length, *others : float
        Lengths [m].

    Returns
    -------
    float
        The sum [m].
    """
    return length + sum(others)


def test_faults_of_docstrings_are_found():
    assert faults_of(undocumented) == [
        "Parameters {'force'} not documented",
        "Unknown parameters {'width'}",
    ]
    assert faults_of(unreturned) == [
        'Parameter "length" has no description',
        'No Returns section found',
    ]
    assert faults_of(complete) == []
