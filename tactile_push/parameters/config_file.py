# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Finds the files of config/ and urdf/, in a checkout or wherever they were installed."""

import sysconfig
from pathlib import Path


def config_file(name: str, folder: str = 'config') -> Path:
    """Return the path of one of the package's configuration files.

    Parameters
    ----------
    name : str
        Its name.
    folder : str, optional
        Where it is, such as 'urdf'.

    Returns
    -------
    Path
        The file in the checkout, else under the prefix that pip or colcon installed into.

    Raises
    ------
    FileNotFoundError
        If there is no such file.
    """
    here = Path(__file__).resolve()
    shares = [prefix / 'share/tactile_push' for prefix in here.parents]
    shares.append(Path(sysconfig.get_path('data')) / 'share/tactile_push')
    for share in (here.parents[2], *shares):
        path = share / folder / name
        if path.exists():
            return path
    raise FileNotFoundError(f'{name}: expected in share/tactile_push/{folder}, is not installed')
