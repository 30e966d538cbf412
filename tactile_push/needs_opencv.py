# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Says what to install where OpenCV or SciPy is needed and missing."""

import sys
from importlib.util import find_spec

PROJECTS = {'cv2': 'OpenCV', 'scipy': 'SciPy'}


def missing_for_images(*modules: str) -> str:
    """Return in words what Python lacks of `cv2` and `scipy`, or one of them; '' if nothing."""
    missing = [PROJECTS[name] for name in modules if find_spec(name) is None]
    return f"needs {' and '.join(missing)}: pip install 'tactile_push[camera]'" if missing else ''


def opencv_is_missing(who: str, *modules: str) -> bool:
    """Return whether Python lacks one of these modules, and print what `who` needs if so."""
    needed = missing_for_images(*modules)
    if needed:
        print(f'{who}: {needed}', file=sys.stderr)
    return bool(needed)
