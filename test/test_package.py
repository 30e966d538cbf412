# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The package as a whole: who imports whom, what loads quickly, and that all of it is documented.

The rules are those of architecture.md: mechanics knows nothing of the package; tactile, control
and estimation know mechanics at most; simulation knows those, and so do figures, which show what it
does; only nodes and the part of bags that needs message types import rclpy or message packages;
nothing imports nodes or the command.
"""

import ast
import dataclasses
import importlib
import inspect
import json
import re
import subprocess
import sys
import types
from pathlib import Path

import pytest

import tactile_push
from tactile_push.cli import main

ROOT = Path(tactile_push.__file__).parent
MODULES = {
    '.'.join(path.relative_to(ROOT).with_suffix('').parts).removesuffix('.__init__'): path
    for path in sorted(ROOT.rglob('*.py'))
}
PUBLIC = (
    'mechanics',
    'tactile',
    'control',
    'estimation',
    'simulation',
    'bags',
    'figures',
    'report',
)
CORE = {'tactile', 'control', 'estimation'}
ROS = re.compile(r'rclpy|rosidl_\w+|\w+_msgs|rcl_interfaces|builtin_interfaces')


def imports(path):
    """Return the names of all modules that a file imports, inside functions too."""
    names = set()
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f'{path}: imports by dots are hard to follow'
            names.add(node.module)
            # `from tactile_push import demo` imports a module, too.
            names |= {f'{node.module}.{alias.name}' for alias in node.names}
    return names


def parts_imported(path):
    """Return the first-level parts of the package that a file imports."""
    parts = set()
    for name in imports(path):
        first, *rest = name.split('.')
        if first == 'tactile_push' and rest:
            parts.add(rest[0])
    return parts


def modules_of(part):
    """Return the files of a part of the package."""
    return {name: path for name, path in MODULES.items() if name.split('.')[0] == part}


def run_python(program):
    """Run a program in a fresh interpreter and return what it prints as JSON."""
    done = subprocess.run(
        [sys.executable, '-c', program], capture_output=True, text=True, timeout=120
    )
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def test_all_parts_are_found():
    assert {name.split('.')[0] for name in MODULES} >= {*PUBLIC, 'nodes', 'cli', 'testing'}
    assert all(modules_of(part) for part in PUBLIC)


def test_mechanics_knows_nothing_else_of_the_package():
    for name, path in modules_of('mechanics').items():
        assert parts_imported(path) <= {'mechanics'}, name


@pytest.mark.parametrize('part', sorted(CORE))
def test_core_knows_mechanics_and_itself_at_most(part):
    for name, path in modules_of(part).items():
        assert parts_imported(path) <= {'mechanics', part}, name


def test_simulation_knows_mechanics_the_core_and_the_pipeline_at_most():
    known = {'mechanics', 'devices', 'simulation', 'pipeline', 'interface', *CORE}
    for name, path in modules_of('simulation').items():
        assert parts_imported(path) <= known, name


def test_bags_know_nothing_else_of_the_package():
    for name, path in modules_of('bags').items():
        assert parts_imported(path) <= {'bags'}, name


def test_figures_know_what_they_show_at_most():
    for name, path in modules_of('figures').items():
        assert parts_imported(path) <= {'mechanics', 'simulation', 'figures', *CORE}, name


def test_only_nodes_and_what_makes_messages_need_ros():
    users = {
        name
        for name, path in MODULES.items()
        if any(ROS.fullmatch(imported.split('.')[0]) for imported in imports(path))
    }
    assert 'recording.recorder' in users
    assert 'nodes.contact_geometry' in users
    assert {name.split('.')[0] for name in users} == {'nodes', 'playing', 'recording'}


def test_nothing_but_nodes_imports_nodes_and_nothing_the_command():
    for name, path in MODULES.items():
        if name.split('.')[0] != 'cli':
            assert 'cli' not in parts_imported(path), name
        if name.split('.')[0] != 'nodes':
            assert 'nodes' not in parts_imported(path), name


def test_recorder_is_not_imported_with_the_bags():
    loaded = run_python(
        'import json, sys, tactile_push.bags; '
        'print(json.dumps([name for name in sys.modules if "rclpy" in name or "_msgs" in name]))'
    )
    assert loaded == []


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
        part: [] for part in ('', '.tactile', '.control', '.estimation', '.parameters', '.cli')
    }


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


@pytest.mark.parametrize('name', MODULES)
def test_file_starts_with_the_copyright_and_says_what_it_is(name):
    text = MODULES[name].read_text()
    assert text.startswith('# SPDX-FileCopyrightText: ')
    summary = ast.get_docstring(ast.parse(text)).splitlines()[0]
    assert summary.endswith('.')


def sections_of(docstring):
    """Return the sections of a numpydoc docstring: name to lines, the summary under ''."""
    lines = inspect.cleandoc(docstring).splitlines()
    sections = {'': []}
    current = ''
    for number, line in enumerate(lines):
        following = lines[number + 1] if number + 1 < len(lines) else ''
        if line and following and set(following) == {'-'} and len(following) >= len(line):
            current = line
            sections[current] = []
        elif not (line and set(line) == {'-'}):
            sections[current].append(line)
    return sections


def described(lines):
    """Return the names of a section of parameters, each with its type and description."""
    names = {}
    entry = []
    for line in lines:
        if line and not line.startswith(' '):
            heads, colon, kind = line.partition(' : ')
            entry = [name.strip().lstrip('*') for name in heads.split(',')] if colon else [line]
            for name in entry:
                names[name] = [kind, '']
        elif line.strip():
            for name in entry:
                names[name][1] += line.strip() + ' '
    return {name: tuple(words) for name, words in names.items()}


def arguments_of(function):
    """Return the names of the arguments that a caller gives."""
    return [
        parameter.name
        for parameter in inspect.signature(function).parameters.values()
        if parameter.name not in ('self', 'cls')
    ]


def returns_something(function):
    annotation = inspect.signature(function).return_annotation
    return annotation not in (None, 'None', inspect.Signature.empty)


def faults_of_function(name, function, *, documented_by=None):
    """Return what a function's docstring lacks."""
    docstring = documented_by or function.__doc__
    if not docstring:
        return [f'{name}: no docstring']
    sections = sections_of(docstring)
    faults = []
    parameters = described(sections.get('Parameters', []))
    expected = arguments_of(function)
    faults += [
        f'{name}: {argument} is not documented'
        for argument in expected
        if argument not in parameters
    ]
    faults += [
        f'{name}: {argument} is documented and not there'
        for argument in parameters
        if argument not in expected
    ]
    faults += [
        f'{name}: {argument} has no {what}'
        for argument, words in parameters.items()
        for what, word in zip(('type', 'description'), words, strict=True)
        if not word
    ]
    if [argument for argument in parameters if argument in expected] != [
        argument for argument in expected if argument in parameters
    ]:
        faults.append(f'{name}: the arguments are documented in another order')
    if (
        documented_by is None
        and returns_something(function)
        and not described(sections.get('Returns', []))
    ):
        faults.append(f'{name}: no Returns section')
    if documented_by is None and not returns_something(function) and 'Returns' in sections:
        faults.append(f'{name}: returns nothing and says it does')
    if not sections[''] or not sections[''][0].endswith('.'):
        faults.append(f'{name}: no summary on one line')
    return faults


