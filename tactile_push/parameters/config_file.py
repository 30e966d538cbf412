# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Finds the files of config/, in a checkout or wherever they were installed."""

import os
import sys
from pathlib import Path

from ament_index_python.packages import get_package_share_directory


def config_file(name: str) -> Path:
    """Find a configuration file: beside the package in a checkout, else where it was installed.

    Parameters
    ----------
    name : str
        Name of the file in config/.

    Returns
    -------
    Path
        Where it is.
    """
    beside = Path(__file__).resolve().parents[2] / 'config' / name
    if beside.exists():
        return beside
    os.environ.setdefault('AMENT_PREFIX_PATH', sys.prefix)  # what pip installs into
    return Path(get_package_share_directory('tactile_push')) / 'config' / name
