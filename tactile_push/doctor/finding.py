# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""One thing that a doctor finds."""

from dataclasses import dataclass

RIGHT, WRONG, MISSING = 'right', 'wrong', 'missing'


@dataclass(frozen=True)
class Finding:
    """Something about the running finger."""

    verdict: str  #: `RIGHT`, `WRONG` or `MISSING`
    subject: str  #: what it is about, such as a node or a topic
    words: str  #: what was found
    remedy: str = ''  #: what to do; '' if all is well
