# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""From a bag to what its report shows."""

from tactile_push.report.data import Episode, Run, Scene, Series
from tactile_push.report.page import report_html
from tactile_push.report.run import messages_shown, read_run

__all__ = [
    'Episode',
    'Run',
    'Scene',
    'Series',
    'messages_shown',
    'read_run',
    'report_html',
]
