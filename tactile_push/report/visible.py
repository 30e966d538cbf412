# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What of a long series can be seen."""

import numpy as np
import numpy.typing as npt

FRAME = 0.1  # between moments of the view, unless there are more than `MOST_POINTS` of them [s]
MOST_POINTS = 6000  # of a line; as many ticks as the controller has in ten minutes


def visible(
    time: npt.NDArray[np.float64], values: npt.NDArray[np.float64], most: int = MOST_POINTS
) -> npt.NDArray[np.intp]:
    """Return the indices of at most `most` points through which a line looks as through all.

    Time is cut into equal parts. Of each, the first and the last point stay, the least and the
    greatest value, and one point without a value, which interrupts the line.
    """
    count = len(time)
    if count <= most:
        return np.arange(count)
    parts = most // 5
    span = time[-1] - time[0]
    part = np.minimum((time - time[0]) / (span or 1.0) * parts, parts - 1).astype(int)
    first = np.flatnonzero(np.diff(part, prepend=-1))
    last = np.append(first[1:], count) - 1
    gap = np.isnan(values)
    chosen = [first, last]
    for filling, signed in ((np.inf, values), (np.inf, -values), (1.0, np.where(gap, 0.0, 1.0))):
        filled = np.where(np.isnan(signed), filling, signed)
        order = np.lexsort((filled, part))  # within each part the wanted one comes first
        chosen.append(order[first])
    return np.unique(np.concatenate(chosen))


def frame_times(duration: float) -> npt.NDArray[np.float64]:
    """Return the moments that the view from above shows [s], equally spaced."""
    count = int(min(max(np.ceil(duration / FRAME), 1), MOST_POINTS))
    return np.linspace(0.0, duration, count + 1)


def held(
    time: npt.NDArray[np.float64],
    values: npt.NDArray[np.float64],
    moments: npt.NDArray[np.float64],
    longest: float,
) -> npt.NDArray[np.float64]:
    """Return the last value at each moment; NaN if none is younger than `longest` [s]."""
    if not len(time):
        return np.full(len(moments), np.nan)
    index = np.searchsorted(time, moments, side='right') - 1
    known = (index >= 0) & (moments - time[index] <= longest)
    return np.where(known, values[index], np.nan)