def faults_of_class(name, class_):
    """Return what a class's docstring and those of its public methods lack."""
    if not class_.__doc__:
        return [f'{name}: no docstring']
    faults = []
    takes_arguments = '__init__' in vars(class_) or dataclasses.is_dataclass(class_)
    if takes_arguments and not getattr(class_, '_is_protocol', False):
        faults += faults_of_function(name, class_, documented_by=class_.__doc__)
    for key, member in vars(class_).items():
        member = getattr(member, '__func__', member)
        if key.startswith('_'):
            continue
        if isinstance(member, property):
            if not member.fget.__doc__:
                faults.append(f'{name}.{key}: no docstring')
        elif inspect.isfunction(member):
            faults += faults_of_function(f'{name}.{key}', member)
    return faults


def faults_of(name, thing):
    """Return what the documentation of a public name lacks."""
    thing = getattr(thing, 'py_func', thing)  # compiled by numba
    if inspect.isclass(thing):
        return faults_of_class(name, thing)
    if inspect.isfunction(thing):
        return faults_of_function(name, thing)
    assert not callable(thing) or isinstance(thing, types.UnionType), name
    return []


PUBLIC_NAMES = [
    f'{part}.{name}'
    for part in PUBLIC
    for name in importlib.import_module(f'tactile_push.{part}').__all__
]


@pytest.mark.parametrize('part', PUBLIC)
def test_public_names_are_those_that_the_part_imports(part):
    module = importlib.import_module(f'tactile_push.{part}')
    assert module.__doc__
    assert len(set(module.__all__)) == len(module.__all__) > 0
    for name in module.__all__:
        assert hasattr(module, name)
    imported = {
        name
        for name, value in vars(module).items()
        if not name.startswith('_') and not inspect.ismodule(value)
    }
    assert imported == set(module.__all__)


@pytest.mark.parametrize('name', PUBLIC_NAMES)
def test_public_name_is_documented_to_the_last_argument(name):
    part, _, key = name.partition('.')
    thing = getattr(importlib.import_module(f'tactile_push.{part}'), key)
    assert faults_of(name, thing) == []


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
    length, others : float
        Lengths [m].

    Returns
    -------
    float
        The sum [m].
    """
    return length + sum(others)


class Method:
    """A class with a method that says nothing of its argument."""

    def move(self, x: float) -> None:
        """Move."""


def test_the_walk_finds_faults_and_nothing_but_faults():
    assert faults_of('f', undocumented) == [
        'f: force is not documented',
        'f: width is documented and not there',
    ]
    assert faults_of('f', unreturned) == ['f: length has no description', 'f: no Returns section']
    assert faults_of('f', complete) == []
    assert faults_of('C', Method) == ['C.move: x is not documented']
    assert len(PUBLIC_NAMES) > 50
