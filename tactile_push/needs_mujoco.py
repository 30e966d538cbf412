# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Says what to install where MuJoCo is needed and missing."""

import sys
from importlib.util import find_spec


def mujoco_is_missing(who: str) -> bool:
    """Return whether Python finds no MuJoCo, and print what the command or node needs if so."""
    if find_spec('mujoco') is not None:
        return False
    print(f"{who}: needs MuJoCo: pip install 'tactile_push[mujoco]'", file=sys.stderr)
    return True
