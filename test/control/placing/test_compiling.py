# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

from pathlib import Path

import pytest

from support.package import run_python

TESTS = Path(__file__).parents[2]


@pytest.mark.slow
def test_nothing_is_left_to_compile_while_an_object_is_placed():
    found = run_python(
        'import json, sys\n'
        f'sys.path.insert(0, {str(TESTS)!r})\n'
        'import numba\n'
        'from numba.core.registry import CPUDispatcher\n'
        'from support.placed_run import SENSING, Line\n'
        'from tactile_push.parameters.active_sensing import (\n'
        '    ActiveSensingParameters, compile_sensing,\n'
        ')\n'
        'def compiled():\n'
        '    return {\n'
        "        f'{name}.{key}': len(value.signatures)\n"
        '        for name, module in list(sys.modules.items())\n'
        "        if name.startswith('tactile_push.control')\n"
        '        for key, value in vars(module).items()\n'
        '        if isinstance(value, CPUDispatcher)\n'
        '    }\n'
        'compile_sensing(ActiveSensingParameters.of(SENSING))\n'
        'line = Line()\n'  # which compiles the law
        'before = compiled()\n'
        'line.ask(-0.02, -0.1)\n'
        'line.until(lambda: line.placing.released)\n'
        'line.ask(0.09, 0.6)\n'  # out of reach
        'for _ in range(40): line.period()\n'
        'print(json.dumps([before, compiled(), bool(numba.config.DISABLE_JIT)]))'
    )
    before, after, as_plain_python = found
    assert after == before
    assert as_plain_python or before['tactile_push.control.placing.refinement.refine'] == 1
