# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

from pathlib import Path

import pytest

from support.package import run_python

TESTS = Path(__file__).parents[2]


# What each law calls when it has to.
FUNCTIONS = 'refinement.refine', 'holding.holding_push', 'turning.turning_command'
PLACING = 'tactile_push.control.placing'


@pytest.mark.slow
def test_nothing_is_left_to_compile_while_an_object_is_pushed():
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
        'laws = "place", "steer", "settle"\n'
        'place, steer, settle = (Line(law=law) for law in laws)\n'  # which compiles them
        'before = compiled()\n'
        'place.ask(-0.02, -0.1)\n'
        'place.until(lambda: place.placing.released)\n'
        'place.ask(0.09, 0.6)\n'  # out of reach
        'steer.ask(0.01, 0.0)\n'
        'for _ in range(40): place.period(), steer.period(), settle.period()\n'
        'print(json.dumps([before, compiled(), bool(numba.config.DISABLE_JIT)]))'
    )
    before, after, as_plain_python = found
    assert after == before
    compiled = [before[f'{PLACING}.{name}'] for name in FUNCTIONS]
    assert as_plain_python or compiled == [1] * len(FUNCTIONS)
