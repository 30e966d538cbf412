# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""From what was said again and again to what lasted from when to when."""

from collections.abc import Iterable, Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np
import numpy.typing as npt

from tactile_push.report.data import Episode

Label = tuple[str, str]
"""Level and text."""


def episodes(
    lane: str,
    time: npt.ArrayLike,
    labels: Sequence[Label | None],
    longest: float,
) -> list[Episode]:
    """Find how long each label lasted.

    Parameters
    ----------
    lane : str
        Whose matter it is.
    time : array_like, shape (N,)
        When each label was given [s], not decreasing.
    labels : sequence of (str, str) or None
        Level and text; None for nothing out of the ordinary.
    longest : float
        For how long a label counts if no other comes [s].

    Returns
    -------
    list of Episode
        In the order of time.
    """
    times = np.asarray(time, dtype=float).tolist()
    starts = [i for i in range(len(labels)) if i == 0 or labels[i] != labels[i - 1]]
    found = []
    for first, after in pairwise([*starts, len(labels)]):
        label = labels[first]
        if label is None:
            continue
        end = times[after - 1] + longest
        if after < len(labels):
            end = min(end, times[after])
        found.append(Episode(lane, times[first], end, label[1], label[0]))
    return found


def joined(found: Iterable[Episode], gap: float, end: float) -> list[Episode]:
    """Join equal episodes between which no gap would be seen.

    Parameters
    ----------
    found : iterable of Episode
        Episodes.
    gap : float
        The shortest gap that is seen [s].
    end : float
        End of the run, which none outlasts [s].

    Returns
    -------
    list of Episode
        In the order of their start.
    """
    last: dict[tuple[str, str, str], Episode] = {}
    done = []
    for episode in sorted(found, key=lambda episode: episode.start):
        episode = replace(episode, end=min(episode.end, end))
        key = episode.lane, episode.text, episode.level
        before = last.get(key)
        if before is not None and episode.start - before.end <= gap:
            episode = replace(before, end=max(before.end, episode.end))
        elif before is not None:
            done.append(before)
        last[key] = episode
    return sorted([*done, *last.values()], key=lambda episode: (episode.start, episode.lane))
