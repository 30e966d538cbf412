# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Says what to install where the live page needs its server library and it is missing."""

import sys
from importlib.util import find_spec


def missing_for_the_page() -> str:
    """Return what the live page needs and Python does not find, and how to get it, or ''."""
    if find_spec('aiohttp') is not None:
        return ''
    return "needs aiohttp: pip install 'tactile_push[watch]'"


def aiohttp_is_missing(who: str) -> bool:
    """Return whether Python finds no aiohttp, and print what the command or node needs if so."""
    needed = missing_for_the_page()
    if needed:
        print(f'{who}: {needed}', file=sys.stderr)
    return bool(needed)
