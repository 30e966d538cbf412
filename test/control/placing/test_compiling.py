# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0

import numba
from numba.core import event

from tactile_push.control.placing.compiling import compile_placing
from tactile_push.control.placing.learning import telling_command
from tactile_push.control.placing.refinement import refine


def test_what_is_compiled_is_all_that_a_placing_needs():
    compile_placing()
    if numba.config.DISABLE_JIT:
        return
    assert [len(one.signatures) for one in (telling_command, refine)] == [1, 1]
    with event.install_recorder('numba:compile') as recorded:
        compile_placing()
    assert recorded.buffer == []
