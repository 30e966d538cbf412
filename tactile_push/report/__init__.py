# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What a run was: figures of merit beside the paper's, and a page that shows the whole run."""

from tactile_push.report.page import report_html
from tactile_push.report.run import messages_shown, read_run

__all__ = ['messages_shown', 'read_run', 'report_html']
