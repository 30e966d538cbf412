# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Says what to install where the live page needs its server library and it is missing."""

import sys
from importlib.util import find_spec


def aiohttp_is_missing(who: str) -> bool:
    """Return whether Python finds no aiohttp, and print what the command or node needs if so."""
    if find_spec('aiohttp') is not None:
        return False
    print(f"{who}: needs aiohttp: pip install 'tactile_push[watch]'", file=sys.stderr)
    return True
