# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Keeps the tests' messages on this machine, as the nodes do; says at the end what was skipped."""

import os
import re
from collections import Counter

from tactile_push.testing.processes import loopback

os.environ.update(loopback())

# How to get what a test skipped for; other reasons say it themselves.
REMEDIES = {
    r"could not import '(rclpy|\w+_msgs|\w+_interfaces)": 'source a ROS 2 workspace, or: make test',
    r"could not import '(\w+)": r'pip install \1',
}


def pytest_terminal_summary(terminalreporter):
    """Print each reason for which tests were skipped, with their number and what to do."""
    reasons = Counter(
        report.longrepr[2].removeprefix('Skipped: ')
        for report in terminalreporter.stats.get('skipped', ())
        if isinstance(report.longrepr, tuple | list)
    )
    if not reasons:
        return
    terminalreporter.section('left out')
    for reason, count in sorted(reasons.items()):
        remedies = (
            found.expand(remedy)
            for pattern, remedy in REMEDIES.items()
            if (found := re.match(pattern, reason))
        )
        terminalreporter.line(f'{count} skipped: {next(remedies, reason)}')
