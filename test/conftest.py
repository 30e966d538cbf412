# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Keeps the tests' messages on this machine, begins with the longest, says what was skipped."""

import os
import re
from collections import Counter

import pytest

from tactile_push.testing.processes import loopback

os.environ.update(loopback())

# What tests may lack, and how to get it; other reasons for a skip say it themselves.
ROS = r'(rclpy|launch|ament_index_python|\w+_msgs|\w+_interfaces|std_srvs)'
REMEDIES = {
    f"could not import '{ROS}": 'source a ROS 2 workspace, or: make test',
    r"could not import '(\w+)": r'pip install \1',
}
MISSING = re.compile(rf'ModuleNotFoundError: .*?({ROS}|rosbags|playwright)\b')


@pytest.hookimpl(wrapper=True)
def pytest_make_collect_report(collector):
    """Skip the files and folders of tests that need what is not installed."""
    report = yield
    missing = report.failed and MISSING.search(str(report.longrepr))
    if missing:
        report.outcome = 'skipped'
        report.longrepr = (str(collector.path), 0, f"could not import '{missing[1]}'")
    return report


def pytest_collection_modifyitems(items):
    """Begin with the longest tests, so that no process is left with one at the end."""
    items.sort(key=lambda item: item.get_closest_marker('first') is None)


def remedy(reason):
    """Return what to do about a skip."""
    for pattern, words in REMEDIES.items():
        if found := re.match(pattern, reason):
            return found.expand(words)
    return reason


def pytest_terminal_summary(terminalreporter):
    """Print what tests were skipped for, with their number, and what to do."""
    skipped = terminalreporter.stats.get('skipped', ())
    reasons = Counter(remedy(report.longrepr[2].removeprefix('Skipped: ')) for report in skipped)
    if reasons:
        terminalreporter.section('left out')
    for reason, count in sorted(reasons.items()):
        terminalreporter.line(f'{count} skipped: {reason}')
