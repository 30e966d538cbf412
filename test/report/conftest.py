# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""A run that is known in closed form."""

import pytest


@pytest.fixture(scope='module')
def run(tmp_path_factory):
    """Return what a report makes of the bag of `support.pushed_bag`."""
    from support.pushed_bag import run_of, write_bag  # which needs the messages of ROS

    return run_of(write_bag(tmp_path_factory.mktemp('run') / 'pushed'))
