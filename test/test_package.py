# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The package as a whole: imports, documentation and public names."""

import ast
import importlib
import inspect
import re
import subprocess
import sys
import textwrap
from types import FunctionType
from typing import NamedTuple

import pytest

from support.package import OF_POSIX, PARTS, POSIX, ROOT, TREE, imports, run_python
from tactile_push.parameters import NodeParameters

CORE = ('tactile', 'control', 'estimation')
NEED_NO_NUMBA = ('parameters', 'pipeline', 'report', 'replay', 'comparing', 'cli')


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
    parts = ('', *(f'.{part}' for part in (*CORE, *NEED_NO_NUMBA)))
    loaded = run_python(
        'import json, sys\n'
        'from importlib import import_module\n'
        'loaded = {}\n'
        f'for part in {parts}:\n'
        "    import_module(f'tactile_push{part}')\n"
        "    slow = {'numba', 'rclpy', 'matplotlib'} & set(sys.modules)\n"
        '    loaded[part] = sorted(slow)\n'
        'print(json.dumps(loaded))'
    )
    assert loaded == {part: [] for part in parts}


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


def defines_nothing_to_run(path):
    """Return whether a file has no function and no method."""
    functions = (ast.FunctionDef, ast.AsyncFunctionDef)
    return not any(isinstance(node, functions) for node in ast.walk(ast.parse(path.read_text())))


def test_every_module_with_behaviour_has_a_test_file_of_its_name():
    modules = [
        path.relative_to(ROOT)
        for path in sorted(ROOT.rglob('*.py'))
        if not path.name.startswith('__') and not defines_nothing_to_run(path)
    ]
    assert len(modules) > 50
    missing = [
        str(module)
        for module in modules
        if not (TREE / 'test' / module.parent / f'test_{module.name}').exists()
    ]
    assert missing == []


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
            # Nobody makes a protocol; a node's parameters are described where they stand.
            if not (getattr(thing, '_is_protocol', False) or issubclass(thing, NodeParameters)):
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


def described_where_they_stand(record):
    """Return whether a class has fields, and a `#:` comment at each describes it."""
    source = textwrap.dedent(inspect.getsource(record))
    lines = source.splitlines()
    fields = [
        entry.lineno
        for entry in ast.parse(source).body[0].body
        if isinstance(entry, ast.AnnAssign) and not entry.target.id.startswith('_')
    ]
    return bool(fields) and all(
        re.search(r'#: \S', lines[number - 1]) or re.match(r'\s*#: \S', lines[number - 2])
        for number in fields
    )


def faults_of(thing):
    """Return what the docstring of a public function, class, method or property lacks."""
    pytest.importorskip('numpydoc', reason='pip install numpydoc')
    from numpydoc.docscrape import get_doc_object
    from numpydoc.validate import validate

    checks = CHECKS
    described = inspect.isclass(thing) and described_where_they_stand(thing)
    if described or isinstance(thing, property):
        checks = {'GL08', 'SS03', 'SS06'}
    errors = validate(get_doc_object(thing))['errors']
    return [text for code, text in errors if code in checks]


@pytest.mark.slow
def test_public_names_are_documented_to_the_last_argument():
    parts = set(PARTS) - {'replay'}
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


class Described(NamedTuple):
    """Do something."""

    length: float  #: length [m]
    #: width [m]
    width: float


class HalfDescribed(NamedTuple):
    """Do something."""

    length: float  #: length [m]
    width: float  # [m]


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
    assert faults_of(Described) == []
    (fault,) = faults_of(HalfDescribed)  # which names them in any order
    assert set(re.findall(r"'(\w+)'", fault)) == {'length', 'width'}
    assert fault.endswith('not documented')
