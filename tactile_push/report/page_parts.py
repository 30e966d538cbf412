# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What pages are made of: files in assets/, scripts that leave the window alone, allowances."""

import base64
import hashlib
from importlib.resources import files


def asset(name: str, package: str = __package__) -> str:
    """Return a file in the folder assets/ of a package, the report's by default."""
    return files(package).joinpath('assets').joinpath(name).read_text(encoding='utf-8')


def own_script(*parts: str) -> str:
    """Return one script of several parts, which adds no names to the window."""
    text = '\n'.join(parts)
    return f'(() => {{\n{text}}})();\n'


def allowance(text: str) -> str:
    """Return what a Content-Security-Policy says to allow this script or style and no other."""
    digest = base64.b64encode(hashlib.sha256(text.encode()).digest())
    return f"'sha256-{digest.decode()}'"
