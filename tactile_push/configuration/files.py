# Copyright 2026 The tactile_push authors
#
# Licensed under the Apache License, Version 2.0 (the "License");
# you may not use this file except in compliance with the License.
# You may obtain a copy of the License at
#
#     http://www.apache.org/licenses/LICENSE-2.0
#
# Unless required by applicable law or agreed to in writing, software
# distributed under the License is distributed on an "AS IS" BASIS,
# WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
# See the License for the specific language governing permissions and
# limitations under the License.
"""Finds the files of config/, in a checkout or wherever they were installed."""

import os
import sys
from pathlib import Path

from ament_index_python.packages import get_package_share_directory


def config_file(name: str) -> Path:
    """Find one of the package's configuration files.

    Parameters
    ----------
    name : str
        Its name in config/.

    Returns
    -------
    path
        The file beside the package in a checkout, else where it was installed.
    """
    beside = Path(__file__).resolve().parents[2] / 'config' / name
    if beside.exists():
        return beside
    os.environ.setdefault('AMENT_PREFIX_PATH', sys.prefix)  # what pip installs into
    return Path(get_package_share_directory('tactile_push')) / 'config' / name
