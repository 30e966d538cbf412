# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""From when on it was known where along the edge the finger is."""

import math
from collections.abc import Iterable

from tactile_push.control import settle_step

KNOWN = 0.002  # a 95 % interval of d that is no wider tells it; the paper reads off 1.8 mm [m]


def known_step(
    steps: Iterable[float], told: Iterable[float], widths: Iterable[float]
) -> int | None:
    """Find the step from which on d is known.

    Parameters
    ----------
    steps : iterable of float
        When the law acted: the stamps of the steps of the paper, which count from 0 [s].
    told : iterable of float
        The stamps of the control periods of which estimates tell [s].
    widths : iterable of float
        How wide the 95 % intervals of their d are [m].

    Returns
    -------
    int or None
        The first step of which, as of all after it of which estimates tell, the interval is not
        wider than `KNOWN`; None if it is wider at the end. What is forgotten later was not known
        for good.
    """
    by_stamp = dict(zip(told, widths, strict=True))
    last = max(by_stamp, default=-math.inf)
    found = [by_stamp.get(step, math.inf) for step in steps if step <= last]
    return settle_step(found, 0.0, KNOWN)
