# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Parameter files for launch files."""

import pytest
import yaml


@pytest.fixture
def own(tmp_path):
    """Return a function that writes a parameter file from values by node."""

    def write(name='machine.yaml', **nodes):
        sections = {f'/**/{node}': {'ros__parameters': given} for node, given in nodes.items()}
        file = tmp_path / name
        file.write_text(yaml.safe_dump(sections))
        return str(file)

    return write
