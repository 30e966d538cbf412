# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Imports numba, whatever its settings in the environment are.

numba shows a traceback for each setting that it cannot read, and fails for others. Such a setting
is left out instead, for this process and those that it starts, and one line says so.
"""

import logging
import os
import re
import warnings

THREADS = 'NUMBA_NUM_THREADS'
_UNREADABLE = re.compile("Environment variable '(NUMBA_[A-Z0-9_]+)' is defined")
_POSITIVE = re.compile('0*[1-9][0-9]{0,5}')
_LOG = logging.getLogger('tactile_push')


def leave_out(name: str) -> None:
    """Take a setting out of the environment, and say so.

    Parameters
    ----------
    name : str
        The variable.
    """
    _LOG.warning(
        'tactile_push: %s=%r is no setting of numba, so it is left out',
        name,
        os.environ.pop(name, ''),
    )


def import_numba() -> None:
    """Import numba for the first time."""
    if not _POSITIVE.fullmatch(os.environ.get(THREADS, '1')):
        leave_out(THREADS)
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter('always')
        import numba  # noqa: F401
    for warning in caught:
        if found := _UNREADABLE.match(str(warning.message)):
            leave_out(found[1])
        else:
            warnings.warn_explicit(
                warning.message, warning.category, warning.filename, warning.lineno
            )


import_numba()
